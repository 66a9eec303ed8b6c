/* Spheres that share a centre: the energy has a cusp there, so it is no minimum. They part, along a direction that the
 * seed draws, and end where the same start moved by a hair ends: at an energy as low. */
#include "systems.h"

#include <math.h>

/* n points of a generator of its own in [0, 1)^dim. */
static void scatter(double *x, int count, unsigned seed) {
  for (int k = 0; k < count; ++k) {
    seed = seed * 1664525u + 1013904223u;
    x[k] = (seed >> 8) / 16777216.0;
  }
}

static jam_system *soft(const double *x, int n, int dim, double diameter, int64_t seed) {
  DEFAULTS(create, o);
  o.dim = dim, o.overlap = JAM_OVERLAP_ALLOW, o.seed = seed;
  return created_from(&o, x, (size_t)(n * dim), &diameter, 1);
}

static jam_relax_report relaxed(jam_system *sys, int32_t minimiser, double tolerance) {
  jam_relax_report r = {.struct_size = sizeof r};
  DEFAULTS(relax, o);
  o.minimiser = minimiser, o.force_tolerance = tolerance;
  const jam_status status = jam_relax(sys, &o, &r);
  assert_true(status == JAM_OK || status == JAM_NOT_JAMMED);
  assert_int_equal(r.converged, 1);
  return r;
}

/* Smallest distance of two spheres over all nearest images, in a unit cube; how many pairs are nearer than `reach`. */
static double closest(const jam_system *sys, int n, int dim, double reach, int64_t *nearer) {
  double least = 1.0;
  const double *x = view_of(sys, JAM_VIEW_POSITIONS);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j) {
      double r2 = 0.0;
      for (int c = 0; c < dim; ++c) {
        const double d = x[i * dim + c] - x[j * dim + c], e = d - nearbyint(d);
        r2 += e * e;
      }
      least = fmin(least, sqrt(r2));
      if (nearer) *nearer += sqrt(r2) < reach;
    }
  return least;
}

/* Nothing else holds two spheres together: they part to energy 0. At one point, through the boundary, and so near that
 * the square of their distance is 0. */
CASE(two_alone_part) {
  for (int dim = 2; dim <= 8; ++dim)
    for (int32_t minimiser = JAM_MINIMISER_NEWTON; minimiser <= JAM_MINIMISER_LBFGS; ++minimiser)
      for (int kind = 0; kind < 4; ++kind) {
        double x[2 * 8];
        for (int c = 0; c < dim; ++c) x[c] = x[dim + c] = kind == 1 ? 0.0 : 0.3 + 0.05 * c;
        if (kind == 1) x[dim] = 1.0;                /* an image of the other */
        if (kind == 2) x[0] = 0.0, x[dim] = 1e-300; /* its square underflows */
        if (kind == 3) x[0] = 0.0, x[dim] = 1e-170;
        OWNED jam_system *sys = soft(x, 2, dim, 0.2, 1);
        const jam_relax_report r = relaxed(sys, minimiser, 1e-12);
        assert_true(r.energy < 1e-24 && r.contacts == 0 && r.max_overlap < 1e-12); /* rounding of the positions */
        assert_true(closest(sys, 2, dim, 0.0, NULL) >= 0.2 * (1.0 - 1e-9));
      }
}

/* In a dense system: three spheres at one centre and a pair at another. Minima of one dense system differ in energy by
 * far less than a pair that stays on one centre costs, 1/2 a pair. */
CASE(dense_starts_part) {
  double x[3 * 64], y[3 * 64];
  scatter(x, 3 * 64, 1);
  memcpy(x + 3 * 6, x + 3 * 5, 3 * sizeof *x);
  memcpy(x + 3 * 7, x + 3 * 5, 3 * sizeof *x);
  memcpy(x + 3 * 20, x + 3 * 40, 3 * sizeof *x);
  memcpy(y, x, sizeof x);
  for (int k = 0; k < 3 * 64; ++k) y[k] += 1e-9 * ((k * 37) % 11 - 5);
  for (int32_t minimiser = JAM_MINIMISER_NEWTON; minimiser <= JAM_MINIMISER_LBFGS; ++minimiser) {
    OWNED jam_system *at_once = soft(x, 64, 3, 0.30, 1), *apart = soft(y, 64, 3, 0.30, 1);
    const jam_relax_report a = relaxed(at_once, minimiser, 1e-9), b = relaxed(apart, minimiser, 1e-9);
    assert_true(fabs(a.energy - b.energy) < 0.25);
    assert_true(closest(at_once, 64, 3, 0.0, NULL) > 0.1);
    assert_true(a.max_overlap < 0.7);
  }
}

/* Stopped at the start: the overlap of the pair is 1, and it counts among the contacts. The direction is the seed's. */
CASE(coincident_pairs_are_counted) {
  double x[3 * 64];
  scatter(x, 3 * 64, 1);
  memcpy(x + 3 * 6, x + 3 * 5, 3 * sizeof *x);
  OWNED jam_system *sys = soft(x, 64, 3, 0.5, 1);
  jam_relax_report r = {.struct_size = sizeof r};
  DEFAULTS(relax, o);
  o.max_evaluations = 1;
  assert_int_equal(jam_relax(sys, &o, &r), JAM_LIMIT);
  assert_int_equal(r.converged, 0);
  assert_true(fabs(r.max_overlap - 1.0) < 1e-9);
  size_t rows = 0;
  int64_t pairs = 0; /* sigma is half the box: each pair overlaps through one image at most */
  closest(sys, 64, 3, 0.5, &pairs);
  assert_int_equal(r.contacts, pairs);
  assert_int_equal(jam_contacts(sys, NULL, 0, &rows), JAM_OK);
  assert_int_equal(rows, 2 * pairs);
}

CASE(seeds_choose_the_direction) {
  const double x[] = {0.3, 0.4, 0.5, 0.3, 0.4, 0.5};
  double first[3] = {0};
  for (int64_t seed = 1; seed <= 3; ++seed)
    for (int again = 0; again < 2; ++again) {
      OWNED jam_system *sys = soft(x, 2, 3, 0.2, seed);
      relaxed(sys, JAM_MINIMISER_NEWTON, 1e-12);
      const double *p = view_of(sys, JAM_VIEW_POSITIONS);
      if (again) assert_memory_equal(first, p, sizeof first);
      if (!again && seed > 1) assert_memory_not_equal(first, p, sizeof first);
      memcpy(first, p, sizeof first);
    }
}

/* Decompression finds a jammed network from such a start, and Monte Carlo moves its spheres apart. */
CASE(other_calls) {
  double x[2 * 48];
  jam_decompress_report r = {.struct_size = sizeof r};
  scatter(x, 2 * 48, 3);
  memcpy(x + 2 * 9, x + 2 * 8, 2 * sizeof *x);
  OWNED jam_system *sys = soft(x, 48, 2, 0.17, 1);
  DEFAULTS(decompress, o);
  o.crunch = 0, o.isostatic = 0, o.distance = 1e-3;
  assert_int_equal(jam_decompress(sys, &o, &r), JAM_OK);
  assert_true(closest(sys, 48, 2, 0.0, NULL) > 0.17 * 0.5);
  jam_destroy(sys);

  sys = soft(x, 48, 2, 0.1, 1);
  DEFAULTS(monte_carlo, m);
  m.alpha = 2.0, m.temperature = 1e-3, m.sweeps = 100;
  assert_int_equal(jam_monte_carlo(sys, &m, NULL), JAM_OK);
  assert_true(closest(sys, 48, 2, 0.0, NULL) > 0.01);
}
