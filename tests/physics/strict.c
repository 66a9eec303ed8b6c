/* Crunch with a free cell: strictly jammed packings, their count of contacts, small crystals, parts of the strain. */
#include <math.h>
#include <stdlib.h>
#include "systems.h"
#include "verdicts.h"

static jam_system *start(int32_t dim, int64_t n, int64_t seed, int mixed, double phi) {
  double sizes[512];
  DEFAULTS(create, o);
  o.dim = dim, o.n = n, o.seed = seed, o.packing_fraction = phi;
  /* Diameters that all differ: a cluster of seven equal disks has one contact more than it needs. */
  for (int64_t k = 0; k < n; ++k) sizes[k] = mixed ? 1.0 + 0.4 * (double)k / (double)n : 1.0;
  return created_from(&o, NULL, 0, sizes, (size_t)n);
}

static double volume(jam_system *sys, int dim) {
  double cell[64], product = 1.0;
  assert_int_equal(jam_get_cell(sys, cell, (size_t)(dim * dim), NULL), JAM_OK);
  for (int c = 0; c < dim; ++c) product *= cell[c * (dim + 1)];
  return product;
}

/* sum_e f_e r_e n_ea n_eb, which a strict stress makes proportional to the unit matrix: largest part that is not, over
 * the diagonal. */
static double shear_stress(jam_system *sys, int dim) {
  size_t n = 0, len = 0, needed = 0;
  const double *x = NULL, *s = NULL;
  double stress[16] = {0.0}, trace = 0.0, worst = 0.0;
  assert_int_equal(jam_view(sys, JAM_VIEW_POSITIONS, &x, &len), JAM_OK);
  assert_int_equal(jam_view(sys, JAM_VIEW_DIAMETERS, &s, &n), JAM_OK);
  assert_int_equal(jam_forces(sys, NULL, 0, &needed), JAM_OK);
  double *force = malloc(needed * sizeof *force), *vector = malloc(needed * (size_t)dim * sizeof *vector);
  int32_t *pairs = malloc(2 * needed * sizeof *pairs);
  assert_int_equal(jam_forces(sys, force, needed, NULL), JAM_OK);
  assert_int_equal(jam_contacts(sys, pairs, 2 * needed, NULL), JAM_OK);
  assert_int_equal(jam_contact_vectors(sys, vector, needed * (size_t)dim, NULL), JAM_OK);
  for (size_t e = 0; e < needed; ++e)
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        stress[a * dim + b] += force[e] * 0.5 * (s[pairs[2 * e]] + s[pairs[2 * e + 1]]) * vector[e * (size_t)dim + a] *
                               vector[e * (size_t)dim + b];
  for (int a = 0; a < dim; ++a) trace += stress[a * (dim + 1)] / dim;
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b) worst = fmax(worst, fabs(stress[a * dim + b] - (a == b ? trace : 0.0)));
  free(force), free(vector), free(pairs);
  return worst / trace;
}

/* Torquato and Jiao, Phys. Rev. E 82, 061302 (2010); counts: Donev et al., J. Comput. Phys. 197, 139 (2004). */
CASE(disordered) {
  const struct {
    int32_t dim;
    int64_t n, seeds;
  } cases[] = {{2, 64, 4}, {2, 128, 1}, {3, 64, 3}, {4, 64, 1}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    for (int64_t seed = 1; seed <= cases[k].seeds; ++seed) {
      const int32_t d = cases[k].dim;
      OWNED jam_system *sys = start(d, cases[k].n, seed, 1, d == 2 ? 0.5 : d == 3 ? 0.3 : 0.15), *fixed = NULL;
      assert_int_equal(jam_copy(sys, &fixed), JAM_OK);
      const jam_crunch_report before = crunch_with_strain(fixed, JAM_STRAIN_NONE, JAM_OK),
                              r = crunch_with_strain(sys, JAM_STRAIN_FREE, JAM_OK);
      assert_int_equal(before.strictly_jammed, JAM_VERDICT_UNTESTED);
      assert_int_equal(rigidity_test(fixed, JAM_RIGIDITY_STRICT, JAM_NOT_JAMMED).jammed,
                       JAM_VERDICT_NO); /* a fixed cube is not at rest */
      assert_int_equal(r.jammed, 1);
      assert_int_equal(r.strictly_jammed, JAM_VERDICT_YES);
      assert_int_equal(rigidity_test(sys, JAM_RIGIDITY_STRICT, JAM_OK).jammed, JAM_VERDICT_YES);
      assert_int_equal(r.contacts, d * (r.stable - 1) + d * (d + 1) / 2);
      assert_int_equal(r.contacts, r.strict_contacts_needed);
      assert_true(r.packing_fraction >= before.packing_fraction);
      assert_true(r.max_overlap < 1e-13 && r.force_residual < 1e-12 && r.min_force > 0.0);
      assert_true(shear_stress(sys, d) < 1e-8);
      assert_true(shear_stress(fixed, d) > 1e-4);
      assert_true(fabs(volume(sys, d) - 1.0) < 1e-12);
    }
}

/* The densest packings of two and four spheres a cell are face-centred cubic. Two in a cube stop at the body-centred
 * one, which is jammed at fixed cell and a saddle of the free one. */
CASE(small_crystals) {
  const double fcc = M_PI / sqrt(18.0), bcc = M_PI * sqrt(3.0) / 8.0;
  for (int64_t n = 2; n <= 4; n += 2)
    for (int64_t seed = 1; seed <= 3; ++seed) {
      OWNED jam_system *sys = start(3, n, seed, 0, 0.1), *fixed = NULL;
      assert_int_equal(jam_copy(sys, &fixed), JAM_OK);
      if (n == 2) assert_true(fabs(crunch_with_strain(fixed, JAM_STRAIN_NONE, JAM_OK).packing_fraction - bcc) < 1e-12);
      const jam_crunch_report r = crunch_with_strain(sys, JAM_STRAIN_FREE, JAM_OK);
      assert_true(fabs(r.packing_fraction - fcc) < 1e-12);
      assert_int_equal(r.strictly_jammed, JAM_VERDICT_YES);
    }
}

/* Edges alone keep the cell a brick: its diagonal stress is even, the rest is not; the strict test still says no. */
CASE(parts_of_the_strain) {
  double cell[4];
  OWNED jam_system *sys = start(2, 64, 1, 1, 0.5), *tilted = NULL;
  assert_int_equal(jam_copy(sys, &tilted), JAM_OK);
  jam_crunch_report r = crunch_with_strain(sys, JAM_STRAIN_EDGES, JAM_OK);
  assert_int_equal(r.jammed, 1);
  assert_int_equal(r.strictly_jammed, JAM_VERDICT_NO);
  assert_int_equal(r.contacts, 2 * (r.stable - 1) + 2);
  assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
  assert_true(cell[2] == 0.0 && fabs(cell[0] / cell[3] - 1.0) > 1e-6);
  r = crunch_with_strain(tilted, JAM_STRAIN_TILTS, JAM_OK);
  assert_int_equal(r.jammed, 1);
  assert_int_equal(jam_get_cell(tilted, cell, 4, NULL), JAM_OK);
  assert_true(fabs(cell[2]) > 1e-6 && fabs(cell[0] / cell[3] - 1.0) < 1e-12);
  crunch_with_strain(sys, 4, JAM_E_ARGUMENT);
  crunch_with_strain(sys, -1, JAM_E_ARGUMENT);
}
