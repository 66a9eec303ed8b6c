/* The progress of long calls: a fraction that never falls, and the time left where it is known. */
#include <math.h>
#include "steps.h"

typedef struct seen {
  int reports, known, times;
  double last;
} seen;

static int32_t look(const jam_progress *p, void *user) {
  seen *s = user;
  ++s->reports;
  assert_int_equal(p->struct_size, sizeof *p);
  if (isnan(p->fraction)) {
    assert_int_equal(s->known, 0); /* once known, always known */
    assert_true(isnan(p->seconds_left));
    return 0;
  }
  ++s->known;
  assert_true(p->fraction >= s->last && p->fraction <= 1.0);
  s->last = p->fraction;
  if (isnan(p->seconds_left)) return assert_true(isnan(p->seconds_left_spread)), 0;
  ++s->times;
  assert_true(p->seconds_left >= 0.0 && p->seconds_left_spread > 1.0);
  return 0;
}

static jam_system *random_start(int32_t dim, int64_t n, seen *s) {
  jam_system *sys = random_spheres(dim, n, 0.0, 2);
  memset(s, 0, sizeof *s);
  assert_int_equal(jam_set_progress(sys, look, s), JAM_OK);
  return sys;
}

CASE(growth_knows_its_pressure) {
  for (int kind = 0; kind < 4; ++kind) {
    seen s;
    OWNED jam_system *sys = random_start(3, 1500, &s);
    DEFAULTS(compress, c);
    c.growth_rate = 3e-2, c.pressure = 1e4;
    if (kind == 1) c.pressure = INFINITY, c.packing_fraction = 0.6;
    if (kind == 2) c.growth_rate_end = 1e-2;
    if (kind == 3) { /* a limit comes first */
      c.collisions_per_particle = 100.0;
      assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
    } else {
      assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
    }
    print_message("growth %d: %d reports, %d with a fraction, last %.3f, %d with a time\n", kind, s.reports, s.known,
                  s.last, s.times);
    if (s.reports > 10) assert_true(s.last > 0.5);
  }
}

/* The protocol of NULL is one call: the fraction counts both stages. */
CASE(a_protocol_is_one_call) {
  seen s;
  OWNED jam_system *sys = random_start(2, 300, &s);
  assert_int_equal(jam_compress(sys, NULL, NULL), JAM_OK);
  print_message("protocol: %d reports, last %.3f\n", s.reports, s.last);
  if (s.reports > 10) assert_true(s.last > 0.8);
}

CASE(a_crunch_knows_its_gap) {
  for (int kind = 0; kind < 3; ++kind) {
    seen s;
    OWNED jam_system *sys = random_start(3, kind == 1 ? 60 : 200, &s);
    DEFAULTS(crunch, c);
    if (kind == 1) c.method = JAM_CRUNCH_SEQUENTIAL_LP;
    if (kind == 2) c.strain = JAM_STRAIN_FREE;
    assert_true(jam_crunch(sys, &c, NULL) >= 0);
    print_message("crunch %d: %d reports, %d with a fraction, last %.3f, %d with a time\n", kind, s.reports, s.known,
                  s.last, s.times);
    /* The verdict is reported; sequential LPs end before the tolerance of the gain where contacts close. */
    assert_true(s.known > 0 && s.last > (kind == 1 ? 0.3 : 0.8));
  }
}
