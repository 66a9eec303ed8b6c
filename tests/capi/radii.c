/* jam_maximise_radii from C: one disk and two, weights, and what a stop leaves. */
#include <jam/jam.h>
#include <math.h>
#include "test.h"

static jam_system *square(int64_t n, int64_t seed) {
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.n = n, o.dim = 2, o.seed = seed, o.walls = 3;
  assert_int_equal(jam_create(&o, NULL, &sys), JAM_OK);
  return sys;
}

CASE(known_sums) {
  const double sums[2] = {0.5, 2.0 - sqrt(2.0)};
  for (int n = 1; n <= 2; ++n) {
    jam_system *sys = square(n, n);
    SIZED(jam_radii_report, r);
    assert_int_equal(jam_maximise_radii(sys, NULL, NULL, 0, &r), JAM_OK);
    assert_true(r.maximum && fabs(r.value - sums[n - 1]) < 1e-15 && r.rattlers == 0);
    size_t contacts = 0;
    assert_int_equal(jam_forces(sys, NULL, 0, &contacts), JAM_OK);
    assert_true(contacts == (size_t)r.contacts);
    jam_destroy(sys);
  }
}

/* A weight counts a radius more: the sphere that has most of it becomes the largest. */
CASE(weights_decide) {
  const double weights[2] = {1.0, 3.0};
  jam_system *sys = square(2, 1);
  SIZED(jam_radii_report, r);
  const double *sigma = NULL;
  size_t len = 0;
  assert_int_equal(jam_maximise_radii(sys, NULL, weights, 2, &r), JAM_OK);
  assert_int_equal(jam_view(sys, JAM_VIEW_DIAMETERS, &sigma, &len), JAM_OK);
  assert_true(sigma[1] > sigma[0] && fabs(r.value - 0.5 * (sigma[0] + 3.0 * sigma[1])) < 1e-15);
  /* the large disk fills the square, the other its corner: (1/2 - r) sqrt(2) = 1/2 + r */
  const double corner = 0.5 * (sqrt(2.0) - 1.0) / (sqrt(2.0) + 1.0);
  assert_true(fabs(r.value - (1.5 + corner)) < 1e-14);
  jam_destroy(sys);
}

static int32_t stop(const jam_progress *p, void *user) {
  (void)p, (void)user;
  return 1;
}

CASE(stops_leave_a_valid_packing) {
  jam_system *sys = square(20, 1);
  DEFAULTS(radii, o);
  SIZED(jam_radii_report, r);
  o.max_steps = 2;
  assert_int_equal(jam_maximise_radii(sys, &o, NULL, 0, &r), JAM_LIMIT);
  assert_true(r.stop_reason == JAM_STOP_STEPS && r.steps == 2 && !r.maximum && r.contacts == -1 && isnan(r.min_force));
  assert_int_equal(jam_set_progress(sys, stop, NULL), JAM_OK);
  assert_int_equal(jam_maximise_radii(sys, NULL, NULL, 0, &r), JAM_CANCELLED);
  assert_true(r.stop_reason == JAM_STOP_CANCELLED);
  assert_int_equal(jam_set_progress(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_maximise_radii(sys, NULL, NULL, 0, &r), JAM_OK);
  assert_true(r.maximum == 1);
  jam_destroy(sys);
}
