/* Scenes in which a contact network is not what one hopes for, by the public calls alone: each has its status and says
 * why in the report; what follows still works or is refused by name. Fluids, crystals and unclear gaps:
 * analysis_errors, network_1ss. */
#include <math.h>

#include "columns.h"
#include "systems.h"

static jam_system *spheres_with(int32_t policy, int dim, int n, double box, double diameter, const double *x) {
  DEFAULTS(create, o);
  o.dim = dim, o.n = n, o.box = box, o.overlap = policy;
  return created_from(&o, x, (size_t)(n * dim), &diameter, 1);
}
static jam_system *spheres(int dim, int n, double box, double diameter, const double *x) {
  return spheres_with(JAM_OVERLAP_REFUSE, dim, n, box, diameter, x);
}

static jam_geometry_report look(jam_system *s, jam_status expected) {
  jam_geometry_report g = {.struct_size = sizeof(jam_geometry_report)};
  DEFAULTS(geometry, o);
  o.tolerance = 1e-9; /* what touches is given; whether it is a network is the question */
  assert_int_equal(jam_contacts_from_geometry(s, &o, &g), expected);
  return g;
}

static void refuses_floppy_modes(jam_system *s, const char *word) {
  double x[1000];
  size_t m;
  SAYS(jam_floppy_modes(s, NULL, 0, JAM_FLOPPY_COLUMNS, x, 1000, NULL, 0, &m), JAM_E_STATE, word);
}

/* Five disks in a row through the box: as many contacts as spheres, and no stiffness sideways. */
CASE(a_single_row_has_no_sideways_stiffness) {
  double x[10];
  jam_geometry_report g;
  jam_system *s;
  size_t m;
  int i;
  for (i = 0; i < 5; ++i) x[2 * i] = i, x[2 * i + 1] = 2.0;
  s = spheres(2, 5, 5.0, 1.0, x);
  g = look(s, JAM_NOT_JAMMED);
  assert_true(g.pairs_within == 5 && g.contacts == 5 && g.clusters == 1);
  assert_int_equal(jam_hessian_map(s, NULL, 0, &m), JAM_OK);
  assert_int_equal(m, 5); /* all carry force, and none is held sideways */
  assert_int_equal(g.zero_modes, 5 + 1);
  jam_destroy(s);
}

/* Two strips of triangular rows that do not touch: each moves freely, and their forces are independent. */
CASE(separate_clusters_have_separate_forces) {
  double x[72], f[84], l[72], residual = 1.0;
  jam_geometry_report g;
  jam_system *s;
  size_t m;
  int i, zero = 0;
  for (i = 0; i < 36; ++i)
    x[2 * i] = i % 6 + 0.5 * (i / 6 % 3 % 2), x[2 * i + 1] = 0.1 + 3.0 * (i / 18) + i / 6 % 3 * sqrt(0.75);
  s = spheres(2, 36, 6.0, 1.0, x);
  g = look(s, JAM_NOT_JAMMED);
  assert_true(g.clusters == 2 && g.contacts == 84 && g.zero_modes == 4);
  assert_int_equal(g.self_stresses, 84 - (72 - 4)); /* counting of Maxwell and Calladine */
  assert_int_equal(jam_stress_states(s, f, 84, NULL, 0, &residual, &m), JAM_AMBIGUOUS);
  assert_true(m == (size_t)g.self_stresses && residual < 1e-12);
  DEFAULTS(modes, o);
  o.which = JAM_MODES_ALL;
  assert_int_equal(eigenvalues(s, &o, l, NULL, 72, &m), JAM_OK);
  for (i = 0; i < 72; ++i) zero += fabs(l[i]) < 1e-10;
  assert_int_equal(zero, g.zero_modes);
  refuses_floppy_modes(s, "self-stress");
  jam_destroy(s);
}

/* A sphere as large as its box touches its own images. These contacts cannot open, so they are counted and left out. */
CASE(contacts_with_own_images_are_left_out) {
  const double x[3] = {0.1, 0.2, 0.3};
  jam_system *s = spheres(3, 1, 1.0, 1.0, x);
  const jam_geometry_report g = look(s, JAM_NOT_JAMMED);
  size_t m;
  assert_true(g.self_contacts == 3 && g.contacts == 0);
  assert_int_equal(jam_contacts(s, NULL, 0, &m), JAM_OK);
  assert_int_equal(m, 0);
  jam_destroy(s);
}

