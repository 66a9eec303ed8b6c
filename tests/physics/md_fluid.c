/* Fluids of hard spheres in cells of any shape against closed forms, conservation laws, shear by steps, and the
 * approach to jamming. */
#include <math.h>

#include "steps.h"

/* Primitive vectors of the face-centred cubic lattice: the cell of nearest points is a rhombic dodecahedron. */
static const double rhombic[9] = {0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0};
static const double monoclinic[9] = {1.0, 0.0, 0.0, 0.0, 1.3, 0.0, 0.4, 0.0, 0.8};
static const double cube[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
/* The monoclinic lattice by other vectors, one of them with tilt 5. */
static const double far_monoclinic[9] = {1.0, 1.3, 0.0, 0.0, 1.3, 0.0, 5.4, 1.3, 0.8};

/* cell: NULL for a cube. */
static jam_system *fluid(const double *cell, int64_t n, int32_t dim, double fraction) {
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.n = n, o.dim = dim, o.packing_fraction = 0.5 * fraction;
  assert_int_equal(create_in_cell(&o, cell, cell ? (size_t)(dim * dim) : 0, NULL, 0, NULL, 0, &sys), JAM_OK);
  DEFAULTS(compress, c);
  c.growth_rate = 0.03, c.pressure = 1e12, c.packing_fraction = fraction;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  return sys;
}

/* Two spheres, excluded volume v of the box: p = 1 + (v / (1 - v)) / 2 exactly (d = 3: v = 4 phi; d = 2: v = 2 phi).
 * The momentum is zero, so kT has d (N - 1) degrees of freedom; d N would give 1.667 instead of 1.333. A drift of both
 * spheres changes nothing. */
CASE(two_spheres_have_the_exact_pressure) {
  for (int32_t d = 2; d <= 3; ++d)
    for (int32_t drift = 0; drift < 2; ++drift) {
      const double fraction = 0.1, v = ldexp(fraction, d - 1), exact = 1 + 0.5 * v / (1 - v);
      OWNED jam_system *sys = fluid(NULL, 2, d, fraction);
      jam_md_report report;
      double velocities[6];
      for (int32_t c = 0; c < 2 * d; ++c) velocities[c] = (c < d ? 1.0 : -0.7) * (1.0 + 0.37 * c * c) + 3.0;
      if (drift) assert_int_equal(jam_set_velocities(sys, velocities, (size_t)(2 * d)), JAM_OK);
      report = run(sys, 25000);
      print_message("two spheres, d %d%s: p %.4f(%.4f), exact %.4f\n", d, drift ? ", drifting" : "", report.pressure,
                    report.pressure_error, exact);
      assert_true(report.pressure_error < 0.01);
      assert_true(fabs(report.pressure - exact) < 4 * report.pressure_error + 1e-3);
    }
}

/* A compression ends with <v^2> = d, so that times and growth rates of what follows are in units of kT/m = 1. */
CASE(compression_ends_at_unit_temperature) {
  OWNED jam_system *sys = fluid(NULL, 300, 3, 0.5);
  const double *v;
  size_t length;
  double sum = 0;
  assert_int_equal(jam_view(sys, JAM_VIEW_VELOCITIES, &v, &length), JAM_OK);
  for (size_t k = 0; k < length; ++k) sum += v[k] * v[k];
  assert_true(fabs(sum / (double)length - 1) < 1e-12);
}

/* The liquid in d = 2 .. 6 against the Pade approximant of its virial series (jam.eos of Python), up to 0.85 .. 0.9 of
 * freezing (d = 2: 0.70, 4: 0.288, 5: 0.174, 6: 0.105; van Meel, Charbonneau, Fortini and Charbonneau, Phys. Rev. E 80,
 * 061110 (2009)), and a dilute gas, whose pairs are found in cells alone. N spheres of zero momentum have
 * B_2 (N - 1) / N, hence 1 / N beside the error. */
CASE(liquid_of_every_dimension) {
  static const struct {
    int32_t dim;
    double fraction, pressure;
  } at[] = {{2, 0.6, 6.45611376},  {3, 0.05, 1.22748},    {3, 0.44, 8.84062619},
            {4, 0.25, 7.20743788}, {5, 0.15, 7.40523206}, {6, 0.09, 7.94019189}};
  for (size_t k = 0; k < sizeof at / sizeof *at; ++k) {
    OWNED jam_system *sys = fluid(NULL, 1000, at[k].dim, at[k].fraction);
    jam_md_report report;
    double deviation;
    run(sys, 50);
    report = run(sys, 200);
    deviation = report.pressure / at[k].pressure - 1.0;
    print_message("d %d, phi %.2f: p %.4f(%.4f), %+.2f %% of the Pade approximant\n", at[k].dim, at[k].fraction,
                  report.pressure, report.pressure_error, 100 * deviation);
    assert_true(fabs(deviation) < 0.003 + 3.0 * report.pressure_error / report.pressure);
  }
}

CASE(free_volume_pressure) {
  /* p = d / (1 - phi/phi_J) near jamming: phi_J from two pressures must agree. */
  jam_md_report report;
  double jammed[3];
  report.struct_size = sizeof report;
  DEFAULTS(create, o);
  o.n = 256;
  OWNED jam_system *sys = created(&o);
  assert_int_equal(jam_compress(sys, NULL, &report), JAM_OK);
  assert_true(report.packing_fraction > 0.62 && report.packing_fraction < 0.75);
  assert_true(report.max_overlap < 1e-13);
  DEFAULTS(compress, c);
  c.growth_rate = 3e-3;
  for (int k = 0; k < 3; ++k) {
    c.pressure = pow(10.0, 8 + 2 * k);
    assert_int_equal(jam_compress(sys, &c, &report), JAM_OK);
    jammed[k] = report.packing_fraction / (1.0 - 3.0 / report.pressure);
    assert_true(report.max_overlap < 1e-13);
  }
  assert_true(fabs(jammed[1] / jammed[0] - 1.0) < 1e-7);
  assert_true(fabs(jammed[2] / jammed[1] - 1.0) < 1e-9);
}

/* Sum of v^2 and the momentum. */
static void moments(const jam_system *sys, double *energy, double *momentum) {
  const double *v = NULL;
  size_t len = 0;
  assert_int_equal(jam_view(sys, JAM_VIEW_VELOCITIES, &v, &len), JAM_OK);
  *energy = momentum[0] = momentum[1] = momentum[2] = 0.0;
  for (size_t k = 0; k < len; ++k) *energy += v[k] * v[k], momentum[k % 3] += v[k];
}

/* Carnahan and Starling, J. Chem. Phys. 51, 635 (1969). The shape of a large cell does not matter. */
CASE(equation_of_state) {
  const double *const cells[] = {cube, monoclinic, far_monoclinic, rhombic};
  const double fraction = 0.45, exact = (1 + fraction + fraction * fraction - pow(fraction, 3)) / pow(1 - fraction, 3);
  for (int k = 0; k < 4; ++k) {
    OWNED jam_system *sys = fluid(cells[k], 1000, 3, fraction);
    double energy[2], momentum[3];
    run(sys, 50);
    moments(sys, energy, momentum);
    const jam_md_report r = run(sys, 500);
    moments(sys, energy + 1, momentum);
    print_message("cell %d: p %.4f(%.4f), %+.2f %% of Carnahan-Starling\n", k, r.pressure, r.pressure_error,
                  100 * (r.pressure / exact - 1));
    assert_true(r.pressure_error < 0.005 * exact);
    assert_true(fabs(r.pressure / exact - 1) < 0.003 + 4 * r.pressure_error / exact);
    assert_true(r.max_overlap < 1e-13);
    assert_true(fabs(energy[1] / energy[0] - 1) < 1e-12);
    for (int c = 0; c < 3; ++c) assert_true(fabs(momentum[c]) < 1e-9);
  }
}

/* Lees-Edwards boundaries by steps. A simple shear g shortens no vector by more than the factor
 * sqrt(1 + g^2 / 4) - g / 2: diameters scaled by it cannot overlap. They grow back while the spheres move. After a
 * strain of 1 the lattice is what it was. */
CASE(shear_by_steps) {
  const double fraction = 0.4, exact = (1 + fraction + fraction * fraction - pow(fraction, 3)) / pow(1 - fraction, 3),
               step = 0.05, least = sqrt(1 + 0.25 * step * step) - 0.5 * step;
  const double shear[9] = {0.0, step, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  double cell[9], energy[2], momentum[3], sum = 0.0;
  OWNED jam_system *sys = fluid(cube, 400, 3, fraction);
  assert_int_equal(jam_strain(sys, shear, 9), JAM_E_OVERLAP); /* as it stands */
  for (int k = 0; k < 20; ++k) {
    DEFAULTS(compress, c);
    c.growth_rate = 0.1, c.pressure = 1e12, c.packing_fraction = fraction;
    assert_int_equal(jam_scale_diameters(sys, least), JAM_OK);
    moments(sys, energy, momentum);
    assert_int_equal(jam_strain(sys, shear, 9), JAM_OK);
    moments(sys, energy + 1, momentum);
    assert_true(fabs(energy[1] / energy[0] - 1) < 1e-13); /* velocities are peculiar: they stay */
    assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
    sum += run(sys, 100).pressure / 20;
    const jam_info info = info_of(sys);
    assert_true(fabs(info.packing_fraction / fraction - 1) < 1e-12);
    assert_int_equal(jam_get_cell(sys, cell, 9, NULL), JAM_OK);
    for (int c = 0; c < 9; ++c) assert_true(fabs(cell[c] - cube[c] - (c == 3 ? step * (k + 1) : 0.0)) < 1e-13);
  }
  print_message("shear by steps: mean p %.4f, Carnahan-Starling %.4f\n", sum, exact);
  assert_true(fabs(sum / exact - 1) < 0.02);
}
