/* Spheres that touch their own images: one sphere in a free cell ends at a lattice, and the strict test says so. */
#include <math.h>
#include "columns.h"
#include "systems.h"
#include "verdicts.h"

static jam_system *in_cell(int32_t dim, int64_t n, const double *cell, const double *x, double sigma) {
  jam_system *sys = NULL;
  const size_t d = (size_t)dim;
  DEFAULTS(create, o);
  o.dim = dim, o.n = n;
  assert_int_equal(create_in_cell(&o, cell, d * d, x, d * (size_t)n, &sigma, 1, &sys), JAM_OK);
  return sys;
}

/* One sphere in a cell with edges of 0.7 to 1.3 and tilts of -0.5 to 0.5. */
static jam_system *alone(int32_t dim, uint64_t seed) {
  double cell[25] = {0.0}, x[5] = {0.0};
  uint64_t state = 1000 * seed + (uint64_t)dim;
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b <= a; ++b) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const double u = (double)(state >> 11) * 0x1p-53;
      cell[a * dim + b] = a == b ? 0.7 + 0.6 * u : u - 0.5;
    }
  return in_cell(dim, 1, cell, x, 0.3);
}

/* Lattices whose density is a local maximum: Conway and Sloane, Sphere Packings, Lattices and Groups, 3rd ed.,
 * ch. 1 and 4; that there are no others up to d = 5: Korkine and Zolotareff, Math. Ann. 11, 242 (1877). */
static const struct {
  int32_t dim, contacts;
  double density, gap; /* to the next neighbours */
} lattices[] = {
    {2, 3, M_PI / 3.4641016151377546, 0.7320508075688772},        /* A2 */
    {3, 6, M_PI / 4.242640687119285, 0.41421356237309505},        /* A3, face-centred cubic */
    {4, 12, M_PI *M_PI / 16.0, 0.41421356237309505},              /* D4 */
    {4, 10, M_PI *M_PI / 17.88854381999832, 0.41421356237309505}, /* A4 */
};
enum { kinds = sizeof lattices / sizeof *lattices };

/* Contacts of the one sphere: i = j, each with two touching points, forces that make an even pressure. */
static void check_contacts(jam_system *sys, int dim, int contacts) {
  int32_t pair[24], z;
  double f[12], n[48], h[12];
  const size_t m = (size_t)contacts, d = (size_t)dim;
  assert_int_equal(jam_contacts(sys, pair, 2 * m, NULL), JAM_OK);
  assert_int_equal(jam_forces(sys, f, m, NULL), JAM_OK);
  assert_int_equal(jam_contact_vectors(sys, n, m * d, NULL), JAM_OK);
  assert_int_equal(jam_contact_gaps(sys, h, m, NULL), JAM_OK);
  assert_int_equal(jam_coordination(sys, &z, 1, NULL), JAM_OK);
  assert_int_equal(z, 2 * contacts);
  for (size_t k = 0; k < m; ++k) assert_true(pair[2 * k] == 0 && pair[2 * k + 1] == 0 && fabs(h[k]) < 1e-13);
  for (size_t a = 0; a < d; ++a)
    for (size_t b = 0; b < d; ++b) {
      double stress = 0.0;
      for (size_t k = 0; k < m; ++k) stress += f[k] * n[k * d + a] * n[k * d + b];
      assert_true(fabs(stress - (a == b ? (double)contacts / dim : 0.0)) < 1e-9);
    }
}

CASE(one_sphere_ends_at_a_lattice) {
  int found[kinds] = {0};
  for (int32_t d = 2; d <= 4; ++d)
    for (uint64_t seed = 1; seed <= 6; ++seed) {
      OWNED jam_system *sys = alone(d, seed);
      const jam_crunch_report r = crunch_with_strain(sys, JAM_STRAIN_FREE, JAM_OK);
      int k = 0;
      while (k < kinds && !(lattices[k].dim == d && fabs(r.packing_fraction - lattices[k].density) < 1e-12)) ++k;
      print_message("d %d seed %d: phi %.15f contacts %d\n", d, (int)seed, r.packing_fraction, (int)r.contacts);
      assert_in_range(k, 0, kinds - 1);
      ++found[k];
      assert_true(r.jammed == 1 && r.strictly_jammed == JAM_VERDICT_YES && r.stop_reason == JAM_STOP_CONVERGED);
      assert_true(r.contacts == lattices[k].contacts && r.rattlers == 0 && r.stable == 1);
      assert_true(r.strict_contacts_needed == d * (d + 1) / 2 && r.isostatic_contacts == 1);
      assert_true(r.max_overlap < 1e-13 && r.min_force > 0.0 && fabs(r.min_gap - lattices[k].gap) < 1e-12);
      check_contacts(sys, d, lattices[k].contacts);
      const jam_rigidity_report strict = rigidity_test(sys, JAM_RIGIDITY_STRICT, JAM_OK);
      assert_true(strict.contacts == r.contacts && strict.stable == 1 && strict.flexes == 0 &&
                  strict.undercoordinated == 0);
      assert_int_equal(strict.self_stresses, r.contacts - (d * (d + 1) / 2 - 1));
      rigidity_test(sys, JAM_RIGIDITY_COLLECTIVE, JAM_OK); /* a motion of one sphere is a translation */
    }
  for (int k = 0; k < 3; ++k) assert_true(found[k] > 0);
}