/* Two disks in a checkerboard touch through four images: four contacts of one pair, each with its own vector. */
CASE(several_images_are_several_contacts) {
  const double x[4] = {0.0, 0.0, 0.5, 0.5};
  jam_system *s = spheres(2, 2, 1.0, sqrt(0.5), x);
  const jam_geometry_report g = look(s, JAM_AMBIGUOUS);
  double n[8], f[4], h[8], sum[2] = {0.0, 0.0};
  int32_t pair[8];
  size_t m;
  int k, c;
  assert_true(g.contacts == 4 && g.clusters == 1 && g.zero_modes == 2 && g.self_stresses == 2 &&
              g.excess_contacts == 1);
  assert_int_equal(jam_contacts(s, pair, 8, &m), JAM_OK);
  assert_int_equal(jam_contact_vectors(s, n, 8, &m), JAM_OK);
  assert_int_equal(jam_forces(s, f, 4, &m), JAM_OK);
  for (k = 0; k < 4; ++k) {
    assert_true(pair[2 * k] == 0 && pair[2 * k + 1] == 1 && fabs(f[k] - 1.0) < 1e-12);
    for (c = 0; c < 2; ++c) {
      assert_true(fabs(fabs(n[2 * k + c]) - sqrt(0.5)) < 1e-12);
      sum[c] += f[k] * n[2 * k + c];
    }
  }
  assert_true(fabs(sum[0]) < 1e-12 && fabs(sum[1]) < 1e-12);
  assert_int_equal(jam_gaps(s, 0.5, 1, h, 8, NULL, 0, &m),
                   JAM_OK); /* of the contacts' images none; own images one box away */
  for (k = 0; k < (int)m; ++k) assert_true(fabs(h[k] - (sqrt(2.0) - 1.0)) < 1e-12);
  refuses_floppy_modes(s, "2");
  jam_destroy(s);
}

/* Three disks jam with one state of self-stress although pairs touch through several images. All calls work. */
CASE(three_disks_have_one_self_stress) {
  jam_crunch_report r = {.struct_size = sizeof(jam_crunch_report)};
  jam_geometry_report g;
  double f[8], q[8], b[30];
  size_t m, k;
  DEFAULTS(create, o);
  o.dim = 2, o.n = 3, o.packing_fraction = 0.4;
  jam_system *s = created(&o);
  assert_int_equal(jam_crunch(s, NULL, &r), JAM_OK);
  assert_true(r.contacts == 5 && r.excess_contacts == 0);
  assert_int_equal(jam_forces(s, f, 8, &m), JAM_OK);
  g = look(s, JAM_OK);
  assert_true(g.contacts == 5 && g.self_stresses == 1);
  assert_int_equal(jam_forces(s, q, 8, &m), JAM_OK);
  for (k = 0; k < 5; ++k) assert_true(fabs(f[k] - q[k]) < 1e-9);
  assert_int_equal(jam_floppy_modes(s, NULL, 0, JAM_FLOPPY_COLUMNS, b, 30, NULL, 0, &m), JAM_OK);
  assert_int_equal(m, 5);
  jam_destroy(s);
}

/* Of soft spheres: their contact has no direction, so no network of hard spheres has it. */
CASE(spheres_with_one_centre_are_named) {
  const double x[] = {0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 2.0, 0.0};
  jam_system *s = spheres_with(JAM_OVERLAP_ALLOW, 2, 4, 3.0, 1.0, x);
  DEFAULTS(geometry, o);
  SAYS(jam_contacts_from_geometry(s, &o, NULL), JAM_E_OVERLAP, "spheres 1 and 2 have the same centre");
  SAYS(jam_rigidity(s, JAM_RIGIDITY_COLLECTIVE, NULL), JAM_E_OVERLAP, "spheres 1 and 2 have the same centre");
  jam_destroy(s);
}
