/* The protocol of jam_compress: limits and targets keep it, a growth rate makes one stage, resumed calls end it. */
#include <math.h>
#include <stdio.h>

#include "systems.h"

static jam_system *start_with(int64_t n) {
  DEFAULTS(create, o);
  o.n = n, o.seed = 2;
  return created(&o);
}

static jam_system *start(void) { return start_with(60); }

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
  jam_system *plain = start(), *limited = start(), *law = start();
  jam_compress_options o = defaults();
  jam_md_report r;
  r = grow(plain, NULL, JAM_OK);
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
  jam_destroy(law);
  jam_destroy(limited);
  jam_destroy(plain);
}

CASE(targets_end_the_protocol) {
  jam_system *low = start(), *high = start(), *dense = start();
  jam_compress_options o = defaults();
  jam_md_report r;
  o.pressure = 30.0;
  r = grow(low, &o, JAM_OK);
  assert_true(r.pressure > 25.0 && r.pressure < 100.0);
  o.pressure = 1e4;
  r = grow(high, &o, JAM_OK);
  assert_true(r.pressure > 0.9e4 && r.pressure < 1e6);
  o = defaults();
  o.packing_fraction = 0.5;
  r = grow(dense, &o, JAM_OK);
  assert_int_equal(r.stop_reason, JAM_STOP_PACKING_FRACTION);
  assert_true(fabs(r.packing_fraction - 0.5) < 1e-6);
  jam_destroy(dense);
  jam_destroy(high);
  jam_destroy(low);
}

/* One stage of a rate of one's own goes to the same pressure as jam-pack --growth RATE. */
CASE(a_rate_makes_one_stage) {
  jam_system *one = start(), *two = start();
  jam_compress_options o = defaults();
  jam_md_report r;
  o.growth_rate = 0.1;
  r = grow(one, &o, JAM_OK);
  assert_true(r.pressure > 0.9e6);
  assert_true(fabs(r.growth_rate / 0.1 - 1.0) < 1e-12);
  o.growth_rate = 0.0, o.growth_rate_end = 1e-3;
  SAYS(jam_compress(two, &o, NULL), JAM_E_ARGUMENT, "growth_rate_end");
  o.growth_rate = -1.0, o.growth_rate_end = 0.0;
  assert_int_equal(jam_compress(two, &o, NULL), JAM_E_ARGUMENT);
  jam_destroy(two);
  jam_destroy(one);
}

static int32_t stop_at_times(const jam_progress *p, void *user) {
  (void)p;
  return ++*(int *)user % 3 == 0;
}

/* However often it is stopped, also between two stages and across checkpoints, it ends as if it had not been. 500
 * spheres, so that growth takes much longer than the 0.05 s between two callbacks. */
CASE(a_stopped_protocol_goes_on) {
  jam_system *whole = start_with(500), *cut = start_with(500), *again = NULL;
  jam_compress_options o = defaults();
  int asked = 0, calls = 0;
  jam_status status;
  jam_info info;
  grow(whole, NULL, JAM_OK);
  for (;;) {
    assert_int_equal(jam_set_progress(cut, stop_at_times, &asked), JAM_OK);
    status = jam_compress(cut, &o, NULL);
    info.struct_size = sizeof info;
    assert_int_equal(jam_get_info(cut, &info), JAM_OK);
    if (status == JAM_OK) break;
    assert_int_equal(status, JAM_CANCELLED);
    assert_int_equal(info.paused, JAM_PHASE_COMPRESS);
    assert_int_equal(jam_write_checkpoint(cut, "md_stages.bin"), JAM_OK);
    assert_int_equal(jam_read_checkpoint("md_stages.bin", NULL, NULL, &again), JAM_OK);
    jam_destroy(cut);
    cut = again;
    o.resume = 1;
    ++calls;
  }
  remove("md_stages.bin");
  assert_true(calls > 0);
  same_view(whole, cut, JAM_VIEW_POSITIONS);
  jam_destroy(cut);
  jam_destroy(whole);
}

/* Slices of wall time: the limit is that of the call, not of each stage. */
CASE(wall_time_cuts_the_protocol) {
  jam_system *whole = start(), *cut = start();
  jam_compress_options o = defaults();
  jam_status status;
  grow(whole, NULL, JAM_OK);
  o.wall_time = 0.01;
  while ((status = jam_compress(cut, &o, NULL)) == JAM_LIMIT) {
    const jam_info info = info_of(cut);
    o.resume = info.paused != 0;
  }
  assert_int_equal(status, JAM_OK);
  same_view(whole, cut, JAM_VIEW_POSITIONS);
  jam_destroy(cut);
  jam_destroy(whole);
}
