/* Cells of any shape: lower triangle, the same lattice by other vectors, strain, files, verdicts, what is refused. */
#include <math.h>
#include <stdio.h>
#include "systems.h"

static jam_create_options options(int32_t dim, int64_t n) {
  DEFAULTS(create, o);
  o.dim = dim, o.n = n;
  return o;
}

static double dot(const double *a, const double *b, int d) {
  double sum = 0.0;
  for (int c = 0; c < d; ++c) sum += a[c] * b[c];
  return sum;
}

CASE(lower_triangle) {
  const double cell[9] = {5.0, 0.4, 0.1, 0.3, 1.1, 0.2, 0.2, 9.3, 2.0};
  double taken[9], rotation[9], given[9];
  int64_t transform[9];
  size_t needed = 0, rows = 0;
  jam_create_options o = options(3, 1);
  const double x[3] = {0.7, -0.4, 0.9}, sigma = 0.1;
  const double *at = NULL;
  jam_system *sys = created_from(&o, x, 3, &sigma, 1);
  assert_int_equal(jam_set_cell(sys, cell, 9, transform, 9, rotation, 9, &rows), JAM_OK);
  assert_int_equal(rows, 3);
  assert_int_equal(jam_get_cell(sys, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, 9);
  assert_int_equal(jam_get_cell(sys, taken, 8, &needed), JAM_E_BUFFER);
  assert_int_equal(jam_get_cell(sys, taken, 9, NULL), JAM_OK);
  for (int r = 0; r < 3; ++r) {
    assert_true(taken[4 * r] > 0.0);
    for (int c = r + 1; c < 3; ++c) assert_true(taken[3 * r + c] == 0.0);
    for (int c = 0; c < 3; ++c) assert_int_equal(transform[3 * r + c], r == c);
    for (int c = 0; c < 3; ++c) {
      assert_true(fabs(dot(rotation + 3 * r, rotation + 3 * c, 3) - (r == c)) < 1e-14);
      given[3 * r + c] = 0.0; /* T cell, which the rotation takes to the new rows */
      for (int k = 0; k < 3; ++k) given[3 * r + c] += (double)transform[3 * r + k] * cell[3 * k + c];
    }
    for (int c = 0; c < 3; ++c) assert_true(fabs(dot(rotation + 3 * c, given + 3 * r, 3) - taken[3 * r + c]) < 1e-13);
  }
  assert_int_equal(jam_view(sys, JAM_VIEW_POSITIONS, &at, &needed), JAM_OK);
  assert_true(at[0] >= 0.0 && at[0] < taken[0] && at[1] < taken[4] && at[2] < taken[8]);
  /* a lower triangle comes back to the last bit, and nothing rotates */
  assert_int_equal(jam_set_cell(sys, taken, 9, transform, 9, rotation, 9, NULL), JAM_OK);
  assert_int_equal(jam_get_cell(sys, given, 9, NULL), JAM_OK);
  assert_memory_equal(given, taken, sizeof taken);
  for (int k = 0; k < 9; ++k) assert_true(transform[k] == (k % 4 == 0) && rotation[k] == (k % 4 == 0));
  jam_destroy(sys);
}

/* A triangular lattice of side^2 disks without those of `holes`, by vectors with or without a large tilt. */
static jam_system *hexagonal(int side, int holes, double tilt) {
  const double h = sqrt(0.75), sigma = 1.0;
  double x[2 * 64];
  const double cell[4] = {side, 0.0, 0.5 * side + tilt * side, h * side};
  size_t n = 0;
  jam_system *sys = NULL;
  for (int k = holes; k < side * side; ++k, ++n) {
    x[2 * n] = k % side + 0.5 * (k / side);
    x[2 * n + 1] = h * (k / side);
  }
  jam_create_options o = options(2, (int64_t)n);
  assert_int_equal(create_in_cell(&o, cell, 4, x, 2 * n, &sigma, 1, &sys), JAM_OK);
  return sys;
}

static jam_rigidity_report rigidity(jam_system *sys, int32_t kind) {
  SIZED(jam_rigidity_report, r);
  assert_true(jam_rigidity(sys, kind, &r) >= 0);
  return r;
}

/* Donev, Torquato, Stillinger, Connelly, J. Comput. Phys. 197, 139 (2004): a vacancy leaves the triangular lattice
 * strictly jammed, two in a row do not. Flexes counted by an independent program. */
CASE(triangular_lattices) {
  const struct { int holes, jammed, flexes; } cases[] = {{0, 1, 0}, {1, 1, 0}, {2, 0, 2}, {3, 0, 6}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    for (int tilt = 0; tilt <= 5; tilt += 5) {
      jam_system *sys = hexagonal(8, cases[k].holes, tilt);
      const jam_info info = info_of(sys);
      assert_true(fabs(info.packing_fraction - (64 - cases[k].holes) / 64.0 * M_PI / sqrt(12.0)) < 1e-14);
      assert_true(jam_contacts_from_geometry(sys, NULL, NULL) >= 0);
      for (int32_t kind = JAM_RIGIDITY_COLLECTIVE; kind <= JAM_RIGIDITY_STRICT; ++kind) {
        const jam_rigidity_report r = rigidity(sys, kind);
        assert_int_equal(r.jammed, cases[k].jammed ? JAM_VERDICT_YES : JAM_VERDICT_NO);
        assert_int_equal(r.flexes, cases[k].flexes);
      }
      jam_destroy(sys);
    }
}

/* A random start in one basis, crunched in two: the same jammed packing. */
CASE(crunch_does_not_depend_on_the_basis) {
  for (int32_t dim = 2; dim <= 3; ++dim) {
    const int64_t n = 60;
    double cell[9] = {0.0}, wide[9], sizes[60], distance[2];
    int64_t contacts[2];
    jam_create_options o = options(dim, n);
    jam_system *sys = NULL;
    o.packing_fraction = dim == 2 ? 0.4 : 0.25;
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c <= r; ++c) cell[r * dim + c] = r == c ? 1.0 + 0.1 * r : 0.3;
    for (int k = 0; k < 60; ++k) sizes[k] = k % 2 ? 1.4 : 1.0;
    assert_int_equal(create_in_cell(&o, cell, (size_t)(dim * dim), NULL, 0, sizes, (size_t)n, &sys), JAM_OK);
    memcpy(wide, cell, sizeof cell);
    wide[(dim - 1) * dim] += 5.0 * cell[0];
    for (int k = 0; k < 2; ++k) {
      jam_crunch_report r = {.struct_size = sizeof r};
      jam_system *copy = copy_of(sys);
      if (k) assert_int_equal(jam_set_cell(copy, wide, (size_t)(dim * dim), NULL, 0, NULL, 0, NULL), JAM_OK);
      assert_int_equal(jam_crunch(copy, NULL, &r), JAM_OK);
      assert_int_equal(r.jammed, 1);
      assert_int_equal(r.excess_contacts, 0);
      assert_true(r.max_overlap < 1e-13 && r.force_residual < 1e-12);
      distance[k] = r.packing_fraction, contacts[k] = r.contacts;
      jam_destroy(copy);
    }
    assert_true(fabs(distance[1] - distance[0]) < 1e-12); /* equal to the last digits */
    assert_int_equal(contacts[0], contacts[1]);
    jam_destroy(sys);
  }
}

/* A shear and its reverse give the energy back, through a cell whose tilt exceeds half an edge. */
CASE(shear_and_back) {
  jam_create_options o = options(2, 40);
  const double shear[3][4] = {{0.0, 0.8, 0.0, 0.0}, {0.0, -0.8, 0.0, 0.0}, {0.0}};
  double energy[3], cell[4];
  o.overlap = JAM_OVERLAP_ALLOW, o.packing_fraction = 0.9;
  jam_system *sys = created(&o);
  for (int k = 0; k < 3; ++k) {
    jam_relax_report r = {.struct_size = sizeof r};
    DEFAULTS(relax, ro);
    ro.max_evaluations = 1;
    jam_system *copy = copy_of(sys);
    assert_true(jam_relax(copy, &ro, &r) >= 0);
    energy[k] = r.energy;
    jam_destroy(copy);
    assert_int_equal(jam_strain(sys, shear[k], 4), JAM_OK);
  }
  assert_true(fabs(energy[2] - energy[0]) < 1e-12 * energy[0]);
  assert_true(fabs(energy[1] - energy[0]) > 1e-3 * energy[0]);
  assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
  assert_true(fabs(cell[0] * cell[3] - 1.0) < 1e-14); /* a shear keeps the volume */
  jam_destroy(sys);
}

/* r -> (1 + strain) r by numbers: a point and the cell vectors. */
CASE(strain_is_affine) {
  jam_create_options o = options(2, 1);
  const double x[2] = {0.2, 0.4}, sigma = 0.1, strain[4] = {0.5, 0.25, 0.0, 0.25};
  double cell[4];
  jam_system *sys = created_from(&o, x, 2, &sigma, 1);
  assert_int_equal(jam_strain(sys, strain, 4), JAM_OK);
  assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
  assert_true(fabs(cell[0] - 1.5) < 1e-15 && cell[1] == 0.0);
  assert_true(fabs(cell[2] - 0.25) < 1e-15 && fabs(cell[3] - 1.25) < 1e-15);
  const double *at = view_of(sys, JAM_VIEW_POSITIONS);
  assert_true(fabs(at[0] - 0.4) < 1e-15 && fabs(at[1] - 0.5) < 1e-15);
  jam_destroy(sys);
}

CASE(files) {
  const char *const path = "cell_test.xyz", *const plain = "cell_test.dat", *const check = "cell_test.check";
  for (int32_t dim = 2; dim <= 5; ++dim) {
    double cell[25] = {0.0}, back[25];
    const double *x = NULL, *y = NULL;
    size_t len = 0, count = (size_t)(dim * dim);
    jam_create_options o = options(dim, 12);
    jam_system *sys = NULL, *other = NULL;
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c <= r; ++c) cell[r * dim + c] = r == c ? 1.0 + r / 7.0 : c % 2 ? 0.1 : -1.0 / 3.0;
    o.packing_fraction = 0.01;
    assert_int_equal(create_in_cell(&o, cell, count, NULL, 0, NULL, 0, &sys), JAM_OK);
    assert_int_equal(jam_get_cell(sys, cell, count, NULL), JAM_OK);
    assert_int_equal(jam_view(sys, JAM_VIEW_POSITIONS, &x, &len), JAM_OK);
    assert_int_equal(jam_write(sys, plain, JAM_FORMAT_AUTO), JAM_E_UNSUPPORTED);
    assert_int_equal(jam_write(sys, path, JAM_FORMAT_AUTO), JAM_OK);
    assert_int_equal(jam_write_checkpoint(sys, check), JAM_OK);
    for (int k = 0; k < 2; ++k) {
      assert_int_equal(k ? jam_read_checkpoint(check, NULL, NULL, &other) : jam_read(path, NULL, NULL, NULL, &other),
                       JAM_OK);
      assert_int_equal(jam_get_cell(other, back, count, NULL), JAM_OK);
      assert_memory_equal(back, cell, count * sizeof *cell);
      assert_int_equal(jam_view(other, JAM_VIEW_POSITIONS, &y, &len), JAM_OK);
      assert_memory_equal(x, y, len * sizeof *x);
      jam_destroy(other);
    }
    jam_destroy(sys);
  }
  remove(path), remove(check);
}

