/* Metropolis Monte Carlo in cells that are no cubes, and in cells of several images: exact averages, the same moves as
 * in the cube, the pressure of molecular dynamics, resuming. */
#include <jam/jam.h>
#include <math.h>
#include <stdio.h>

#include "start.h"
#include "test.h"

static const double oblique[4] = {1.0, 0.0, 0.45, 0.8}, square[4] = {1.0, 0.0, 0.0, 1.0};
static const double monoclinic[9] = {1.0, 0.0, 0.0, 0.0, 1.3, 0.0, 0.4, 0.0, 0.8};

static jam_monte_carlo_options options(double alpha, double temperature, int64_t sweeps) {
  DEFAULTS(monte_carlo, o);
  o.alpha = alpha, o.temperature = temperature, o.sweeps = sweeps;
  return o;
}

static jam_monte_carlo_report run(jam_system *sys, const jam_monte_carlo_options *o) {
  jam_monte_carlo_report r = {.struct_size = sizeof r};
  if (jam_monte_carlo(sys, o, &r) != JAM_OK) print_error("%s\n", jam_last_error());
  assert_int_equal(r.sweeps, o->sweeps);
  return r;
}

/* The second one stands as far as it can from all images of the first. */
static jam_system *two_disks(const double *cell, double sigma, int32_t overlap) {
  const double x[4] = {0.0, 0.0, 0.5, 0.5 * (cell[2] * (cell[2] - 1.0) / cell[3] + cell[3])};
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.dim = 2, o.n = 2, o.overlap = overlap;
  if (create_in_cell(&o, cell, 4, x, 4, &sigma, 1, &sys) < 0) print_error("%s\n", jam_last_error());
  assert_non_null(sys);
  return sys;
}

/* Two soft disks whose separation has several images in range: integral over the cell by the midpoint rule. */
CASE(two_soft_disks) {
  const double sigmas[] = {0.42, 0.55, 0.7}, temperature = 0.03;
  for (int c = 0; c < 2; ++c)
    for (int k = 0; k < 3; ++k) {
      const double *cell = c ? oblique : square, sigma = sigmas[k];
      const int m = 300;
      double z = 0.0, u = 0.0, w = 0.0;
      for (int a = 0; a < m; ++a)
        for (int b = 0; b < m; ++b) {
          double e = 0.0, virial = 0.0;
          for (int i = -3; i <= 3; ++i)
            for (int j = -3; j <= 3; ++j) {
              const double s = (a + 0.5) / m + i, t = (b + 0.5) / m + j;
              const double x = s * cell[0] + t * cell[2], y = t * cell[3], r = sqrt(x * x + y * y);
              if (r >= sigma) continue;
              e += (sigma - r) * (sigma - r), virial += 2.0 * (sigma - r) * r;
            }
          const double p = exp(-e / temperature);
          z += p, u += p * e, w += p * virial;
        }
      jam_system *sys = two_disks(cell, sigma, JAM_OVERLAP_ALLOW);
      const jam_monte_carlo_options o = options(2.0, temperature, 100000);
      const jam_monte_carlo_report r = run(sys, &o);
      const double energy = 0.5 * u / z, pressure = 1.0 + w / z / (2.0 * 2.0 * temperature);
      print_message("cell %d sigma %.2f: u %.5f(%.5f), exact %.5f; p %.4f(%.4f), exact %.4f\n", c, sigma, r.energy,
                    r.energy_error, energy, r.pressure, r.pressure_error, pressure);
      assert_true(fabs(r.energy - energy) < 4.0 * r.energy_error && r.energy_error < 0.03 * energy);
      assert_true(fabs(r.pressure - pressure) < 4.0 * r.pressure_error && r.pressure_error < 0.02 * pressure);
      jam_destroy(sys);
    }
}

/* Two hard disks: p = 1 + sigma L / (d N A). A is the area that the separation may take, L the length of its border at
 * distance sigma from the lattice points. */
