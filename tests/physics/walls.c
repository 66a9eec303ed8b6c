/* Hard spheres between walls in equilibrium and on the way to jamming, against exact results. */
#include "walls.h"
#include <math.h>
#include "systems.h"

static void run(jam_system *sys, double collisions, jam_md_report *report) {
  DEFAULTS(run, o);
  o.collisions_per_particle = collisions;
  report->struct_size = sizeof *report;
  assert_int_equal(jam_run(sys, &o, report), JAM_OK);
}

/* Alone, each component of the velocity is kept but for its sign: wall x takes 2 v_x every 2 (L - sigma) / v_x, so that
 * beta P V = d v_x^2 / v^2 L / (L - sigma). */
CASE(one_sphere_has_its_exact_pressure) {
  const walled box = {"box", 3, JAM_CONTAINER_BRICK, 7, {1.0, 2.0, 1.5}};
  const double v[] = {0.7, -1.9, 1.1}, x[] = {0.4, 1.1, 0.8}, sigma = 0.3;
  jam_md_report report;
  OWNED jam_system *sys = NULL;
  assert_int_equal(create_walled(&box, 1, 0.01, 1, NULL, &sys), JAM_OK);
  const double *diameter, v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  double sum = 0.0;
  assert_int_equal(jam_set_positions(sys, x, 3), JAM_OK);
  diameter = view_of(sys, JAM_VIEW_DIAMETERS);
  assert_int_equal(jam_scale_diameters(sys, sigma / diameter[0]), JAM_OK);
  assert_int_equal(jam_set_velocities(sys, v, 3), JAM_OK);
  run(sys, 4e5, &report);
  for (int w = 0; w < 6; ++w) {
    const int c = w / 2;
    const double exact = 3.0 * v[c] * v[c] / v2 * box.edge[c] / (box.edge[c] - sigma);
    /* One collision more or less at the ends, of some 4e4 at the slowest wall. */
    assert_true(fabs(of_wall(sys, w, JAM_WALL_PRESSURE) / exact - 1.0) < 1e-3);
    sum += of_wall(sys, w, JAM_WALL_PRESSURE) / 6.0;
  }
  assert_true(fabs(report.pressure / sum - 1.0) < 1e-3); /* the virial: the mean of the three axes */
  assert_true(report.energy_drift < 1e-12);
}

/* Between two walls its motion along them is a drift, as that of all spheres together is. So z has all of the heat, and
 * beta P V / N = L / (L - sigma), whatever velocities the seed has drawn. */
CASE(one_sphere_between_two_walls) {
  for (int seed = 1; seed <= 5; ++seed) {
    OWNED jam_system *sys = NULL;
    jam_md_report report;
    assert_int_equal(create_walled(&walled_scenes[SLIT], 1, 0.01, seed, NULL, &sys), JAM_OK);
    const double *diameter = view_of(sys, JAM_VIEW_DIAMETERS);
    const double exact = 1.0 / (1.0 - diameter[0]);
    run(sys, 1e5, &report);
    for (int w = 0; w < 2; ++w) assert_true(fabs(of_wall(sys, w, JAM_WALL_PRESSURE) / exact - 1.0) < 1e-3);
    assert_true(fabs(report.pressure / (1.0 + (exact - 1.0) / 3.0) - 1.0) < 1e-3); /* one of three axes */
  }
}

CASE(energy_is_kept_and_walls_agree_with_the_virial) {
  for (int k = 0; k < WALLED; ++k) {
    const walled *s = &walled_scenes[k];
    OWNED jam_system *sys = NULL;
    jam_md_report report;
    double mean = 0.0, axes = 0.0;
    assert_int_equal(create_walled(s, 100, s->dim == 2 ? 0.35 : 0.2, 11, NULL, &sys), JAM_OK);
    run(sys, 100.0, &report);
    run(sys, 10000.0, &report);
    assert_true(report.collisions >= 500000 && report.energy_drift < 1e-11);
    /* P on opposite walls is the same: where they have taken different momentum, the gas has kept the difference. Where
     * all axes are closed P V by the virial is the mean over axes, but for sum r . v at both ends, 1e-4 of its integral
     * over 1e4 collisions of a sphere. */
    for (int w = 0; w < count_walls(sys); ++w) {
      const double p = of_wall(sys, w, JAM_WALL_PRESSURE);
      const int axis = (int)of_wall(sys, w, JAM_WALL_AXIS);
      const double share = axis < s->dim ? 0.5 : s->container == JAM_CONTAINER_CYLINDER ? 2.0 : s->dim;
      if (axis < s->dim && w % 2) assert_true(fabs(p / of_wall(sys, w - 1, JAM_WALL_PRESSURE) - 1.0) < 0.005);
      mean += share * p, axes += share;
      assert_true(of_wall(sys, w, JAM_WALL_GAP) > -1e-12);
    }
    if (axes == s->dim) assert_true(fabs(mean / s->dim / report.pressure - 1.0) < 1e-3);
  }
}

/* Carnahan and Starling, J. Chem. Phys. 51, 635 (1969). */
static double carnahan_starling(double phi) { return (1.0 + phi + phi * phi - phi * phi * phi) / pow(1.0 - phi, 3.0); }

/* In a wide slit the density at contact is beta P of the wall (contact theorem), and P is that of the bulk in the
 * middle. Density at contact: counts in layers, extrapolated by a line. */
