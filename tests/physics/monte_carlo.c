/* Metropolis Monte Carlo against exact averages: two and three disks by quadrature, in cells of any shape and of
 * several images; fluids by molecular dynamics; resumed runs. */
#include <math.h>
#include <stdio.h>

#include "systems.h"

static const double oblique[4] = {1.0, 0.0, 0.45, 0.8}, square[4] = {1.0, 0.0, 0.0, 1.0};
static const double monoclinic[9] = {1.0, 0.0, 0.0, 0.0, 1.3, 0.0, 0.4, 0.0, 0.8};

static jam_monte_carlo_options options(double alpha, double temperature, int64_t sweeps) {
  DEFAULTS(monte_carlo, o);
  o.alpha = alpha, o.temperature = temperature, o.sweeps = sweeps;
  return o;
}

static jam_monte_carlo_report run(jam_system *sys, const jam_monte_carlo_options *o) {
  SIZED(jam_monte_carlo_report, r);
  assert_int_equal(jam_monte_carlo(sys, o, &r), JAM_OK);
  assert_int_equal(r.sweeps, o->sweeps);
  return r;
}

static jam_system *disks(int n, const double *diameter) {
  const double x[6] = {0.0, 0.0, 0.5, 0.25, 0.0, 0.5};
  DEFAULTS(create, o);
  o.dim = 2, o.n = n;
  return created_from(&o, x, (size_t)(2 * n), diameter, (size_t)n);
}

static double energy(double r2, double sigma) { return r2 < sigma * sigma ? pow(1.0 - sqrt(r2) / sigma, 2.0) : 0.0; }
static double nearest(double x) { return x - floor(x + 0.5); }

/* Three disks of three sizes; swaps leave the average as it is only if they are accepted by the right rule. */
CASE(three_disks_and_swaps_have_the_boltzmann_averages) {
  const double sigma[3] = {0.28, 0.40, 0.48};
  const double temperature = 0.05;
  const int m = 36;
  double z = 0.0, u = 0.0;
  for (int a = 0; a < m; ++a)
    for (int b = 0; b < m; ++b) {
      const double x1 = (a + 0.5) / m - 0.5, y1 = (b + 0.5) / m - 0.5;
      const double e1 = energy(x1 * x1 + y1 * y1, 0.5 * (sigma[0] + sigma[1]));
      for (int c = 0; c < m; ++c)
        for (int d = 0; d < m; ++d) {
          const double x2 = (c + 0.5) / m - 0.5, y2 = (d + 0.5) / m - 0.5;
          const double dx = nearest(x1 - x2), dy = nearest(y1 - y2);
          const double e = e1 + energy(x2 * x2 + y2 * y2, 0.5 * (sigma[0] + sigma[2])) +
                           energy(dx * dx + dy * dy, 0.5 * (sigma[1] + sigma[2]));
          const double p = exp(-e / temperature);
          z += p;
          u += p * e;
        }
    }
  u /= 3.0 * z;
  for (int with_swaps = 0; with_swaps < 2; ++with_swaps) {
    OWNED jam_system *sys = disks(3, sigma);
    jam_monte_carlo_options o = options(2.0, temperature, 200000);
    const double *now = NULL;
    size_t len = 0;
    jam_monte_carlo_report r;
    o.energy_unit = JAM_ENERGY_RELATIVE;
    o.swap_share = with_swaps ? 0.5 : 0.0;
    r = run(sys, &o);
    assert_true(fabs(r.energy - u) < 4.0 * r.energy_error && r.energy_error < 0.03 * u);
    assert_int_equal(jam_view(sys, JAM_VIEW_DIAMETERS, &now, &len), JAM_OK);
    assert_true(fabs(now[0] + now[1] + now[2] - 1.16) < 1e-6);
    if (with_swaps)
      assert_true(r.swap_acceptance > 0.05 && r.swap_acceptance < 0.95);
    else
      assert_true(isnan(r.swap_acceptance));
  }
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
      OWNED jam_system *sys = two_disks(cell, sigma, JAM_OVERLAP_ALLOW);
      const jam_monte_carlo_options o = options(2.0, temperature, 100000);
      const jam_monte_carlo_report r = run(sys, &o);
      const double energy = 0.5 * u / z, pressure = 1.0 + w / z / (2.0 * 2.0 * temperature);
      print_message("cell %d sigma %.2f: u %.5f(%.5f), exact %.5f; p %.4f(%.4f), exact %.4f\n", c, sigma, r.energy,
                    r.energy_error, energy, r.pressure, r.pressure_error, pressure);
      assert_true(fabs(r.energy - energy) < 4.0 * r.energy_error && r.energy_error < 0.03 * energy);
      assert_true(fabs(r.pressure - pressure) < 4.0 * r.pressure_error && r.pressure_error < 0.02 * pressure);
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
  OWNED jam_system *sys = two_disks(oblique, sigma, JAM_OVERLAP_REFUSE);
  const jam_monte_carlo_options o = options(0.0, 1.0, 1600000);
  const jam_monte_carlo_report r = run(sys, &o);
  print_message("two hard disks: p %.4f(%.4f), exact %.4f, acceptance %.3f\n", r.pressure, r.pressure_error, exact,
                r.acceptance);
  assert_true(r.pressure_error < 0.03 * exact);
  assert_true(fabs(r.pressure - exact) < 4.0 * r.pressure_error + 0.01 * exact);
  assert_true(fabs(r.acceptance - 0.45) < 0.05); /* as tuned */
}