CASE(two_hard_disks) {
  const double sigma = 0.52;
  const int m = 1000, angles = 20000;
  double area = 0.0, border = 0.0;
  for (int a = 0; a < m + angles / m; ++a)
    for (int b = 0; b < m; ++b) {
      /* points of the cell, then points of the circle */
      const double turn = 2.0 * M_PI * ((a - m) * m + b + 0.5) / angles;
      const double x = a < m ? (a + 0.5) / m * oblique[0] + (b + 0.5) / m * oblique[2] : sigma * cos(turn);
      const double y = a < m ? (b + 0.5) / m * oblique[3] : sigma * sin(turn);
      int free_place = 1;
      for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j)
          if ((a < m || i || j) && hypot(x + i * oblique[0] + j * oblique[2], y + j * oblique[3]) < sigma)
            free_place = 0;
      if (a < m)
        area += free_place * oblique[0] * oblique[3] / ((double)m * m);
      else
        border += free_place * 2.0 * M_PI * sigma / angles;
    }
  const double exact = 1.0 + sigma * border / (2.0 * 2.0 * area);
  assert_true(border < 0.9 * 2.0 * M_PI * sigma); /* images cover a part */
  jam_system *sys = two_disks(oblique, sigma, JAM_OVERLAP_REFUSE);
  const jam_monte_carlo_options o = options(0.0, 1.0, 1600000);
  const jam_monte_carlo_report r = run(sys, &o);
  print_message("two hard disks: p %.4f(%.4f), exact %.4f, acceptance %.3f\n", r.pressure, r.pressure_error, exact,
                r.acceptance);
  assert_true(r.pressure_error < 0.03 * exact);
  assert_true(fabs(r.pressure - exact) < 4.0 * r.pressure_error + 0.01 * exact);
  assert_true(fabs(r.acceptance - 0.45) < 0.05); /* as tuned */
  jam_destroy(sys);
}

static jam_system *fluid(const double *cell, int64_t n, double fraction) {
  double diameters[512];
  jam_system *sys = NULL;
  for (int64_t k = 0; k < n; ++k) diameters[k] = k % 2 ? 1.3 : 1.0;
  DEFAULTS(create, o);
  o.n = n, o.packing_fraction = 0.5 * fraction;
  assert_int_equal(create_in_cell(&o, cell, 9, NULL, 0, diameters, (size_t)n, &sys), JAM_OK);
  DEFAULTS(compress, c);
  c.growth_rate = 0.1, c.pressure = 1e12, c.packing_fraction = fraction;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  return sys;
}

/* A cube but for a tilt of 1e-13: other code, the same moves. Errors of the steps add up and are not amplified. */
CASE(a_cube_in_disguise) {
  const struct {
    double alpha, temperature, swap_share, fraction, step;
  } cases[] = {
      {0.0, 1.0, 0.0, 0.45, 0.0}, {0.0, 1.0, 0.2, 0.4, 0.05}, {0.0, 1.0, 0.0, 0.1, 0.5}, {2.0, 1e-4, 0.1, 0.5, 0.0}};
  const double cube[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, tilted[9] = {1, 0, 0, 1e-13, 1, 0, 0, 0, 1};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    jam_system *a = fluid(cube, 200, cases[k].fraction), *b = NULL;
    jam_monte_carlo_options o = options(cases[k].alpha, cases[k].temperature, 300);
    const double *x = NULL, *y = NULL;
    size_t len = 0;
    o.swap_share = cases[k].swap_share, o.step = cases[k].step > 0.0 ? cases[k].step : 0.1;
    assert_int_equal(jam_copy(a, &b), JAM_OK);
    assert_int_equal(jam_set_cell(b, tilted, 9, NULL, 0, NULL, 0, NULL), JAM_OK);
    const jam_monte_carlo_report r = run(a, &o), s = run(b, &o);
    assert_true(r.acceptance == s.acceptance && r.acceptance > 0.01);
    assert_true(fabs(r.msd - s.msd) <= 1e-9 * r.msd && fabs(r.energy - s.energy) <= 1e-9 * fabs(r.energy));
    assert_int_equal(jam_view(a, JAM_VIEW_POSITIONS, &x, &len), JAM_OK);
    assert_int_equal(jam_view(b, JAM_VIEW_POSITIONS, &y, &len), JAM_OK);
    for (size_t c = 0; c < len; ++c) assert_true(fabs(remainder(x[c] - y[c], 1.0)) < 1e-9);
    jam_destroy(a), jam_destroy(b);
  }
}