/* Modes, stresses and moduli of one sphere: only strains cost energy. */
CASE(analysis_of_one_sphere) {
  OWNED jam_system *sys = alone(3, 1);
  jam_moduli_report moduli = {.struct_size = sizeof moduli};
  double l[3], cell[9], table[36], s, force[6], residual;
  const double *sigma;
  size_t m;
  crunch_with_strain(sys, JAM_STRAIN_FREE, JAM_OK);
  DEFAULTS(modes, o);
  o.which = JAM_MODES_ALL;
  assert_int_equal(eigenvalues(sys, &o, l, NULL, 3, &m), JAM_OK);
  assert_int_equal(m, 3);
  for (int k = 0; k < 3; ++k) assert_true(l[k] == 0.0);
  /* each contact balances by itself in a fixed cell */
  assert_int_equal(jam_stress_states(sys, force, 6, NULL, 0, &residual, &m), JAM_AMBIGUOUS);
  assert_int_equal(m, 6);
  assert_int_equal(jam_floppy_modes(sys, NULL, 0, JAM_FLOPPY_COLUMNS, table, 36, NULL, 0, &m), JAM_E_STATE);
  /* both sides of each contact pull on the one sphere: C = 0, and S = (0 - 12) / 2 */
  assert_int_equal(jam_sphere_structure(sys, 0, table, 3, &s, 1, &m), JAM_OK);
  assert_true(fabs(table[0]) + fabs(table[1]) + fabs(table[2]) < 1e-14 && fabs(s + 6.0) < 1e-14);
  /* six springs of stiffness 1 and length sigma, and no motion that relaxes them */
  assert_int_equal(jam_get_cell(sys, cell, 9, NULL), JAM_OK);
  assert_int_equal(jam_view(sys, JAM_VIEW_DIAMETERS, &sigma, &m), JAM_OK);
  assert_int_equal(jam_moduli(sys, NULL, &moduli), JAM_OK);
  assert_true(fabs(moduli.bulk - 2.0 / 3.0 * sigma[0] * sigma[0] / (cell[0] * cell[4] * cell[8])) < 1e-12);
  assert_true(moduli.shear_min > 0.4 * moduli.bulk && moduli.shear == moduli.shear_affine);
}

/* A strain of the edges alone leaves a brick: not strictly jammed, and the flex is a strain. A cube is at rest then. */
CASE(one_sphere_in_a_brick) {
  const double cell[9] = {1.0, 0.0, 0.0, 0.0, 1.2, 0.0, 0.0, 0.0, 0.9}, x[3] = {0.5, 0.5, 0.5};
  OWNED jam_system *sys = in_cell(3, 1, cell, x, 0.5);
  double move[3], strain[9], size = 0.0;
  const jam_crunch_report r = crunch_with_strain(sys, JAM_STRAIN_EDGES, JAM_OK);
  assert_true(fabs(r.packing_fraction - M_PI / 6.0) < 1e-12);
  assert_true(r.jammed == 1 && r.contacts == 3 && r.strictly_jammed == JAM_VERDICT_NO);
  assert_int_equal(jam_flex(sys, JAM_RIGIDITY_STRICT, move, 3, strain, 9, NULL), JAM_OK);
  for (int k = 0; k < 9; ++k) size = fmax(size, fabs(strain[k]));
  assert_true(size > 1e-3);
  assert_true(crunch_with_strain(sys, JAM_STRAIN_FREE, JAM_OK).packing_fraction > r.packing_fraction + 0.1);
}

/* Two disks in a narrow brick touch their own images first. In the fixed cell these are no contacts; in a free one the
 * two end at the hexagonal lattice, which counts all six neighbours of each. */
CASE(two_disks_in_a_narrow_cell) {
  const double cell[4] = {1.0, 0.0, 0.0, 4.0}, x[4] = {0.1, 0.3, 0.45, 2.2};
  OWNED jam_system *fixed = in_cell(2, 2, cell, x, 0.5), *sys = NULL;
  int32_t pair[12], own = 0;
  size_t m;
  assert_int_equal(jam_copy(fixed, &sys), JAM_OK);
  jam_crunch_report r = crunch_with_strain(fixed, JAM_STRAIN_NONE, JAM_NOT_JAMMED);
  assert_true(r.contacts == 0 && r.rattlers == 2 && r.jammed == 0);
  assert_true(fabs(r.packing_fraction - M_PI / 8.0) < 1e-12);
  assert_int_equal(rigidity_test(fixed, JAM_RIGIDITY_COLLECTIVE, JAM_NOT_JAMMED).contacts, 0);
  r = crunch_with_strain(sys, JAM_STRAIN_FREE, JAM_OK);
  assert_true(fabs(r.packing_fraction - lattices[0].density) < 1e-12);
  assert_true(r.strictly_jammed == JAM_VERDICT_YES && r.contacts == 6 && r.stable == 2);
  assert_int_equal(jam_contacts(sys, pair, 12, &m), JAM_OK);
  for (int k = 0; k < 6; ++k) own += pair[2 * k] == pair[2 * k + 1];
  assert_int_equal(own, 2);
}

/* Two spheres of d = 5 that reach a cubic lattice of own images in the fixed cube: narrow programs strain it alone, and
 * their bound must not shrink with the displacements, which are 0. */
CASE(strains_alone_are_steps) {
  DEFAULTS(create, o);
  o.dim = 5, o.n = 2, o.seed = 49, o.packing_fraction = 0.02;
  OWNED jam_system *sys = created(&o);
  assert_int_equal(crunch_with_strain(sys, JAM_STRAIN_FREE, JAM_OK).strictly_jammed, JAM_VERDICT_YES);
}

CASE(one_sphere_in_a_fixed_cell_is_refused) {
  OWNED jam_system *sys = alone(3, 1);
  crunch_with_strain(sys, JAM_STRAIN_NONE, JAM_E_TOO_FEW);
  assert_true(strstr(jam_last_error(), "free cell") != NULL);
}
