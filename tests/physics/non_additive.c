/* Non-additive mixtures: unlike spheres touch at (1 + Delta) (sigma_i + sigma_j) / 2. Jammed from random starts by
 * crunch alone in d = 2, 3, certified, and looked at pair by pair with a rule written out here. */
#include <math.h>

#include "systems.h"

enum { N = 80 };

static double touch(double a, double b, double delta) { return 0.5 * (a + b) * (a == b ? 1.0 : 1.0 + delta); }

/* Smallest gap over all pairs of nearest images by the rule above; *unlike: contacts of unequal spheres. */
static double worst_gap(const jam_system *sys, double delta, double tolerance, int *unlike) {
  const double *x, *s;
  size_t len;
  double worst = 1e300;
  const jam_info info = info_of(sys);
  assert_true(info.non_additivity == delta);
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &len);
  jam_view(sys, JAM_VIEW_DIAMETERS, &s, &len);
  *unlike = 0;
  for (size_t i = 0; i < len; ++i)
    for (size_t j = 0; j < i; ++j) {
      double r2 = 0.0, gap;
      for (int c = 0; c < info.dim; ++c) {
        double dx = x[i * (size_t)info.dim + (size_t)c] - x[j * (size_t)info.dim + (size_t)c];
        dx -= info.box * nearbyint(dx / info.box);
        r2 += dx * dx;
      }
      gap = sqrt(r2) / touch(s[i], s[j], delta) - 1.0;
      if (gap < worst) worst = gap;
      if (gap < tolerance && s[i] != s[j]) ++*unlike;
    }
  return worst;
}

static jam_system *mixture(int dim, double delta, int64_t seed) {
  double diameter[N];
  for (int i = 0; i < N; ++i) diameter[i] = i < N / 2 ? 1.0 : 1.4;
  DEFAULTS(create, o);
  o.dim = dim, o.n = N, o.seed = seed, o.box = 2.0, o.packing_fraction = 0.25, o.non_additivity = delta;
  return created_from(&o, NULL, 0, diameter, N);
}

CASE(jams_and_certifies) {
  const double deltas[] = {-0.1, 0.1};
  int unlike;
  for (int dim = 2; dim <= 3; ++dim)
    for (int k = 0; k < 2; ++k) {
      OWNED jam_system *sys = mixture(dim, deltas[k], 3 + k);
      double start = worst_gap(sys, deltas[k], 0.0, &unlike), end;
      assert_true(start >= 0.0);
      SIZED(jam_crunch_report, r);
      assert_int_equal(jam_crunch(sys, NULL, &r), JAM_OK);
      end = worst_gap(sys, deltas[k], 1e-9, &unlike);
      print_message("d %d Delta %g: phi %.6f, %d contacts (%d unlike), excess %d, residual %g, worst gap %g\n", dim,
                    deltas[k], r.packing_fraction, (int)r.contacts, unlike, (int)r.excess_contacts, r.force_residual,
                    end);
      assert_int_equal(r.jammed, 1);
      assert_true(end > -1e-13); /* rounding of coordinates over a diameter */
      assert_true(r.force_residual < 1e-12);
      assert_true(r.min_force > 0.0 && r.excess_contacts >= 0);
      assert_true(unlike > N / 8); /* the rule of unlike pairs holds the network up */
    }
}

CASE(overlaps_are_those_of_the_rule) {
  const double x[4] = {0.2, 0.5, 0.62, 0.5}, s[2] = {0.4, 0.3};
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.dim = 2;
  /* 0.42 apart: free at Delta = 0.15 (0.4025), an overlap at 0.25 (0.4375), which shrinking settles. */
  o.non_additivity = 0.15;
  assert_int_equal(create_from(&o, x, 4, s, 2, &sys), JAM_OK);
  jam_destroy(sys);
  o.non_additivity = 0.25;
  assert_int_equal(create_from(&o, x, 4, s, 2, &sys), JAM_E_OVERLAP);
  o.overlap = JAM_OVERLAP_SHRINK;
  assert_int_equal(create_from(&o, x, 4, s, 2, &sys), JAM_OK);
  assert_true(fabs(worst_gap(sys, 0.25, 0.0, (int[1]){0})) < 1e-14);
  jam_destroy(sys);
}