/* Hard spheres in a tilted cell: the pressure of molecular dynamics there, and no overlap. */
CASE(hard_fluid) {
  jam_system *sys = fluid(monoclinic, 256, 0.45), *again = NULL;
  jam_monte_carlo_options o = options(0.0, 1.0, 4000);
  jam_md_report md = {.struct_size = sizeof md};
  const double *x = NULL, *sigma = NULL;
  double cell[9];
  size_t len = 0, sizes = 0;
  DEFAULTS(run, ro);
  ro.collisions_per_particle = 1000;
  assert_int_equal(jam_run(sys, &ro, &md), JAM_OK);
  o.swap_share = 0.1;
  const jam_monte_carlo_report r = run(sys, &o);
  print_message("hard fluid: Monte Carlo p %.3f(%.3f), molecular dynamics %.3f(%.3f)\n", r.pressure, r.pressure_error,
                md.pressure, md.pressure_error);
  assert_true(fabs(r.pressure - md.pressure) < 4.0 * hypot(r.pressure_error, md.pressure_error) + 0.01 * md.pressure);
  assert_true(r.pressure_error < 0.02 * r.pressure && r.swap_acceptance > 0.0);
  DEFAULTS(create, c);
  c.n = 256;
  assert_int_equal(jam_view(sys, JAM_VIEW_POSITIONS, &x, &len), JAM_OK);
  assert_int_equal(jam_view(sys, JAM_VIEW_DIAMETERS, &sigma, &sizes), JAM_OK);
  assert_int_equal(jam_get_cell(sys, cell, 9, NULL), JAM_OK);
  assert_int_equal(create_in_cell(&c, cell, 9, x, len, sigma, sizes, &again), JAM_OK); /* it refuses overlaps */
  jam_destroy(sys), jam_destroy(again);
}

static int32_t stop(const jam_progress *p, void *user) {
  (void)user;
  return p->steps > 0;
}

CASE(a_resumed_run_has_the_same_bits) {
  const char *const path = "monte_carlo_cells.check";
  for (int k = 0; k < 3; ++k) {
    /* lists, few spheres with several images, cells */
    jam_system *a = fluid(monoclinic, k == 1 ? 4 : 200, k == 2 ? 0.05 : 0.3), *b = NULL;
    jam_monte_carlo_options o = options(k == 1 ? 2.0 : 0.0, 0.001, 400);
    jam_monte_carlo_report r = {.struct_size = sizeof r};
    const double *x = NULL, *y = NULL;
    size_t len = 0;
    assert_int_equal(jam_copy(a, &b), JAM_OK);
    run(a, &o);
    assert_int_equal(jam_set_progress(b, stop, NULL), JAM_OK);
    assert_int_equal(jam_monte_carlo(b, &o, &r), JAM_CANCELLED);
    assert_int_equal(jam_write_checkpoint(b, path), JAM_OK);
    jam_destroy(b);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &b), JAM_OK);
    o.resume = 1;
    run(b, &o);
    assert_int_equal(jam_view(a, JAM_VIEW_POSITIONS, &x, &len), JAM_OK);
    assert_int_equal(jam_view(b, JAM_VIEW_POSITIONS, &y, &len), JAM_OK);
    assert_memory_equal(x, y, len * sizeof *x);
    jam_destroy(a), jam_destroy(b);
  }
  remove(path);
}