CASE(hard_fluids_have_the_pressure_of_molecular_dynamics) {
  jam_monte_carlo_options o = options(0.0, 1.0, 12000);
  SIZED(jam_md_report, md);
  DEFAULTS(create, c);
  c.n = 256;
  OWNED jam_system *sys = created(&c);
  DEFAULTS(compress, grow);
  grow.packing_fraction = 0.47;
  assert_int_equal(jam_compress(sys, &grow, NULL), JAM_OK);
  DEFAULTS(run, nve);
  nve.collisions_per_particle = 300;
  assert_int_equal(jam_run(sys, &nve, NULL), JAM_OK);
  nve.collisions_per_particle = 1500;
  assert_int_equal(jam_run(sys, &nve, &md), JAM_OK);
  const jam_monte_carlo_report r = run(sys, &o);
  assert_true(fabs(r.pressure - md.pressure) < 4.0 * hypot(r.pressure_error, md.pressure_error));
  assert_true(r.pressure_error < 0.01 * md.pressure);
  assert_true(fabs(r.acceptance - 0.45) < 0.05);
  assert_true(r.msd > 0.0 && r.energy == 0.0);
}

static int32_t stop(const jam_progress *p, void *user) {
  (void)user;
  return p->steps > 0;
}

/* Lists, few spheres with several images, and cells, in which long steps look spheres up: one that is missing there
 * would be overlapped, which jam_create refuses. */
CASE(resumed_runs_have_the_same_bits_and_hard_spheres_stay_apart) {
  const char *const path = "monte_carlo.check";
  static const struct {
    int32_t dim;
    int64_t n;
    double fraction, alpha, step, swap_share;
    const double *cell;
  } scenes[] = {{3, 200, 0.3, 0.0, 0.1, 0.0, monoclinic},  {3, 4, 0.3, 2.0, 0.1, 0.2, monoclinic},
                {3, 200, 0.05, 0.0, 0.1, 0.0, monoclinic}, {2, 200, 0.4, 0.0, 1.0, 0.1, square},
                {3, 200, 0.15, 0.0, 1.0, 0.1, NULL},       {4, 200, 0.05, 0.0, 1.0, 0.1, NULL}};
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; ++k) {
    double diameters[200], cell[16];
    jam_monte_carlo_options o = options(scenes[k].alpha, 0.001, 300);
    jam_system *a = NULL, *b = NULL, *again = NULL;
    size_t cell_len = 0;
    for (int i = 0; i < 200; ++i) diameters[i] = i % 2 ? 1.3 : 1.0;
    DEFAULTS(create, c);
    c.dim = scenes[k].dim, c.n = scenes[k].n, c.packing_fraction = scenes[k].fraction;
    if (scenes[k].cell) cell_len = (size_t)(c.dim * c.dim);
    assert_int_equal(create_in_cell(&c, scenes[k].cell, cell_len, NULL, 0, diameters, (size_t)c.n, &a), JAM_OK);
    b = copy_of(a);
    o.step = scenes[k].step, o.swap_share = scenes[k].swap_share;
    const jam_monte_carlo_report whole = run(a, &o);
    assert_true(whole.acceptance > 0.01);
    assert_int_equal(jam_set_progress(b, stop, NULL), JAM_OK);
    SIZED(jam_monte_carlo_report, r);
    assert_int_equal(jam_monte_carlo(b, &o, &r), JAM_CANCELLED);
    assert_in_range(r.sweeps, 1, 299);
    assert_int_equal(jam_write_checkpoint(b, path), JAM_OK);
    jam_destroy(b);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &b), JAM_OK);
    o.resume = 1;
    r = run(b, &o);
    assert_true(r.energy == whole.energy && r.pressure == whole.pressure && r.msd == whole.msd);
    same_view(a, b, JAM_VIEW_POSITIONS);
    assert_int_equal(jam_monte_carlo(b, &o, &r), JAM_E_STATE);
    o.resume = 0; /* the next run goes on with new random numbers */
    assert_int_equal(run(b, &o).next_sweep, 600);
    assert_int_equal(jam_get_cell(a, cell, 16, &cell_len), JAM_OK);
    if (scenes[k].alpha == 0.0)
      assert_int_equal(create_in_cell(&c, cell, cell_len, view_of(a, JAM_VIEW_POSITIONS), (size_t)(c.dim * c.n),
                                      view_of(a, JAM_VIEW_DIAMETERS), (size_t)c.n, &again),
                       JAM_OK);
    jam_destroy(a), jam_destroy(b), jam_destroy(again);
  }
  remove(path);
}

