/* Metropolis Monte Carlo against exact averages: two and three spheres by quadrature, fluids by molecular dynamics. */
#include <math.h>

#include "systems.h"

static jam_monte_carlo_options options(double alpha, double temperature, int64_t sweeps) {
  DEFAULTS(monte_carlo, o);
  o.alpha = alpha;
  o.temperature = temperature;
  o.sweeps = sweeps;
  return o;
}

static jam_monte_carlo_report run(jam_system *sys, const jam_monte_carlo_options *o) {
  SIZED(jam_monte_carlo_report, r);
  assert_int_equal(jam_monte_carlo(sys, o, &r), JAM_OK);
  return r;
}

static jam_system *spheres(int dim, int n, const double *diameter) {
  const double disks[6] = {0.0, 0.0, 0.5, 0.25, 0.0, 0.5};
  const double balls[9] = {0.0, 0.0, 0.0, 0.5, 0.25, 0.0, 0.0, 0.5, 0.0};
  DEFAULTS(create, o);
  o.dim = dim;
  o.n = n;
  return created_from(&o, dim == 2 ? disks : balls, (size_t)(dim * n), diameter, (size_t)n);
}

static double energy(double r2, double sigma, double alpha, int relative) {
  const double r = sqrt(r2);
  if (r >= sigma) return 0.0;
  return pow(relative ? 1.0 - r / sigma : sigma - r, alpha);
}
static double nearest(double x) { return x - floor(x + 0.5); }

/* Mean energy a sphere and pressure of two spheres: integral over the separation by the midpoint rule. */
static void two(double sigma, double alpha, int relative, double temperature, double *mean, double *pressure) {
  const int m = 140;
  double z = 0.0, u = 0.0, w = 0.0;
  int a, b, c;
  for (a = 0; a < m; ++a)
    for (b = 0; b < m; ++b)
      for (c = 0; c < m; ++c) {
        const double x = (a + 0.5) / m - 0.5, y = (b + 0.5) / m - 0.5, v = (c + 0.5) / m - 0.5;
        const double r2 = x * x + y * y + v * v, e = energy(r2, sigma, alpha, relative), p = exp(-e / temperature);
        const double r = sqrt(r2), s = relative ? 1.0 - r / sigma : sigma - r;
        z += p;
        u += p * e;
        if (s > 0.0) w += p * alpha * pow(s, alpha - 1.0) * (relative ? r / sigma : r);
      }
  *mean = 0.5 * u / z;
  *pressure = 1.0 + w / z / (3.0 * 2.0 * temperature);
}

CASE(two_spheres_have_the_boltzmann_averages) {
  const double sigma[2] = {0.45, 0.45};
  const struct {
    double alpha, temperature;
    int relative;
  } cases[] = {{1.5, 0.05, 0}, {2.0, 0.02, 0}, {2.5, 0.2, 1}, {3.0, 0.1, 1}};
  size_t k;
  for (k = 0; k < sizeof cases / sizeof *cases; ++k) {
    jam_system *sys = spheres(3, 2, sigma);
    jam_monte_carlo_options o = options(cases[k].alpha, cases[k].temperature, 200000);
    jam_monte_carlo_report r;
    double u, p;
    o.energy_unit = cases[k].relative ? JAM_ENERGY_RELATIVE : JAM_ENERGY_LENGTH;
    two(0.45, cases[k].alpha, cases[k].relative, cases[k].temperature, &u, &p);
    r = run(sys, &o);
    assert_true(fabs(r.energy - u) < 4.0 * r.energy_error && r.energy_error < 0.05 * u);
    assert_true(fabs(r.pressure - p) < 4.0 * r.pressure_error && r.pressure_error < 0.02 * p);
    jam_destroy(sys);
  }
}

/* Three disks of three sizes; swaps leave the average as it is only if they are accepted by the right rule. */
CASE(three_disks_and_swaps_have_the_boltzmann_averages) {
  const double sigma[3] = {0.28, 0.40, 0.48};
  const double temperature = 0.05, alpha = 2.0;
  const int m = 36;
  double z = 0.0, u = 0.0;
  int a, b, c, d, with_swaps;
  for (a = 0; a < m; ++a)
    for (b = 0; b < m; ++b) {
      const double x1 = (a + 0.5) / m - 0.5, y1 = (b + 0.5) / m - 0.5;
      const double e1 = energy(x1 * x1 + y1 * y1, 0.5 * (sigma[0] + sigma[1]), alpha, 1);
      for (c = 0; c < m; ++c)
        for (d = 0; d < m; ++d) {
          const double x2 = (c + 0.5) / m - 0.5, y2 = (d + 0.5) / m - 0.5;
          const double dx = nearest(x1 - x2), dy = nearest(y1 - y2);
          const double e = e1 + energy(x2 * x2 + y2 * y2, 0.5 * (sigma[0] + sigma[2]), alpha, 1) +
                           energy(dx * dx + dy * dy, 0.5 * (sigma[1] + sigma[2]), alpha, 1);
          const double p = exp(-e / temperature);
          z += p;
          u += p * e;
        }
    }
  u /= 3.0 * z;
  for (with_swaps = 0; with_swaps < 2; ++with_swaps) {
    jam_system *sys = spheres(2, 3, sigma);
    jam_monte_carlo_options o = options(alpha, temperature, 200000);
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
    jam_destroy(sys);
  }
}