CASE(contact_theorem_and_bulk_pressure) {
  const walled slit = {"wide slit", 3, JAM_CONTAINER_BRICK, 4, {1.0, 1.0, 2.4}};
  enum { N = 400, SAMPLES = 1500 };
  OWNED jam_system *sys = NULL;
  jam_md_report report;
  const double *x, *sigma;
  double wall = 0.0, middle = 0.0, near[2] = {0.0, 0.0};
  assert_int_equal(create_walled(&slit, N, 0.25, 3, NULL, &sys), JAM_OK);
  x = view_of(sys, JAM_VIEW_POSITIONS);
  sigma = view_of(sys, JAM_VIEW_DIAMETERS);
  const double s = sigma[0], width = 0.04 * s, centre = 1.2, half = 2.5 * s;
  run(sys, 100.0, &report);
  for (int k = 0; k < SAMPLES; ++k) {
    run(sys, 4.0, &report);
    wall += 0.5 * (of_wall(sys, 0, JAM_WALL_PRESSURE) + of_wall(sys, 1, JAM_WALL_PRESSURE)) / SAMPLES;
    for (size_t i = 0; i < N; ++i) {
      const double z = x[3 * i + 2], from = fmin(z, 2.4 - z) - 0.5 * s;
      middle += fabs(z - centre) < half;
      if (from < 2.0 * width) near[from >= width] += 1.0;
    }
  }
  const double volume = 2.4, phi = middle / SAMPLES / (2.0 * half) * M_PI / 6.0 * s * s * s;
  const double beta_p = wall * N / volume; /* 1 / box^3 */
  const double first = near[0] / SAMPLES / (2.0 * width), second = near[1] / SAMPLES / (2.0 * width);
  const double contact = 1.5 * first - 0.5 * second; /* at the wall, from the middles of two layers */
  const double bulk = carnahan_starling(phi) * phi / (M_PI / 6.0 * s * s * s);
  print_message("beta P sigma^3: walls %.4f, contact density %.4f, bulk of the middle %.4f\n", beta_p * s * s * s,
                contact * s * s * s, bulk * s * s * s);
  /* About 1e4 spheres in the layers: one per cent each, doubled by the extrapolation. */
  assert_true(fabs(contact / beta_p - 1.0) < 0.06);
  assert_true(fabs(bulk / beta_p - 1.0) < 0.02);
}

CASE(growth_ends_without_overlap) {
  for (int k = 0; k < WALLED; ++k)
    for (int fine = 0; fine < 2; ++fine) {
      const walled *s = &walled_scenes[k];
      double sizes[80];
      OWNED jam_system *sys = NULL;
      jam_md_report report = {.struct_size = sizeof report};
      for (int i = 0; i < 80; ++i) sizes[i] = i % 2 ? 1.0 : 1.4;
      assert_int_equal(create_walled(s, 80, 0.15, 2 + fine, sizes, &sys), JAM_OK);
      DEFAULTS(compress, o);
      o.pressure = fine ? 1e10 : 1e6;
      const jam_status status = jam_compress(sys, &o, &report);
      if (status != JAM_OK) print_message("%s: %s\n", s->name, jam_last_error());
      assert_int_equal(status, JAM_OK);
      assert_true(report.max_overlap < 1e-12);
      int touched = 0;
      for (int w = 0; w < count_walls(sys); ++w) {
        const double h = of_wall(sys, w, JAM_WALL_GAP);
        assert_true(h > -1e-12);
        touched += h < 1e3 / o.pressure;
      }
      assert_true(touched > 0);
    }
}

/* Monte Carlo has its own geometry: its pressure is that of molecular dynamics. */
CASE(monte_carlo_agrees) {
  const int scenes[] = {SLIT, CAN, CIRCLE};
  for (int k = 0; k < 3; ++k) {
    const walled *s = &walled_scenes[scenes[k]];
    OWNED jam_system *sys = NULL;
    jam_md_report md;
    jam_monte_carlo_report mc = {.struct_size = sizeof mc};
    DEFAULTS(monte_carlo, o);
    assert_int_equal(create_walled(s, 100, s->dim == 2 ? 0.35 : 0.2, 5, NULL, &sys), JAM_OK);
    run(sys, 100.0, &md);
    run(sys, 4000.0, &md);
    o.sweeps = 20000;
    assert_int_equal(jam_monte_carlo(sys, &o, &mc), JAM_OK);
    print_message("%s: p %.4f by molecular dynamics, %.4f(%.4f) by Monte Carlo\n", s->name, md.pressure, mc.pressure,
                  mc.pressure_error);
    assert_true(fabs(mc.pressure - md.pressure) < 5.0 * mc.pressure_error + 0.01 * md.pressure);
    for (int w = 0; w < count_walls(sys); ++w) assert_true(of_wall(sys, w, JAM_WALL_GAP) > -1e-12);
  }
}

CASE(flat_walls_hold_in_four_and_five_dimensions) {
  const walled s[] = {{"slit of d = 4", 4, JAM_CONTAINER_BRICK, 8, {1, 1, 1, 1}},
                      {"box of d = 5", 5, JAM_CONTAINER_BRICK, 31, {1, 1, 1, 1, 1}}};
  for (int k = 0; k < 2; ++k) {
    OWNED jam_system *sys = NULL;
    jam_md_report report;
    assert_int_equal(create_walled(&s[k], 60, 0.02, 1, NULL, &sys), JAM_OK);
    run(sys, 2000.0, &report);
    assert_true(report.energy_drift < 1e-11 && report.pressure > 1.0);
    for (int w = 0; w < count_walls(sys); ++w) {
      assert_true(of_wall(sys, w, JAM_WALL_GAP) > -1e-12 && of_wall(sys, w, JAM_WALL_PRESSURE) > 1.0);
    }
  }
}