/* A call whose time is over makes one sweep, and parts of any length come to the same bits. */
CASE(a_sweep_is_the_longest_that_a_call_goes_on) {
  DEFAULTS(create, c);
  c.n = 30, c.packing_fraction = 0.2;
  OWNED jam_system *a = created(&c), *b = copy_of(a);
  jam_monte_carlo_options o = options(0.0, 1.0, 45);
  o.step = 0.2;
  const jam_monte_carlo_report whole = run(a, &o);
  SIZED(jam_monte_carlo_report, r);
  for (int k = 1; k < 45; ++k, o.resume = 1) {
    o.wall_time = 1e-9;
    assert_int_equal(jam_monte_carlo(b, &o, &r), JAM_LIMIT);
    assert_int_equal(r.sweeps, k);
  }
  r = run(b, &o);
  assert_true(r.pressure == whole.pressure && r.msd == whole.msd);
  same_view(a, b, JAM_VIEW_POSITIONS);
}

/* In a gas trials are as long as half the cell. Spheres are in cells then, and lists have the pairs near contact alone:
 * all pairs would take five times this memory. The second virial coefficient gives 1 + 4 phi. */
CASE(a_gas_lists_no_far_pairs) {
  DEFAULTS(create, c);
  c.n = 2000, c.packing_fraction = 1e-3;
  OWNED jam_system *sys = created(&c);
  assert_int_equal(jam_set_memory_limit(sys, 1e7), JAM_OK);
  const jam_monte_carlo_options o = options(0.0, 1.0, 100);
  const jam_monte_carlo_report r = run(sys, &o);
  assert_true(r.step * 0.1 > 1.0 && fabs(r.pressure - 1.004) < 0.01);
}

/* Few samples say nothing of the pressure, unless their fit is sharp. */
CASE(a_pressure_of_few_samples_is_none) {
  for (int64_t seed = 0; seed < 20; ++seed) {
    DEFAULTS(create, c);
    c.n = 8, c.packing_fraction = 0.3, c.seed = seed;
    OWNED jam_system *sys = created(&c);
    jam_monte_carlo_options o = options(0.0, 1.0, 10);
    o.step = 0.3;
    const double p = run(sys, &o).pressure; /* of many sweeps it is near 4 */
    assert_true(isnan(p) || (p > 1.0 && p < 30.0));
  }
}

CASE(runs_from_one_state_have_streams_of_their_own) {
  const double sigma[3] = {0.28, 0.40, 0.48}, instants[2] = {5.0, 50.0};
  OWNED jam_system *sys = disks(3, sigma);
  jam_monte_carlo_options o = options(2.0, 0.001, 1000); /* sweeps as by default: instants count */
  double displacement[2][2 * 6], alone[12];
  DEFAULTS(isoconf, i);
  i.runs = 2;
  i.block = 1;
  o.step = 0.05;
  assert_int_equal(jam_isoconf(sys, &i, &o, instants, 2, NULL, 0, NULL), JAM_OK);
  for (size_t k = 0; k < 2; ++k)
    assert_int_equal(jam_isoconf_displacements(sys, (int64_t)k, displacement[k], 12, NULL, 0, NULL), JAM_OK);
  assert_memory_not_equal(displacement[0], displacement[1], sizeof displacement[0]);
  i.first_run = 1;
  i.runs = 1;
  assert_int_equal(jam_isoconf(sys, &i, &o, instants, 2, NULL, 0, NULL), JAM_OK);
  assert_int_equal(jam_isoconf_displacements(sys, 0, alone, 12, NULL, 0, NULL), JAM_OK);
  assert_memory_equal(alone, displacement[1], sizeof alone);
}

CASE(hard_spheres_in_contact_cannot_move) {
  jam_monte_carlo_options o = options(0.0, 1.0, 10);
  DEFAULTS(create, c);
  c.n = 100;
  OWNED jam_system *sys = created(&c);
  DEFAULTS(compress, grow);
  grow.pressure = 1e6;
  assert_int_equal(jam_compress(sys, &grow, NULL), JAM_OK);
  assert_int_equal(jam_crunch(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_scale_diameters(sys, 1.0 - 1e-14), JAM_OK);
  SAYS(jam_monte_carlo(sys, &o, NULL), JAM_E_ARGUMENT, "contact");
}