/* Vectors of the lattice of the unit cube. With m = 1e6 they are reduced to it; with 1e12 the transform has m^2 = 1e24,
 * which 64-bit integers do not hold. */
CASE(huge_multiples) {
  for (int much = 0; much < 2; ++much) {
    const double m = much ? 1e12 : 1e6, rows[9] = {1, 0, 0, m, 1, 0, 0, m, 1}, x[3] = {0}, sigma = 0.1;
    jam_create_options o = options(3, 1);
    jam_system *sys = NULL;
    double cell[9];
    assert_int_equal(create_in_cell(&o, rows, 9, x, 3, &sigma, 1, &sys), much ? JAM_E_ARGUMENT : JAM_OK);
    if (much) break;
    assert_int_equal(jam_get_cell(sys, cell, 9, NULL), JAM_OK);
    for (int k = 0; k < 9; ++k) assert_true(cell[k] == (k % 4 == 0));
    jam_destroy(sys);
  }
}

CASE(refused) {
  const double left[4] = {1, 0, 0, -1}, singular[4] = {1, 2, 2, 4}, flat[4] = {1, 0, 0, 1e-7},
               nan_cell[4] = {1, 0, NAN, 1}, zero[4] = {0}, tall[4] = {1.0, 0.0, 0.0, 2.0}, sigma = 0.9,
               x[4] = {0.0, 0.0, 0.5, 1.0};
  jam_create_options o = options(2, 2);
  jam_system *sys = NULL;
  size_t rows = 0;
  assert_int_equal(create_in_cell(&o, left, 4, x, 4, &sigma, 1, &sys), JAM_E_ARGUMENT);
  o.box = 2.0; /* beside vectors: one of the two would be without effect */
  SAYS(create_in_cell(&o, tall, 4, x, 4, &sigma, 1, &sys), JAM_E_ARGUMENT, "box is 2 beside cell vectors");
  o.box = 1.0;
  assert_int_equal(create_in_cell(&o, singular, 4, x, 4, &sigma, 1, &sys), JAM_E_ARGUMENT);
  assert_int_equal(create_in_cell(&o, flat, 4, x, 4, &sigma, 1, &sys), JAM_E_ARGUMENT);
  assert_int_equal(create_in_cell(&o, zero, 4, x, 4, &sigma, 1, &sys), JAM_E_ARGUMENT);
  assert_int_equal(create_in_cell(&o, nan_cell, 4, x, 4, &sigma, 1, &sys), JAM_E_NONFINITE);
  assert_int_equal(create_in_cell(&o, tall, 3, x, 4, &sigma, 1, &sys), JAM_E_ARGUMENT);
  assert_int_equal(create_in_cell(&o, NULL, 4, x, 4, &sigma, 1, &sys), JAM_E_NULL);
  assert_int_equal(create_from(&o, x, 4, &sigma, 1, &sys), JAM_E_OVERLAP); /* in the unit square they are one */
  assert_int_equal(create_in_cell(&o, tall, 4, x, 4, &sigma, 1, &sys), JAM_OK);
  assert_int_equal(jam_structure_factor(sys, 10.0, JAM_STRUCTURE_COLUMNS, NULL, 0, &rows), JAM_OK);
  const double squeeze[4] = {0.0, 0.0, 0.0, -0.5};
  assert_int_equal(jam_strain(sys, squeeze, 4), JAM_E_OVERLAP);
  assert_int_equal(jam_strain(sys, squeeze, 3), JAM_E_ARGUMENT);
  const double collapse[4] = {-1.0, 0.0, 0.0, 0.0};
  assert_int_equal(jam_strain(sys, collapse, 4), JAM_E_ARGUMENT);
  double cell[4];
  assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK); /* nothing has changed */
  assert_memory_equal(cell, tall, sizeof tall);
  jam_destroy(sys);
  /* What depends on the model and not on the cell. */
  o.model = JAM_MODEL_MK, o.packing_fraction = 0.2;
  assert_int_equal(create_in_cell(&o, tall, 4, NULL, 0, NULL, 0, &sys), JAM_OK);
  assert_int_equal(jam_monte_carlo(sys, NULL, NULL), JAM_E_UNSUPPORTED);
  assert_true(jam_run(sys, NULL, NULL) >= 0);
  jam_destroy(sys);
}

