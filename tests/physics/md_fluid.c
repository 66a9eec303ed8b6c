/* Fluids of hard spheres against closed forms, conservation laws, and the approach to jamming. */
#include <math.h>

#include "steps.h"

static jam_system *fluid(int64_t n, int32_t dim, double fraction) {
  DEFAULTS(create, o);
  o.n = n;
  o.dim = dim;
  o.packing_fraction = 0.5 * fraction;
  jam_system *sys = created(&o);
  DEFAULTS(compress, c);
  c.growth_rate = 0.03;
  c.pressure = 1e12;
  c.packing_fraction = fraction;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  return sys;
}

/* Carnahan and Starling, J. Chem. Phys. 51, 635 (1969). */
static double carnahan_starling(double f) { return (1 + f + f * f - f * f * f) / pow(1 - f, 3); }

/* At a density between freezing and the two of liquid_of_every_dimension. */
CASE(equation_of_state) {
  jam_system *sys = fluid(1000, 3, 0.49);
  jam_md_report report;
  double deviation;
  run(sys, 100);
  report = run(sys, 1000);
  deviation = report.pressure / carnahan_starling(0.49) - 1.0;
  print_message("p %.4f(%.4f), %+.2f %% of Carnahan-Starling\n", report.pressure, report.pressure_error,
                100 * deviation);
  assert_true(report.pressure_error < 0.005 * report.pressure);
  assert_true(fabs(deviation) < 0.005 + 2.0 * report.pressure_error / report.pressure);
  assert_true(fabs(deviation) < 0.01);
  jam_destroy(sys);
}

/* Two spheres, excluded volume v of the box: p = 1 + (v / (1 - v)) / 2 exactly (d = 3: v = 4 phi; d = 2: v = 2 phi).
 * The momentum is zero, so kT has d (N - 1) degrees of freedom; d N would give 1.667 instead of 1.333. A drift of both
 * spheres changes nothing. */
CASE(two_spheres_have_the_exact_pressure) {
  int32_t d, drift, c;
  for (d = 2; d <= 3; ++d)
    for (drift = 0; drift < 2; ++drift) {
      const double fraction = 0.1, v = ldexp(fraction, d - 1), exact = 1 + 0.5 * v / (1 - v);
      jam_system *sys = fluid(2, d, fraction);
      jam_md_report report;
      double velocities[6];
      for (c = 0; c < 2 * d; ++c) velocities[c] = (c < d ? 1.0 : -0.7) * (1.0 + 0.37 * c * c) + 3.0;
      if (drift) assert_int_equal(jam_set_velocities(sys, velocities, (size_t)(2 * d)), JAM_OK);
      report = run(sys, 25000);
      print_message("two spheres, d %d%s: p %.4f(%.4f), exact %.4f\n", d, drift ? ", drifting" : "", report.pressure,
                    report.pressure_error, exact);
      assert_true(report.pressure_error < 0.01);
      assert_true(fabs(report.pressure - exact) < 4 * report.pressure_error + 1e-3);
      jam_destroy(sys);
    }
}

/* A compression ends with <v^2> = d, so that times and growth rates of what follows are in units of kT/m = 1. */
CASE(compression_ends_at_unit_temperature) {
  jam_system *sys = fluid(300, 3, 0.5);
  const double *v;
  size_t length, k;
  double sum = 0;
  assert_int_equal(jam_view(sys, JAM_VIEW_VELOCITIES, &v, &length), JAM_OK);
  for (k = 0; k < length; ++k) sum += v[k] * v[k];
  assert_true(fabs(sum / (double)length - 1) < 1e-12);
  jam_destroy(sys);
}

/* The liquid in d = 2 .. 6 against the Pade approximant of its virial series (jam.eos of Python), at two densities up
 * to 0.85 .. 0.9 of freezing (d = 2: 0.70, 4: 0.288, 5: 0.174, 6: 0.105; van Meel, Charbonneau, Fortini and
 * Charbonneau, Phys. Rev. E 80, 061110 (2009)). N spheres of zero momentum have B_2 (N - 1) / N, hence 1 / N beside the
 * error. */
