/* jam_maximise_radii from C: one disk and two, weights, and what a stop leaves. */
#include <math.h>
#include "steps.h"

static jam_system *square(int64_t n, int64_t seed) {
  DEFAULTS(create, o);
  o.n = n, o.dim = 2, o.seed = seed, o.walls = 3;
  return created(&o);
}

CASE(known_sums) {
  const double sums[2] = {0.5, 2.0 - sqrt(2.0)};
  for (int n = 1; n <= 2; ++n) {
    OWNED jam_system *sys = square(n, n);
    SIZED(jam_radii_report, r);
    assert_int_equal(jam_maximise_radii(sys, NULL, NULL, 0, &r), JAM_OK);
    assert_true(r.maximum && fabs(r.value - sums[n - 1]) < 1e-15 && r.rattlers == 0);
    size_t contacts = 0;
    assert_int_equal(jam_forces(sys, NULL, 0, &contacts), JAM_OK);
    assert_true(contacts == (size_t)r.contacts);
  }
}

/* A weight counts a radius more: the sphere that has most of it becomes the largest. */
CASE(weights_decide) {
  const double weights[2] = {1.0, 3.0};
  OWNED jam_system *sys = square(2, 1);
  SIZED(jam_radii_report, r);
  assert_int_equal(jam_maximise_radii(sys, NULL, weights, 2, &r), JAM_OK);
  const double *const sigma = view_of(sys, JAM_VIEW_DIAMETERS);
  assert_true(sigma[1] > sigma[0] && fabs(r.value - 0.5 * (sigma[0] + 3.0 * sigma[1])) < 1e-15);
  /* the large disk fills the square, the other its corner: (1/2 - r) sqrt(2) = 1/2 + r */
  const double corner = 0.5 * (sqrt(2.0) - 1.0) / (sqrt(2.0) + 1.0);
  assert_true(fabs(r.value - (1.5 + corner)) < 1e-14);
}

/* Two moments fix the ratio of two disks, whose radii add up to 2 - sqrt(2) in a square. */
CASE(moments_grow_by_one_factor) {
  const double ratio[2] = {1.0, 1.5};
  double before[2], square;
  DEFAULTS(create, c);
  c.n = 2, c.dim = 2, c.seed = 1, c.walls = 3;
  OWNED jam_system *sys = created_from(&c, NULL, 0, ratio, 2);
  const double *const sigma = view_of(sys, JAM_VIEW_DIAMETERS);
  before[0] = sigma[0], before[1] = sigma[1];
  DEFAULTS(radii, o);
  SIZED(jam_radii_report, r);
  assert_true(o.moments == 0 && o.exponent_1 == 1.0 && o.exponent_4 == 4.0);
  o.moments = 2;
  assert_int_equal(jam_maximise_radii(sys, &o, NULL, 0, &r), JAM_OK);
  assert_true(r.maximum && fabs(0.5 * (sigma[0] + sigma[1]) - (2.0 - sqrt(2.0))) < 1e-14);
  assert_true(fabs(sigma[0] / before[0] / r.value - 1.0) < 1e-14 && fabs(sigma[1] / before[1] / r.value - 1.0) < 1e-14);
  assert_true(r.moment_residual < 1e-14 && !isnan(r.multiplier_2) && isnan(r.multiplier_3));
  /* forces on sphere i: lambda_1 + 2 lambda_2 R_i, and sum_q q lambda_q M_q = lambda */
  square = 0.25 * (sigma[0] * sigma[0] + sigma[1] * sigma[1]);
  assert_true(fabs(0.5 * r.multiplier_1 * (sigma[0] + sigma[1]) + 2.0 * r.multiplier_2 * square - r.value) < 1e-12);
}

/* One disk in a cell that deforms: the triangular lattice of volume 1, strictly jammed by its own images. */
CASE(a_cell_deforms_at_fixed_volume) {
  double cell[4];
  size_t len = 0;
  DEFAULTS(radii, o);
  SIZED(jam_radii_report, r);
  SIZED(jam_crunch_report, verdict);
  OWNED jam_system *sys = random_spheres(2, 1, 0.0, 1);
  assert_int_equal(o.strain, JAM_STRAIN_NONE);
  o.strain = JAM_STRAIN_FREE;
  assert_int_equal(jam_maximise_radii(sys, &o, NULL, 0, &r), JAM_OK);
  assert_true(r.maximum && fabs(r.value - pow(12.0, -0.25)) < 1e-15 && r.contacts == 3 && r.excess == 0);
  assert_int_equal(jam_get_cell(sys, cell, 4, &len), JAM_OK);
  assert_true(fabs(cell[0] * cell[3] - 1.0) < 1e-15 && fabs(fabs(cell[2]) - 0.5 * cell[0]) < 1e-14);
  assert_int_equal(jam_get_crunch_report(sys, &verdict), JAM_OK);
  assert_true(verdict.jammed == 1 && verdict.strictly_jammed == JAM_VERDICT_YES);
  jam_destroy(sys);
  sys = square(3, 1);
  assert_int_equal(jam_maximise_radii(sys, &o, NULL, 0, &r), JAM_E_UNSUPPORTED);
}

CASE(stops_leave_a_valid_packing) {
  OWNED jam_system *sys = square(20, 1);
  DEFAULTS(radii, o);
  SIZED(jam_radii_report, r);
  o.max_steps = 2;
  assert_int_equal(jam_maximise_radii(sys, &o, NULL, 0, &r), JAM_LIMIT);
  assert_true(r.stop_reason == JAM_STOP_STEPS && r.steps == 2 && !r.maximum && r.contacts == -1 && isnan(r.min_force));
  assert_int_equal(jam_set_progress(sys, stop_at_once, NULL), JAM_OK);
  assert_int_equal(jam_maximise_radii(sys, NULL, NULL, 0, &r), JAM_CANCELLED);
  assert_true(r.stop_reason == JAM_STOP_CANCELLED);
  assert_int_equal(jam_set_progress(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_maximise_radii(sys, NULL, NULL, 0, &r), JAM_OK);
  assert_true(r.maximum == 1);
}
