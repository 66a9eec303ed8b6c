/* What analysis calls say to wrong arguments, missing networks, packings that are not jammed, and short buffers. */
#include <math.h>

#include "steps.h"

static const int64_t contact = 0;

static int32_t stop(const jam_progress *p, void *user) {
  *(int32_t *)user = p->phase;
  return 1;
}

CASE(flags_are_0_or_1) {
  OWNED jam_system *s = random_spheres(3, 50, 0.0, 1);
  double x;
  size_t m;
  SAYS(jam_gaps(s, 1.0, 2, &x, 1, NULL, 0, &m), JAM_E_ARGUMENT, "stable_only is 2");
  assert_int_equal(jam_sphere_structure(s, -1, &x, 1, NULL, 0, &m), JAM_E_ARGUMENT);
  assert_int_equal(jam_contact_dots(s, 2, &x, 1, NULL, 0, &m), JAM_E_ARGUMENT);
}

CASE(the_error_names_the_call_that_finds_contacts) {
  OWNED jam_system *s = random_spheres(3, 50, 0.0, 1);
  SIZED(jam_moduli_report, moduli);
  size_t m;
  assert_int_equal(jam_gaps(s, 1.0, 1, NULL, 0, NULL, 0, &m), JAM_E_STATE);
  assert_int_equal(jam_gaps(s, 1.0, 0, NULL, 0, NULL, 0, &m), JAM_OK);
  SAYS(jam_moduli(s, NULL, &moduli), JAM_E_STATE, "jam_contacts_from_geometry");
}

/* A square lattice has floppy rows and columns. */
CASE(hyperstatic_networks_have_several_self_stresses) {
  OWNED jam_system *s = square_lattice(4);
  jam_geometry_report r = {.struct_size = sizeof(jam_geometry_report)};
  double f[32], basis[8 * 32], u[32], residual = 1.0;
  size_t m;
  assert_int_equal(jam_contacts_from_geometry(s, NULL, &r), JAM_NOT_JAMMED);
  assert_int_equal(r.contacts, 32);
  assert_int_equal(r.excess_contacts, 32 - (2 * 15 + 1));
  assert_int_equal(r.self_stresses, 8);
  assert_int_equal(jam_stress_states(s, f, 32, basis, 8 * 32, &residual, &m), JAM_AMBIGUOUS);
  assert_int_equal(m, 8);
  assert_true(residual < 1e-13);
  for (int k = 0; k < 32; ++k) assert_true(fabs(f[k] - 1.0) < 1e-12);
  /* opening one contact has no unique answer */
  SAYS(jam_floppy_modes(s, &contact, 1, JAM_FLOPPY_COLUMNS, NULL, 0, u, 32, &m), JAM_E_STATE, "8");
}

/* Of a long strip of a square lattice: one state a row and a column, which take more memory than its factor. */
CASE(a_basis_is_within_the_memory_limit) {
  enum { WIDE = 4, LONG = 64, SPHERES = WIDE * LONG, CONTACTS = 2 * SPHERES, STATES = WIDE + LONG };
  static double x[2 * SPHERES], f[CONTACTS], basis[STATES * CONTACTS];
  const double cell[4] = {WIDE, 0.0, 0.0, LONG}, diameter = 1.0;
  size_t m;
  for (int k = 0; k < SPHERES; ++k) x[2 * k] = k % WIDE, x[2 * k + 1] = k / WIDE;
  DEFAULTS(create, c);
  c.dim = 2, c.n = SPHERES;
  OWNED jam_system *s = created_in_cell(&c, cell, 4, x, 2 * SPHERES, &diameter, 1);
  assert_int_equal(jam_contacts_from_geometry(s, NULL, NULL), JAM_NOT_JAMMED);
  assert_int_equal(jam_set_memory_limit(s, 0.99 * sizeof basis), JAM_OK);
  assert_int_equal(jam_stress_states(s, f, CONTACTS, NULL, 0, NULL, &m), JAM_AMBIGUOUS);
  assert_int_equal(m, STATES);
  SAYS(jam_stress_states(s, f, CONTACTS, basis, STATES * CONTACTS, NULL, &m), JAM_E_MEMORY, "68 states");
  assert_int_equal(jam_set_memory_limit(s, 1.01 * sizeof basis), JAM_OK);
  assert_int_equal(jam_stress_states(s, f, CONTACTS, basis, STATES * CONTACTS, NULL, &m), JAM_AMBIGUOUS);
}

