/* The fabric tensor against angles of a lattice, and against a sum over the positions of a packing. */
#include <math.h>

#include "steps.h"

/* Rows of touching disks, each shifted by cos(angle): contacts along (1, 0) and (cos, sin), equally many. */
CASE(sheared_lattice_has_the_tensor_of_its_two_directions) {
  enum { L = 4 };
  for (int degrees = 70; degrees <= 90; degrees += 5) {
    const double c = cos(degrees * acos(-1.0) / 180.0), s = sin(degrees * acos(-1.0) / 180.0), sigma = 1.0 - 1e-13;
    const double cell[4] = {L, 0.0, L * c, L * s}, expected[4] = {(1.0 + c * c) / 2, c * s / 2, c * s / 2, s * s / 2};
    double x[2 * L * L], fabric[4];
    OWNED jam_system *sys = NULL;
    size_t needed;
    for (int k = 0; k < L * L; ++k) x[2 * k] = k % L + k / L * c, x[2 * k + 1] = k / L * s;
    DEFAULTS(create, o);
    o.dim = 2;
    if (create_in_cell(&o, cell, 4, x, 2 * L * L, &sigma, 1, &sys) != JAM_OK) fail_msg("%s", jam_last_error());
    assert_int_equal(jam_fabric_tensor(sys, fabric, 4, &needed), JAM_E_STATE);
    assert_true(jam_contacts_from_geometry(sys, NULL, NULL) >= 0);
    assert_int_equal(jam_fabric_tensor(sys, fabric, 4, &needed), JAM_OK);
    assert_int_equal(needed, 4);
    for (int k = 0; k < 4; ++k) assert_true(fabs(fabric[k] - expected[k]) < 1e-12);
    assert_int_equal(jam_fabric_tensor(sys, fabric, 3, &needed), JAM_E_BUFFER);
  }
}

/* From positions alone, by nearest images. n_a n_b of isotropic directions has the variance 4/45 (a = b) or 1/15 in d =
 * 3: a mean over the contacts stays within five of its standard deviations. */
CASE(large_packing_is_isotropic) {
  enum { N = 500, D = 3 };
  size_t needed;
  static int32_t pair[2 * 4 * N];
  double fabric[D * D], sum[D * D] = {0.0}, trace = 0.0;
  OWNED jam_system *sys = random_spheres(D, N, 0.0, 7);
  if (jam_crunch(sys, NULL, NULL) != JAM_OK) fail_msg("%s", jam_last_error());
  const double *x = view_of(sys, JAM_VIEW_POSITIONS);
  assert_int_equal(jam_contacts(sys, pair, 2 * 4 * N, &needed), JAM_OK);
  size_t contacts = needed / 2;
  for (size_t k = 0; k < contacts; ++k) {
    double r[D], r2 = 0.0;
    for (int a = 0; a < D; ++a) {
      r[a] = x[D * pair[2 * k] + a] - x[D * pair[2 * k + 1] + a];
      r[a] -= round(r[a]);
      r2 += r[a] * r[a];
    }
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) sum[D * a + b] += r[a] * r[b] / r2;
  }
  assert_int_equal(jam_fabric_tensor(sys, fabric, D * D, NULL), JAM_OK);
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) {
      const double f = fabric[D * a + b], variance = a == b ? 4.0 / 45.0 : 1.0 / 15.0;
      assert_true(fabs(f - sum[D * a + b] / (double)contacts) < 1e-12);
      assert_true(f == fabric[D * b + a]);
      assert_true(fabs(f - (a == b ? 1.0 / D : 0.0)) < 5.0 * sqrt(variance / (double)contacts));
      if (a == b) trace += f;
    }
  assert_true(fabs(trace - 1.0) < 1e-13);
}

CASE(no_contacts_have_no_tensor) {
  const double x[4] = {0.0, 0.0, 0.5, 0.4}, sigma = 0.1;
  double fabric[4] = {0.0};
  DEFAULTS(create, o);
  o.dim = 2;
  OWNED jam_system *sys = created_from(&o, x, 4, &sigma, 1);
  assert_int_equal(jam_contacts_from_geometry(sys, NULL, NULL), JAM_NOT_JAMMED);
  assert_int_equal(jam_fabric_tensor(sys, fabric, 4, NULL), JAM_NOT_JAMMED);
  assert_true(isnan(fabric[0]) && isnan(fabric[3]));
}
