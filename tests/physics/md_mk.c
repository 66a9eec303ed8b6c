/* The Mari-Kurchan model: exact equation of state, planting, and compression to jamming. */
#include <math.h>

#include "steps.h"

static jam_system *planted(int64_t n, int32_t dim, double fraction, double zeta, int64_t seed) {
  DEFAULTS(create, o);
  o.n = n, o.dim = dim, o.seed = seed, o.packing_fraction = fraction;
  o.model = JAM_MODEL_MK, o.mk_zeta = zeta;
  return created(&o);
}

/* p = 1 + 2^d phi / 2 for zeta infinite. Planted starts are in equilibrium, so it holds at once and also beyond the
 * dynamical transition (1.776 in d = 3). With N spheres each shift is uniform over what a pair leaves free, the box
 * less 2^d phi / N of it, so that exactly p = 1 + 2^(d-1) phi / (1 - 2^d phi / N). A shift strength of a whole number
 * of boxes is as good as infinite. */
CASE(equation_of_state) {
  const struct {
    int32_t dim;
    double fraction, zeta;
  } cases[] = {{3, 0.5, INFINITY}, {3, 1.5, INFINITY}, {3, 2.2, INFINITY},
               {2, 1.0, INFINITY}, {4, 0.5, INFINITY}, {3, 1.0, 3.0}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
    /* One quenched sample fluctuates: the mean over some. */
    const double excluded = pow(2.0, cases[k].dim) * cases[k].fraction;
    const double exact = 1.0 + 0.5 * excluded / (1.0 - excluded / 256.0);
    double sum = 0.0, square = 0.0, error;
    const int samples = 4;
    for (int64_t seed = 1; seed <= samples; ++seed) {
      OWNED jam_system *sys = planted(256, cases[k].dim, cases[k].fraction, cases[k].zeta, seed);
      const jam_md_report report = run(sys, 100.0);
      assert_true(report.max_overlap < 1e-13 && report.energy_drift < 1e-12);
      sum += report.pressure / samples;
      square += report.pressure * report.pressure / samples;
    }
    error = sqrt(fmax(0.0, square - sum * sum) / (samples - 1));
    print_message("d %d, phi %.2f, zeta %g: p %.4f(%.4f), exact %.4f\n", cases[k].dim, cases[k].fraction, cases[k].zeta,
                  sum, error, exact);
    assert_true(fabs(sum / exact - 1.0) < 0.01 + 2.0 * error / exact && error < 0.03 * exact);
  }
}

/* zeta = 0 is the Euclidean model, bit for bit as far as the start goes. */
CASE(no_shift_is_euclidean) {
  OWNED jam_system *a = planted(60, 3, 0.2, 0.0, 4);
  DEFAULTS(create, o);
  o.n = 60, o.seed = 4;
  OWNED jam_system *b = created(&o);
  same_view(a, b, JAM_VIEW_POSITIONS);
  assert_true(fabs(run(a, 100.0).pressure - run(b, 100.0).pressure) < 0.2);
}

CASE(too_dense_planting_is_refused) {
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.n = 3;
  o.packing_fraction = 2.5; /* three spheres wider than the box */
  o.model = JAM_MODEL_MK;
  assert_int_equal(jam_create(&o, NULL, &sys), JAM_E_UNPLACEABLE);
  assert_null(sys);
}