/* The random signs of two or three spheres are often those of a translation, which is left out. */
CASE(few_spheres_have_a_density_of_states) {
  for (int n = 2; n < 4; ++n) {
    OWNED jam_system *s = random_spheres(3, n, 0.05, 1);
    DEFAULTS(dos, o);
    double table[4 * JAM_DOS_COLUMNS];
    size_t m;
    assert_int_equal(jam_crunch(s, NULL, NULL), JAM_OK);
    o.points = 4;
    assert_int_equal(jam_density_of_states(s, NULL, &o, JAM_DOS_COLUMNS, table, sizeof table / sizeof *table, &m),
                     JAM_OK);
    assert_true(table[3 * JAM_DOS_COLUMNS + JAM_DOS_CUMULATIVE] > 0.99);
  }
}

/* A tolerance below rounding: what does not converge is NaN, and nothing else. */
CASE(modes_that_do_not_converge_are_unknown) {
  for (int cells = 13; cells < 37; cells += 3) {
    OWNED jam_system *s = square_lattice(cells);
    DEFAULTS(modes, o);
    double table[5 * JAM_MODE_COLUMNS];
    size_t m, known = 0;
    o.which = JAM_MODES_HIGHEST, o.tolerance = 1e-17, o.count = 3;
    assert_int_equal(jam_contacts_from_geometry(s, NULL, NULL), JAM_NOT_JAMMED);
    const jam_status status = jam_modes(s, NULL, &o, JAM_MODE_COLUMNS, table, 6, NULL, 0, &m);
    assert_true(status == JAM_OK || status == JAM_NOT_CONVERGED);
    assert_int_equal(m, 3);
    for (size_t k = 0; k < m; ++k) {
      const double *row = table + k * JAM_MODE_COLUMNS;
      assert_int_equal(isnan(row[JAM_MODE_LAMBDA]), isnan(row[JAM_MODE_PARTICIPATION]));
      if (isnan(row[JAM_MODE_LAMBDA])) continue;
      ++known;
      assert_true(row[JAM_MODE_LAMBDA] > 3.9 && row[JAM_MODE_LAMBDA] < 4.0 + 1e-9);
      assert_true(row[JAM_MODE_PARTICIPATION] > 0.9 / (cells * cells) && row[JAM_MODE_PARTICIPATION] <= 1.0);
    }
    assert_int_equal(status == JAM_OK, known == m);
  }
}

/* The memory of the handle, where an option allows more. */
CASE(the_memory_of_the_handle_limits_modes) {
  OWNED jam_system *s = square_lattice(20);
  DEFAULTS(modes, o);
  double table[800 * JAM_MODE_COLUMNS];
  size_t m;
  assert_int_equal(jam_contacts_from_geometry(s, NULL, NULL), JAM_NOT_JAMMED);
  o.count = 3, o.frequency = 1.1;
  for (o.which = JAM_MODES_LOWEST; o.which <= JAM_MODES_ALL; ++o.which) {
    assert_int_equal(jam_set_memory_limit(s, 1e9), JAM_OK);
    assert_int_equal(jam_modes(s, NULL, &o, JAM_MODE_COLUMNS, table, 1600, NULL, 0, &m), JAM_OK);
    assert_int_equal(jam_set_memory_limit(s, o.which == JAM_MODES_HIGHEST ? 1e5 : 3e5), JAM_OK);
    SAYS(jam_modes(s, NULL, &o, JAM_MODE_COLUMNS, table, 1600, NULL, 0, &m), JAM_E_MEMORY, "B");
  }
}

