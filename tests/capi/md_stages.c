/* The protocol of jam_compress: limits and targets keep it, resumed calls end it. */
#include "steps.h"

static jam_system *start(void) { return random_spheres(3, 60, 0.0, 2); }

static jam_md_report grow(jam_system *sys, const jam_compress_options *o, jam_status expected) {
  SIZED(jam_md_report, r);
  assert_int_equal(jam_compress(sys, o, &r), expected);
  return r;
}

static jam_compress_options defaults(void) {
  DEFAULTS(compress, o);
  return o;
}

/* Options that change no stage give the bits of no options. */
CASE(limits_keep_the_protocol) {
  OWNED jam_system *plain = start(), *limited = start(), *law = start();
  jam_compress_options o = defaults();
  jam_md_report r = grow(plain, NULL, JAM_OK);
  assert_true(r.pressure > 0.9e6);
  o.wall_time = 1e6, o.collisions_per_particle = 1e9, o.packing_fraction = 0.9, o.time = 1e9;
  r = grow(limited, &o, JAM_NOT_CONVERGED); /* of 0.9 */
  assert_int_equal(r.stop_reason, JAM_STOP_PRESSURE);
  assert_non_null(strstr(jam_last_error(), "before the packing fraction 0.9"));
  same_view(plain, limited, JAM_VIEW_POSITIONS);
  o = defaults();
  o.growth_law = JAM_GROWTH_DENSITY;
  r = grow(law, &o, JAM_OK);
  assert_true(r.pressure > 0.9e6);
}

CASE(targets_end_the_protocol) {
  OWNED jam_system *low = start(), *high = start(), *dense = start();
  jam_compress_options o = defaults();
  o.pressure = 30.0;
  jam_md_report r = grow(low, &o, JAM_OK);
  assert_true(r.pressure > 25.0 && r.pressure < 100.0);
  o.pressure = 1e4;
  r = grow(high, &o, JAM_OK);
  assert_true(r.pressure > 0.9e4 && r.pressure < 1e6);
  o = defaults();
  o.packing_fraction = 0.5;
  r = grow(dense, &o, JAM_OK);
  assert_int_equal(r.stop_reason, JAM_STOP_PACKING_FRACTION);
}

/* Slices of wall time, which is that of the call, not of each stage: however often it is stopped, also between two
 * stages and across checkpoints, it ends as if it had not been. */
CASE(a_stopped_protocol_goes_on) {
  OWNED jam_system *whole = start(), *cut = start();
  jam_compress_options o = defaults();
  int calls = 0;
  jam_status status;
  grow(whole, NULL, JAM_OK);
  o.wall_time = 0.01;
  while ((status = jam_compress(cut, &o, NULL)) == JAM_LIMIT) {
    jam_system *const again = from_checkpoint(cut);
    jam_destroy(cut);
    cut = again;
    o.resume = info_of(cut).paused != 0;
    ++calls;
  }
  assert_int_equal(status, JAM_OK);
  assert_true(calls > 0);
  same_view(whole, cut, JAM_VIEW_POSITIONS);
}
