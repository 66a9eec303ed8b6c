/* Shifts of the Mari-Kurchan model: distances that a user computes with them. */
#include <math.h>

#include "systems.h"

enum { N = 100, MOST = 20 * N };

static jam_system *fluid(int32_t dim, int32_t model, double zeta) {
  DEFAULTS(create, o);
  o.n = N, o.dim = dim, o.seed = 3, o.model = model, o.mk_zeta = zeta, o.packing_fraction = 0.6;
  if (model != JAM_MODEL_MK) o.packing_fraction = 0.2;
  return created(&o);
}

/* The gaps h of jam_gaps are r / sigma - 1 by these shifts and the nearest image, which is the only one so near. */
CASE(distances_are_those_of_the_gaps) {
  static int32_t pair[2 * MOST];
  static double gap[MOST], shift[3 * MOST];
  for (int dim = 2; dim <= 3; ++dim)
    for (int strength = 0; strength < 2; ++strength) {
      OWNED jam_system *sys = fluid(dim, JAM_MODEL_MK, strength ? INFINITY : 0.7);
      size_t gaps, needed;
      const jam_info info = info_of(sys);
      const double *x = view_of(sys, JAM_VIEW_POSITIONS);
      const double *sigma = view_of(sys, JAM_VIEW_DIAMETERS);
      assert_int_equal(jam_gaps(sys, 0.3, 0, gap, MOST, pair, 2 * MOST, &gaps), JAM_OK);
      assert_true(gaps > 50);
      assert_int_equal(jam_mk_shifts(sys, pair, 2 * gaps, shift, 3 * MOST, &needed), JAM_OK);
      assert_int_equal(needed, (size_t)dim * gaps);
      for (size_t k = 0; k < gaps; ++k) {
        const int32_t i = pair[2 * k], j = pair[2 * k + 1];
        double r2 = 0.0;
        for (int c = 0; c < dim; ++c) {
          double r = (x[dim * i + c] - x[dim * j + c] + shift[dim * k + c]) / info.box;
          r = (r - round(r)) * info.box;
          r2 += r * r;
        }
        assert_true(fabs(sqrt(r2) / (0.5 * (sigma[i] + sigma[j])) - 1.0 - gap[k]) < 1e-12);
      }
    }
}

CASE(shifts_are_antisymmetric_and_other_pairs_are_refused) {
  const int32_t pair[6] = {4, 17, 17, 4, 5, 5}, far[2] = {0, N};
  double shift[9];
  size_t needed;
  OWNED jam_system *sys = fluid(3, JAM_MODEL_MK, INFINITY), *plain = fluid(3, JAM_MODEL_EUCLID, 0.0);
  assert_int_equal(jam_mk_shifts(sys, pair, 6, shift, 9, &needed), JAM_OK);
  for (int c = 0; c < 3; ++c) {
    assert_true(shift[c] == -shift[3 + c] && shift[c] != 0.0 && fabs(shift[c]) <= 0.5);
    assert_true(shift[6 + c] == 0.0);
  }
  assert_int_equal(jam_mk_shifts(sys, pair, 6, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, 9);
  assert_int_equal(jam_mk_shifts(sys, pair, 6, shift, 8, &needed), JAM_E_BUFFER);
  assert_int_equal(jam_mk_shifts(sys, far, 2, shift, 9, &needed), JAM_E_ARGUMENT);
  assert_int_equal(jam_mk_shifts(sys, pair, 3, shift, 9, &needed), JAM_E_ARGUMENT);
  assert_int_equal(jam_mk_shifts(plain, pair, 6, shift, 9, &needed), JAM_E_UNSUPPORTED);
}
