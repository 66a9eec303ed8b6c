/* Molecular dynamics in cells that are no cubes: the fluid's pressure, conservation laws, two spheres exactly, shear by
 * steps, and the way to a jammed packing. */
#include <math.h>

#include "systems.h"

/* Primitive vectors of the face-centred cubic lattice: the cell of nearest points is a rhombic dodecahedron. */
static const double rhombic[9] = {0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0};
static const double monoclinic[9] = {1.0, 0.0, 0.0, 0.0, 1.3, 0.0, 0.4, 0.0, 0.8};
static const double cube[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
/* The monoclinic lattice by other vectors, one of them with tilt 5. */
static const double far_monoclinic[9] = {1.0, 1.3, 0.0, 0.0, 1.3, 0.0, 5.4, 1.3, 0.8};

static jam_system *fluid(const double *cell, int64_t n, int32_t dim, double fraction) {
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.n = n, o.dim = dim, o.packing_fraction = 0.5 * fraction;
  if (create_in_cell(&o, cell, (size_t)(dim * dim), NULL, 0, NULL, 0, &sys) < 0) print_error("%s\n", jam_last_error());
  assert_non_null(sys);
  DEFAULTS(compress, c);
  c.growth_rate = 0.03, c.pressure = 1e12, c.packing_fraction = fraction;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  return sys;
}

static jam_md_report run(jam_system *sys, double collisions_per_particle) {
  jam_md_report report = {.struct_size = sizeof report};
  DEFAULTS(run, r);
  r.collisions_per_particle = collisions_per_particle;
  assert_int_equal(jam_run(sys, &r, &report), JAM_OK);
  return report;
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
    jam_system *sys = fluid(cells[k], 1000, 3, fraction);
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
    jam_destroy(sys);
  }
}

/* Two disks: p = 1 + (v / (1 - v)) / 2 with v = pi sigma^2 / V = 4 phi / 2, in every cell that v fits into. */
CASE(two_disks_have_the_exact_pressure) {
  const double cell[4] = {1.0, 0.0, 0.45, 0.8}, fraction = 0.1, v = 2 * fraction, exact = 1 + 0.5 * v / (1 - v);
  jam_system *sys = fluid(cell, 2, 2, fraction);
  const jam_md_report r = run(sys, 200000);
  print_message("two disks: p %.4f(%.4f), exact %.4f\n", r.pressure, r.pressure_error, exact);
  assert_true(r.pressure_error < 0.01);
  assert_true(fabs(r.pressure - exact) < 4 * r.pressure_error + 1e-3);
  jam_destroy(sys);
}

/* Lees-Edwards boundaries by steps. A simple shear g shortens no vector by more than the factor
 * sqrt(1 + g^2 / 4) - g / 2: diameters scaled by it cannot overlap. They grow back while the spheres move. After a
 * strain of 1 the lattice is what it was. */
CASE(shear_by_steps) {
  const double fraction = 0.4, exact = (1 + fraction + fraction * fraction - pow(fraction, 3)) / pow(1 - fraction, 3),
               step = 0.05, least = sqrt(1 + 0.25 * step * step) - 0.5 * step;
  const double shear[9] = {0.0, step, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  double cell[9], energy[2], momentum[3], sum = 0.0;
  jam_system *sys = fluid(cube, 400, 3, fraction);
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
  jam_destroy(sys);
}

/* Grown in a tilted cell to p = 1e6, then crunched: jammed with as many contacts as statics needs. */
CASE(grown_and_crunched) {
  jam_system *sys = fluid(monoclinic, 200, 3, 0.4);
  jam_crunch_report r = {.struct_size = sizeof r};
  jam_md_report m = {.struct_size = sizeof m};
  assert_int_equal(jam_compress(sys, NULL, &m), JAM_OK);
  assert_true(m.pressure >= 1e6 && m.max_overlap < 1e-13);
  const jam_info before = info_of(sys);
  assert_int_equal(jam_crunch(sys, NULL, &r), JAM_OK);
  print_message("grown to p %.3g, phi %.9f; crunched phi %.9f, %lld contacts, excess %lld, residual %.1e\n", m.pressure,
                before.packing_fraction, r.packing_fraction, (long long)r.contacts, (long long)r.excess_contacts,
                r.force_residual);
  assert_int_equal(r.jammed, 1);
  assert_int_equal(r.excess_contacts, 0);
  assert_true(r.max_overlap < 1e-13 && r.force_residual < 1e-12);
  /* p = d / (1 - phi / phi_J) at rest: 3e-7 is missing, and a few times that in a packing that was growing. */
  assert_true(fabs(r.packing_fraction / before.packing_fraction - 1) < 1e-5);
  jam_destroy(sys);
}