CASE(hard_fluids_have_the_pressure_of_molecular_dynamics) {
  const double fractions[2] = {0.30, 0.47};
  size_t k;
  for (k = 0; k < 2; ++k) {
    const int n = 256;
    jam_monte_carlo_options o = options(0.0, 1.0, 12000);
    jam_monte_carlo_report r;
    double exact;
    SIZED(jam_md_report, md);
    DEFAULTS(create, c);
    c.n = n;
    jam_system *sys = created(&c);
    DEFAULTS(compress, grow);
    grow.packing_fraction = fractions[k];
    assert_int_equal(jam_compress(sys, &grow, NULL), JAM_OK);
    DEFAULTS(run, nve);
    nve.collisions_per_particle = 300;
    assert_int_equal(jam_run(sys, &nve, NULL), JAM_OK);
    nve.collisions_per_particle = 1500;
    assert_int_equal(jam_run(sys, &nve, &md), JAM_OK);
    r = run(sys, &o);
    exact = md.pressure;
    assert_true(fabs(r.pressure - exact) < 4.0 * hypot(r.pressure_error, md.pressure_error));
    assert_true(r.pressure_error < 0.01 * exact);
    assert_true(fabs(r.acceptance - 0.45) < 0.05);
    assert_true(r.msd > 0.0 && r.energy == 0.0);
    jam_destroy(sys);
  }
}

static int32_t stop(const jam_progress *p, void *user) {
  (void)user;
  return p->steps >= 10;
}

CASE(a_resumed_run_has_the_same_bits) {
  const double sigma[3] = {0.28, 0.40, 0.48};
  jam_monte_carlo_options o = options(2.0, 0.001, 3000);
  jam_system *a = spheres(3, 3, sigma), *b = spheres(3, 3, sigma);
  jam_monte_carlo_report r, whole;
  const double *x = NULL, *y = NULL;
  size_t len = 0;
  o.swap_share = 0.2;
  r.struct_size = sizeof r;
  whole = run(a, &o);
  assert_int_equal(jam_set_progress(b, stop, NULL), JAM_OK);
  assert_int_equal(jam_monte_carlo(b, &o, &r), JAM_CANCELLED);
  assert_in_range(r.sweeps, 10, 2999);
  assert_int_equal(jam_set_progress(b, NULL, NULL), JAM_OK);
  o.resume = 1;
  r = run(b, &o);
  assert_int_equal(r.sweeps, 3000);
  assert_true(r.energy == whole.energy && r.pressure == whole.pressure && r.msd == whole.msd);
  assert_int_equal(jam_view(a, JAM_VIEW_POSITIONS, &x, &len), JAM_OK);
  assert_int_equal(jam_view(b, JAM_VIEW_POSITIONS, &y, &len), JAM_OK);
  assert_memory_equal(x, y, len * sizeof *x);
  assert_int_equal(jam_monte_carlo(b, &o, &r), JAM_E_STATE);
  /* The next run goes on with new random numbers. */
  o.resume = 0;
  assert_int_equal(run(b, &o).next_sweep, 6000);
  jam_destroy(a);
  jam_destroy(b);
}

/* Long steps: spheres are looked up in cells. A sphere that is missing there would be overlapped, which jam_create
 * refuses. */
CASE(dilute_spheres_stay_apart_and_resume) {
  enum { N = 200, DIMS = 3 };
  static const double fractions[DIMS] = {0.4, 0.15, 0.05};
  int k;
  for (k = 0; k < DIMS; ++k) {
    double diameters[N];
    jam_monte_carlo_options o = options(0.0, 1.0, 300);
    jam_monte_carlo_report r;
    jam_system *a = NULL, *b = NULL, *again = NULL;
    const double *x = NULL, *y = NULL, *sigma = NULL;
    size_t len = 0, sizes = 0, i;
    for (i = 0; i < N; ++i) diameters[i] = i % 2 ? 1.3 : 1.0;
    DEFAULTS(create, c);
    c.dim = k + 2;
    c.n = N;
    c.packing_fraction = fractions[k];
    assert_int_equal(create_from(&c, NULL, 0, diameters, N, &a), JAM_OK);
    assert_int_equal(jam_copy(a, &b), JAM_OK);
    o.swap_share = 0.1;
    r = run(a, &o);
    assert_true(r.acceptance > 0.3 && r.step > 0.15);
    assert_int_equal(jam_view(a, JAM_VIEW_POSITIONS, &x, &len), JAM_OK);
    assert_int_equal(jam_view(a, JAM_VIEW_DIAMETERS, &sigma, &sizes), JAM_OK);
    assert_int_equal(create_from(&c, x, len, sigma, sizes, &again), JAM_OK);
    r.struct_size = sizeof r;
    assert_int_equal(jam_set_progress(b, stop, NULL), JAM_OK);
    assert_int_equal(jam_monte_carlo(b, &o, &r), JAM_CANCELLED);
    assert_int_equal(jam_set_progress(b, NULL, NULL), JAM_OK);
    o.resume = 1;
    run(b, &o);
    assert_int_equal(jam_view(b, JAM_VIEW_POSITIONS, &y, &len), JAM_OK);
    assert_memory_equal(x, y, len * sizeof *x);
    jam_destroy(a);
    jam_destroy(b);
    jam_destroy(again);
  }
}