CASE(bad_arguments_are_refused) {
  OWNED jam_system *s = square_lattice(4), *t = random_spheres(3, 50, 0.0, 1);
  jam_comparison_report c = {.struct_size = sizeof(jam_comparison_report)};
  double x[2000];
  int32_t i[2000];
  size_t m;
  DEFAULTS(modes, o);
  assert_int_equal(jam_contacts_from_geometry(s, NULL, NULL), JAM_NOT_JAMMED);
  assert_int_equal(jam_hessian(s, NULL, NULL, 0, NULL, 0, NULL, 0, NULL), JAM_E_NULL);
  assert_int_equal(jam_hessian(s, NULL, i, 32, NULL, 0, NULL, 0, &m), JAM_E_BUFFER);
  assert_int_equal(m, 32 * 2 * 5); /* needed is set: every sphere has its own block and four neighbours' */
  assert_int_equal(jam_hessian(s, NULL, i, 33, i + 40, 400, x, 400, &m), JAM_OK);
  o.count = 1000000;
  assert_int_equal(jam_modes(s, NULL, &o, JAM_MODE_COLUMNS, NULL, 0, NULL, 0, &m), JAM_OK);
  assert_int_equal(m, 30); /* no more than there are */
  assert_int_equal(jam_modes(s, NULL, &o, JAM_MODE_COLUMNS, x, 59, NULL, 0, &m), JAM_E_BUFFER);
  o.memory_limit = 10.0;
  SAYS(jam_modes(s, NULL, &o, JAM_MODE_COLUMNS, x, 100, NULL, 0, &m), JAM_E_MEMORY, "bytes");
  assert_int_equal(jam_gaps(s, -1.0, 0, NULL, 0, NULL, 0, &m), JAM_E_ARGUMENT);
  SAYS(jam_gaps(t, 1000.0, 0, NULL, 0, NULL, 0, &m), JAM_E_MEMORY, "B, more than "); /* in units that fit */
  DEFAULTS(correlation, pairs);
  pairs.bins = 10;
  assert_int_equal(jam_pair_correlation(s, &pairs, i, 3, NULL, 0, &m), JAM_E_ARGUMENT);
  assert_int_equal(jam_structure_factor(s, INFINITY, JAM_STRUCTURE_COLUMNS, NULL, 0, &m), JAM_E_ARGUMENT);
  assert_int_equal(jam_structure_factor(s, 1e7, JAM_STRUCTURE_COLUMNS, NULL, 0, &m), JAM_E_ARGUMENT);
  SAYS(jam_structure_factor(s, 1e12, JAM_STRUCTURE_COLUMNS, NULL, 0, &m), JAM_E_ARGUMENT, "too much work");
  assert_int_equal(jam_bond_order(s, 0, 1.2, NULL, 0, &m), JAM_E_ARGUMENT);
  assert_int_equal(jam_local_fraction(s, NULL, 0, &m), JAM_E_UNSUPPORTED);
  assert_int_equal(jam_local_values(s, 8, 0, NULL, 0, &m), JAM_E_ARGUMENT);
  assert_int_equal(jam_local_values(s, 0, 5, NULL, 0, &m), JAM_E_ARGUMENT);
  assert_int_equal(jam_local_values(s, JAM_LOCAL_VECTOR_SUM, JAM_POPULATION_MEDIAN, NULL, 0, &m), JAM_E_ARGUMENT);
  assert_int_equal(jam_compare(s, t, &c, NULL, 0, NULL), JAM_E_ARGUMENT);
}

/* An array that is too short: the call says how long it must be, and a call that is to give nothing is refused. */
CASE(short_arrays_get_their_size) {
  OWNED jam_system *s = square_lattice(4);
  static const double cell[4] = {1, 0, 0, 1};
  static const int32_t copies[2] = {2, 1};
  static double x[64];
  static int64_t whole[64];
  const double side = info_of(s).box;
  double own[4];
  size_t m = 777;
  DEFAULTS(voxel, v);
  v.nx = v.ny = 4;
#define SHORT(count, call) m = 777, assert_int_equal(call, JAM_E_BUFFER), assert_int_equal(m, count)
  SHORT(16, jam_voxels(s, &v, NULL, x, 4, &m));
  SHORT(32, jam_compare(s, s, NULL, x, 4, &m));
  for (int k = 0; k < 4; ++k) own[k] = cell[k] * side;
  SHORT(2, jam_set_cell(s, own, 4, whole, 3, NULL, 0, &m));
  SHORT(2, jam_set_cell(s, own, 4, NULL, 0, x, 3, &m));
  assert_int_equal(jam_contacts_from_geometry(s, NULL, NULL), JAM_NOT_JAMMED);
  SHORT(32, jam_refined_positions(s, NULL, 0, x, 4, NULL, 0, &m));
  SHORT(16, jam_elastic_tensor(s, NULL, x, 4, NULL, 0, &m));
  SHORT(32, jam_flex(s, JAM_RIGIDITY_COLLECTIVE, NULL, 0, x, 3, &m));
  SHORT(2, jam_bloch_rigidity(s, copies, 2, x, 3, JAM_BLOCH_COLUMNS, NULL, 0, &m));
  SHORT(16, jam_sphere_structure(s, 0, x, 3, NULL, 0, &m));
  m = 777;
  assert_int_equal(jam_stress_states(s, x, 1, NULL, 0, NULL, &m), JAM_E_BUFFER);
  const size_t states = m;
  SHORT(states, jam_stress_states(s, NULL, 0, x, 1, NULL, &m));
  assert_int_equal(jam_stress_states(s, NULL, 0, NULL, 0, NULL, &m), JAM_AMBIGUOUS);
  assert_int_equal(m, states);
#undef SHORT
  DEFAULTS(observe, o);
  assert_int_equal(jam_observe(s, &o), JAM_OK);
  m = 777;
  assert_int_equal(jam_observed_spheres(s, whole, 16, NULL, 0, &m), JAM_E_STATE); /* collisions were not observed */
  assert_int_equal(m, 777);
  assert_int_equal(jam_observed_spheres(s, NULL, 0, NULL, 0, NULL), JAM_E_NULL);
  assert_int_equal(jam_observed_spheres(s, NULL, 0, x, 3, &m), JAM_E_BUFFER);
  assert_int_equal(m, 16);
  o.collisions = 1;
  assert_int_equal(jam_observe(s, &o), JAM_OK);
  assert_int_equal(jam_observed_pairs(s, NULL, 0, NULL, 0, NULL, 0, NULL, NULL), JAM_E_NULL);
}

