/* The small version of examples/studies/network_distributions.py: one packing, wide bounds.
 * Values: Charbonneau et al., Nat. Commun. 5, 3725 (2014); Lerner, During and Wyart, Soft Matter 9, 8252 (2013). */
#include <math.h>
#include <stdio.h>

#include <jam/jam.h>
#include "columns.h"
#include "crystal.h"
#include "test.h"

enum { ROOM = 200000 };
static double x[ROOM], y[ROOM];
static int32_t a[ROOM], b[ROOM];

static int setup(void **its_state) {
  jam_system *s = NULL;
  if (jam_read(JAM_TEST_SHARED "/ls-n1024-d3.dat", NULL, NULL, NULL, &s) !=
      JAM_OK) { /* no such file beside the tree: make one, of half the size */
    jam_create_options o;
    if (jam_create_options_init(&o, sizeof o) != JAM_OK) return -1;
    o.n = 512;
    if (jam_create(&o, NULL, &s) != JAM_OK || jam_compress(s, NULL, NULL) != JAM_OK) return -1;
  }
  *its_state = s;
  return jam_crunch(s, NULL, NULL) == JAM_OK ? 0 : -1;
}
static int teardown(void **its_state) {
  jam_destroy(*its_state);
  return 0;
}
/* Maximum likelihood of a in a density ~ x^a on (0, high]: 1 / <ln(high / x)> - 1. */
static double exponent(const double *v, size_t n, double high, double *error) {
  double sum = 0.0;
  size_t k, m = 0;
  for (k = 0; k < n; ++k)
    if (v[k] > 0.0 && v[k] <= high) sum += log(high / v[k]), ++m;
  assert_true(m > 20);
  *error = (double)m / sum / sqrt((double)m);
  return (double)m / sum - 1.0;
}

CASE(forces) {
  jam_system *s = *its_state;
  size_t n, k;
  int kind;
  assert_int_equal(jam_forces(s, x, ROOM, &n), JAM_OK);
  assert_int_equal(jam_contact_classes(s, a, ROOM, &n), JAM_OK);
  for (kind = 0; kind < 2; ++kind) { /* extended, localised */
    const double expected = kind ? 0.17462 : 0.42311;
    double mean = 0.0, error, theta;
    size_t m = 0;
    for (k = 0; k < n; ++k)
      if (((a[k] & JAM_CONTACT_LOCALISED) != 0) == kind) mean += y[m++] = x[k];
    for (k = 0; k < m; ++k) y[k] /= mean / (double)m;
    theta = exponent(y, m, 0.2, &error);
    printf("%s: %zu contacts, theta %.3f +- %.3f, expected %.3f\n", kind ? "localised" : "extended", m, theta, error,
           expected);
    assert_true(fabs(theta - expected) < 4.0 * error);
  }
}

CASE(gaps) {
  jam_system *s = *its_state;
  size_t n;
  double error, gamma;
  assert_int_equal(jam_gaps(s, 1.0, 1, x, ROOM, NULL, 0, &n), JAM_OK);
  assert_true(x[0] > 1e-9); /* contacts are left out */
  gamma = -exponent(x, n, 1e-2, &error);
  printf("gaps: gamma %.3f +- %.3f, expected 0.413\n", gamma, error);
  assert_true(fabs(gamma - 0.41269) < 4.0 * error);
}

CASE(frequencies) {
  jam_system *s = *its_state;
  double error, slope;
  size_t n, k;
  DEFAULTS(modes, o);
  o.count = 200;
  assert_int_equal(eigenvalues(s, &o, x, NULL, ROOM, &n), JAM_OK);
  for (k = 0; k < n; ++k) x[k] = sqrt(x[k]);
  slope = exponent(x, n, x[n - 1], &error); /* flat density down to zero frequency */
  printf("frequencies: exponent of the density %.3f +- %.3f, expected 0\n", slope, error);
  assert_true(fabs(slope) < 4.0 * error);
}

CASE(contact_vectors) {
  jam_system *s = *its_state;
  size_t n, k;
  int bins[40] = {0}, top = 0;
  double nearest = 1.0;
  assert_int_equal(jam_contact_dots(s, 0, x, ROOM, a, ROOM, &n), JAM_OK);
  for (k = 0; k < n; ++k) {
    int bin = (int)((x[k] + 1.0) * 20.0);
    assert_true(x[k] < 0.5 + 1e-9); /* two equal spheres touching a third do not overlap */
    if (bin >= 0 && bin < 40) ++bins[bin];
  }
  for (k = 1; k < 40; ++k)
    if (bins[k] > bins[top]) top = (int)k;
  assert_true(top == 29 || top == 30); /* the bins beside 1/2 */
  assert_int_equal(jam_sphere_structure(s, 0, x, ROOM, y, ROOM, &n), JAM_OK);
  assert_int_equal(jam_coordination(s, b, ROOM, &n), JAM_OK);
  for (k = 0; k < n;
       ++k) { /* S_i reaches its edge at -z/2, where the contact vectors add up to nothing, and never passes it */
    const double c2 = x[3 * k] * x[3 * k] + x[3 * k + 1] * x[3 * k + 1] + x[3 * k + 2] * x[3 * k + 2];
    assert_true(fabs(y[k] - 0.5 * (c2 - b[k])) < 1e-12 && y[k] >= -0.5 * b[k] - 1e-12);
    if (b[k] > 0) nearest = fmin(nearest, y[k] + 0.5 * b[k]);
  }
  assert_true(nearest < 0.02);
  /* with forces the sum over contacts vanishes */
  assert_int_equal(jam_sphere_structure(s, 1, x, ROOM, NULL, 0, &n), JAM_OK);
  for (k = 0; k < 3 * n; ++k) assert_true(fabs(x[k]) < 1e-10);
}

CASE(glass_not_crystal) {
  jam_system *s = *its_state;
  const double score = crystal_score(s);
  assert_true(score > 0.0 && score < 1.2);
}

FIXTURE(setup, teardown)