CASE(liquid_of_every_dimension) {
  static const struct {
    int32_t dim;
    int64_t n;
    double fraction, pressure;
  } at[] = {{2, 1000, 0.4, 2.82932027},  {2, 1000, 0.6, 6.45611376},  {3, 1000, 0.25, 3.08017834},
            {3, 1000, 0.44, 8.84062619}, {4, 1000, 0.15, 3.29037095}, {4, 1000, 0.25, 7.20743788},
            {5, 1000, 0.08, 3.15737641}, {5, 1000, 0.15, 7.40523206}, {6, 1000, 0.05, 3.65128801},
            {6, 1000, 0.09, 7.94019189}};
  for (size_t k = 0; k < sizeof at / sizeof *at; ++k) {
    jam_system *sys = fluid(at[k].n, at[k].dim, at[k].fraction);
    jam_md_report report;
    double deviation;
    run(sys, 50);
    report = run(sys, 200);
    deviation = report.pressure / at[k].pressure - 1.0;
    print_message("d %d, phi %.2f: p %.4f(%.4f), %+.2f %% of the Pade approximant\n", at[k].dim, at[k].fraction,
                  report.pressure, report.pressure_error, 100 * deviation);
    assert_true(fabs(deviation) < 0.003 + 3.0 * report.pressure_error / report.pressure);
    jam_destroy(sys);
  }
}

CASE(energy_and_momentum_are_conserved) {
  jam_system *sys = fluid(500, 3, 0.45);
  const double *v;
  size_t len, k;
  double before[3] = {0, 0, 0}, after[3] = {0, 0, 0};
  jam_md_report report;
  jam_view(sys, JAM_VIEW_VELOCITIES, &v, &len);
  for (k = 0; k < len; ++k) before[k % 3] += v[k];
  report = run(sys, 500);
  jam_view(sys, JAM_VIEW_VELOCITIES, &v, &len);
  for (k = 0; k < len; ++k) after[k % 3] += v[k];
  assert_true(report.energy_drift < 1e-11);
  for (k = 0; k < 3; ++k) assert_true(fabs(after[k] - before[k]) < 1e-10);
  for (k = 0; k < 3; ++k) assert_true(fabs(before[k]) < 1e-10); /* zero total momentum */
  jam_destroy(sys);
}

/* With all velocities reversed the spheres return to the start, up to rounding that grows with time. */
CASE(reversed_velocities_lead_back) {
  jam_system *sys = fluid(200, 3, 0.3);
  const double *x, *v;
  double start[600], back[600];
  size_t len, k;
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &len);
  memcpy(start, x, sizeof start);
  run(sys, 6);
  jam_view(sys, JAM_VIEW_VELOCITIES, &v, &len);
  for (k = 0; k < len; ++k) back[k] = -v[k];
  assert_int_equal(jam_set_velocities(sys, back, len), JAM_OK);
  run(sys, 6);
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &len);
  /* Both halves end at a collision, so the way back ends one collision early: within one free flight. */
  for (k = 0; k < len; ++k) {
    double dx = x[k] - start[k];
    dx -= round(dx);
    assert_true(fabs(dx) < 0.02);
  }
  jam_destroy(sys);
}

CASE(free_volume_pressure) {
  /* p = d / (1 - phi/phi_J) near jamming: phi_J from two pressures must agree. */
  jam_md_report report;
  double jammed[3];
  int k;
  report.struct_size = sizeof report;
  DEFAULTS(create, o);
  o.n = 256;
  jam_system *sys = created(&o);
  assert_int_equal(jam_compress(sys, NULL, &report), JAM_OK);
  assert_true(report.packing_fraction > 0.62 && report.packing_fraction < 0.75);
  assert_true(report.max_overlap < 1e-13);
  DEFAULTS(compress, c);
  c.growth_rate = 3e-3;
  for (k = 0; k < 3; ++k) {
    c.pressure = pow(10.0, 8 + 2 * k);
    assert_int_equal(jam_compress(sys, &c, &report), JAM_OK);
    jammed[k] = report.packing_fraction / (1.0 - 3.0 / report.pressure);
    assert_true(report.max_overlap < 1e-13);
  }
  assert_true(fabs(jammed[1] / jammed[0] - 1.0) < 1e-7);
  assert_true(fabs(jammed[2] / jammed[1] - 1.0) < 1e-9);
  jam_destroy(sys);
}
