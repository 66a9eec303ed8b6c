/* Soft spheres near jamming: the laws of energy and pressure, and forces by |h|^(alpha-1) and by the null vector. */
#include "columns.h"
#include "steps.h"

#include <math.h>
#include <stdlib.h>

static double *column(const jam_system *sys, size_t which, size_t *n) {
  assert_int_equal(column_of(jam_decompress_history, sys, JAM_SOFT_SECONDS + 1, which, NULL, 0, n), JAM_OK);
  double *x = malloc(*n * sizeof *x);
  assert_int_equal(column_of(jam_decompress_history, sys, JAM_SOFT_SECONDS + 1, which, x, *n, n), JAM_OK);
  return x;
}

/* Below the last change of contacts U ~ (ln R - ln R_J)^alpha exactly, and the pressure goes with alpha - 1. */
CASE(energy_and_pressure) {
  const double alphas[] = {2.0, 2.5};
  for (int a = 0; a < 2; ++a) {
    OWNED jam_system *sys = soft_start(64, 0.72, 2);
    jam_decompress_report r = {.struct_size = sizeof r};
    DEFAULTS(decompress, o);
    o.alpha = alphas[a], o.isostatic = 0, o.crunch = 0, o.distance = 1e-10;
    assert_int_equal(jam_decompress(sys, &o, &r), JAM_OK);
    assert_true(r.force_residual < 1e-12 && r.excess_contacts == 0 && r.isostatic == 1);
    size_t n;
    double *e = column(sys, JAM_SOFT_ENERGY, &n), *p = column(sys, JAM_SOFT_PRESSURE, &n),
           *phi = column(sys, JAM_SOFT_PHI, &n), *x = column(sys, JAM_SOFT_DISTANCE, &n);
    const double fraction = pow(r.jammed_fraction, 1.0 / 3.0);
    /* The last two minima have one network: exact laws, to the order of the distance. */
    const double decades = log(x[n - 2] / x[n - 1]);
    assert_true(fabs(log(e[n - 2] / e[n - 1]) / decades - alphas[a]) < 1e-5);
    assert_true(fabs(log(p[n - 2] / p[n - 1]) / decades - (alphas[a] - 1.0)) < 1e-5);
    for (size_t k = n - 2; k < n; ++k)
      assert_true(fabs(pow(phi[k], 1.0 / 3.0) / fraction - 1.0 - x[k]) < 1e-3 * x[k] + 1e-15);
    free(e), free(p), free(phi), free(x);
  }
}

/* The network from above is crunch's from below; so is phi_J, and far down the forces. */
CASE(both_ways_to_jamming) {
  for (int64_t seed = 1; seed <= 3; ++seed) {
    OWNED jam_system *sys = soft_start(64, 0.70, seed);
    jam_decompress_report r = {.struct_size = sizeof r};
    DEFAULTS(decompress, o);
    o.isostatic = 0, o.distance = 1e-11;
    assert_int_equal(jam_decompress(sys, &o, &r), JAM_OK);
    assert_true(r.same_network == 1 && r.common_contacts == r.contacts);
    assert_true(fabs(r.jammed_fraction / r.crunch_fraction - 1.0) < 1e-12);
    assert_true(r.force_difference < 1e-4);
  }
}

/* A ladder of calls: each starts at a minimum, which takes hardly any evaluations and so sets no scale for later steps.
 */
CASE(call_after_call) {
  const double alphas[] = {2.0, 2.5, 1.5};
  for (int a = 0; a < 3; ++a) {
    OWNED jam_system *sys = soft_start(64, 0.72, 1);
    jam_decompress_report r = {.struct_size = sizeof r};
    DEFAULTS(decompress, o);
    o.alpha = alphas[a], o.isostatic = 0, o.crunch = 0, o.energy_factor = 0.1;
    if (o.alpha < 2.0) o.minimiser = JAM_MINIMISER_LBFGS; /* contacts stiffen as they open */
    for (o.distance = 1e-2; o.distance > 1e-5; o.distance *= 0.5) {
      assert_int_equal(jam_decompress(sys, &o, &r), JAM_OK);
      assert_true(r.distance <= o.distance && r.force_residual <= o.force_tolerance);
    }
  }
}