/* Mari-Kurchan shifts are fractions of the cell vectors. A strain that would give the cell other vectors is refused; a
 * crunch with strains keeps the vectors that it has. */
CASE(shifts_are_kept) {
  const double small[4] = {0.0, 0.3, 0.0, 0.0}, large[4] = {0.0, 17.0, 0.0, 0.0};
  double cell[4];
  SIZED(jam_crunch_report, r);
  DEFAULTS(create, o);
  o.dim = 2, o.n = 32, o.seed = 1, o.model = JAM_MODEL_MK, o.packing_fraction = 1e-3;
  jam_system *sys = created(&o);
  assert_int_equal(jam_strain(sys, large, 4), JAM_E_UNSUPPORTED);
  assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
  assert_true(cell[2] == 0.0);
  assert_int_equal(jam_strain(sys, small, 4), JAM_OK);
  assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
  assert_true(fabs(cell[2] - 0.3 * cell[0]) < 1e-15);
  jam_destroy(sys);

  DEFAULTS(crunch, c);
  c.strain = JAM_STRAIN_FREE;
  o.dim = 3, o.n = 48, o.packing_fraction = 1.5;
  assert_int_equal(jam_create(&o, NULL, &sys), JAM_OK);
  assert_int_equal(jam_crunch(sys, &c, &r), JAM_OK);
  assert_true(r.jammed && r.strictly_jammed == JAM_VERDICT_YES && r.max_overlap < 1e-12);
  assert_true(r.contacts == 3 * (r.stable - 1) + 6); /* isostatic with six components of stress */
  jam_destroy(sys);
}