/* Every long call stops at the first callback that asks for it, writes no output, and works again afterwards. */
CASE(every_long_call_can_be_cancelled) {
  OWNED jam_system *s = square_lattice(4), *one = NULL;
  jam_moduli_report moduli = {.struct_size = sizeof(jam_moduli_report), .bulk = 7.0};
  jam_geometry_report g = {.struct_size = sizeof(jam_geometry_report), .contacts = 7};
  int32_t phase = 0;
  double x[256] = {7.0}, f[256] = {7.0}, table[1200] = {7.0}, residual = 7.0;
  size_t m;
  DEFAULTS(modes, o);
  o.which = JAM_MODES_ALL;
  assert_int_equal(jam_contacts_from_geometry(s, NULL, NULL), JAM_NOT_JAMMED);
  assert_int_equal(jam_set_progress(s, stop, &phase), JAM_OK);
  assert_int_equal(jam_contacts_from_geometry(s, NULL, &g), JAM_CANCELLED);
  assert_int_equal(jam_stress_states(s, f, 256, NULL, 0, &residual, &m), JAM_CANCELLED);
  assert_int_equal(jam_density_of_states(s, NULL, NULL, JAM_DOS_COLUMNS, table, 1200, &m), JAM_CANCELLED);
  assert_int_equal(jam_modes(s, NULL, &o, JAM_MODE_COLUMNS, x, 64, NULL, 0, &m), JAM_CANCELLED);
  assert_int_equal(jam_moduli(s, NULL, &moduli), JAM_CANCELLED);
  assert_int_equal(jam_structure_factor(s, 50.0, JAM_STRUCTURE_COLUMNS, NULL, 0, &m), JAM_CANCELLED);
  assert_int_equal(phase, JAM_PHASE_ANALYSE);
  assert_true(x[0] == 7.0 && f[0] == 7.0 && table[0] == 7.0 && residual == 7.0 && isnan(moduli.bulk) &&
              g.contacts == 7); /* a report of moduli is unknown, all else is as it was */
  assert_int_equal(jam_set_progress(s, NULL, NULL), JAM_OK);
  assert_int_equal(jam_stress_states(s, f, 256, NULL, 0, &residual, &m),
                   JAM_AMBIGUOUS); /* the network is still there */
  /* floppy modes need one state of self-stress */
  one = random_spheres(3, 40, 0.0, 1);
  assert_int_equal(jam_crunch(one, NULL, NULL), JAM_OK);
  assert_int_equal(jam_set_progress(one, stop, &phase), JAM_OK);
  f[0] = 7.0;
  assert_int_equal(jam_floppy_modes(one, NULL, 0, JAM_FLOPPY_COLUMNS, table, 1200, NULL, 0, &m), JAM_CANCELLED);
  assert_int_equal(jam_floppy_modes(one, &contact, 1, JAM_FLOPPY_COLUMNS, NULL, 0, f, 256, &m), JAM_CANCELLED);
  assert_true(f[0] == 7.0 && table[0] == 7.0);
}

/* Of soft spheres: their contact has no direction, so no network of hard spheres has it. */
CASE(spheres_with_one_centre_are_named) {
  const double x[] = {0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 2.0, 0.0};
  const double diameter = 1.0;
  DEFAULTS(create, c);
  c.dim = 2, c.box = 3.0, c.overlap = JAM_OVERLAP_ALLOW;
  OWNED jam_system *s = created_from(&c, x, 8, &diameter, 1);
  DEFAULTS(geometry, o);
  SAYS(jam_contacts_from_geometry(s, &o, NULL), JAM_E_OVERLAP, "spheres 1 and 2 have the same centre");
  SAYS(jam_rigidity(s, JAM_RIGIDITY_COLLECTIVE, NULL), JAM_E_OVERLAP, "spheres 1 and 2 have the same centre");
}