CASE(runs_from_one_state_have_streams_of_their_own) {
  const double sigma[3] = {0.28, 0.40, 0.48}, instants[2] = {5.0, 50.0};
  jam_system *sys = spheres(3, 3, sigma);
  jam_monte_carlo_options o = options(2.0, 0.001, 1000); /* sweeps as by default: instants count */
  double displacement[2][2 * 9], alone[18];
  size_t k;
  DEFAULTS(isoconf, i);
  i.runs = 2;
  i.block = 1;
  o.step = 0.05;
  assert_int_equal(jam_isoconf(sys, &i, &o, instants, 2, NULL, 0, NULL), JAM_OK);
  for (k = 0; k < 2; ++k)
    assert_int_equal(jam_isoconf_displacements(sys, (int64_t)k, displacement[k], 18, NULL, 0, NULL), JAM_OK);
  assert_memory_not_equal(displacement[0], displacement[1], sizeof displacement[0]);
  i.first_run = 1;
  i.runs = 1;
  assert_int_equal(jam_isoconf(sys, &i, &o, instants, 2, NULL, 0, NULL), JAM_OK);
  assert_int_equal(jam_isoconf_displacements(sys, 0, alone, 18, NULL, 0, NULL), JAM_OK);
  assert_memory_equal(alone, displacement[1], sizeof alone);
  jam_destroy(sys);
}

CASE(bad_input_is_named) {
  const double sigma[2] = {0.3, 0.3};
  jam_system *sys = spheres(3, 2, sigma);
  jam_monte_carlo_options o;
#define REFUSED(member, value, code) \
  o = options(2.0, 0.01, 10);        \
  o.member = value;                  \
  assert_int_equal(jam_monte_carlo(sys, &o, NULL), code)
  REFUSED(temperature, 0.0, JAM_E_ARGUMENT);
  REFUSED(temperature, -1.0, JAM_E_ARGUMENT);
  REFUSED(alpha, 1.0, JAM_E_ARGUMENT);
  REFUSED(alpha, -2.0, JAM_E_ARGUMENT);
  REFUSED(energy_scale, 0.0, JAM_E_ARGUMENT);
  REFUSED(energy_unit, 2, JAM_E_ARGUMENT);
  REFUSED(step, -1.0, JAM_E_ARGUMENT);
  REFUSED(step, 3.0, JAM_E_ARGUMENT);
  REFUSED(acceptance, 1.0, JAM_E_ARGUMENT);
  REFUSED(swap_share, 1.0, JAM_E_ARGUMENT);
  REFUSED(sweeps, 0, JAM_E_ARGUMENT);
  REFUSED(run, -1, JAM_E_ARGUMENT);
  REFUSED(wall_time, 0.0, JAM_E_ARGUMENT);
  REFUSED(resume, 1, JAM_E_STATE);
  jam_destroy(sys);
}

/* Soft spheres leave overlaps. Calls for hard spheres say so, those for soft ones go on. */
CASE(soft_spheres_leave_overlaps) {
  jam_monte_carlo_options o = options(2.0, 0.1, 50);
  DEFAULTS(create, c);
  c.n = 60, c.packing_fraction = 0.3;
  jam_system *sys = created(&c);
  assert_int_equal(jam_monte_carlo(sys, &o, NULL), JAM_OK);
  SAYS(jam_crunch(sys, NULL, NULL), JAM_E_OVERLAP, "jam_decompress");
  assert_true(jam_relax(sys, NULL, NULL) >= 0);
  jam_destroy(sys);
}

CASE(hard_spheres_in_contact_cannot_move) {
  jam_monte_carlo_options o = options(0.0, 1.0, 10);
  DEFAULTS(create, c);
  c.n = 100;
  jam_system *sys = created(&c);
  DEFAULTS(compress, grow);
  grow.pressure = 1e6;
  assert_int_equal(jam_compress(sys, &grow, NULL), JAM_OK);
  assert_int_equal(jam_crunch(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_scale_diameters(sys, 1.0 - 1e-14), JAM_OK);
  SAYS(jam_monte_carlo(sys, &o, NULL), JAM_E_ARGUMENT, "contact");
  jam_destroy(sys);
}
