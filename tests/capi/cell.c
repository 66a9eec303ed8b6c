/* Cells of any shape: lower triangle, the same lattice by other vectors, strain, files, verdicts, what is refused. */
#include <math.h>
#include "steps.h"

static jam_create_options options(int32_t dim, int64_t n) {
  DEFAULTS(create, o);
  o.dim = dim, o.n = n;
  return o;
}

/* A random start in one basis, crunched in two: the same jammed packing. */
CASE(crunch_does_not_depend_on_the_basis) {
  for (int32_t dim = 2; dim <= 3; ++dim) {
    const int64_t n = 60;
    double cell[9] = {0.0}, wide[9], sizes[60], distance[2];
    int64_t contacts[2];
    jam_create_options o = options(dim, n);
    o.packing_fraction = dim == 2 ? 0.4 : 0.25;
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c <= r; ++c) cell[r * dim + c] = r == c ? 1.0 + 0.1 * r : 0.3;
    for (int k = 0; k < 60; ++k) sizes[k] = k % 2 ? 1.4 : 1.0;
    OWNED jam_system *sys = created_in_cell(&o, cell, (size_t)(dim * dim), NULL, 0, sizes, (size_t)n);
    memcpy(wide, cell, sizeof cell);
    wide[(dim - 1) * dim] += 5.0 * cell[0];
    for (int k = 0; k < 2; ++k) {
      jam_crunch_report r = {.struct_size = sizeof r};
      OWNED jam_system *copy = copy_of(sys);
      if (k) assert_int_equal(jam_set_cell(copy, wide, (size_t)(dim * dim), NULL, 0, NULL, 0, NULL), JAM_OK);
      assert_int_equal(jam_crunch(copy, NULL, &r), JAM_OK);
      assert_int_equal(r.jammed, 1);
      assert_int_equal(r.excess_contacts, 0);
      assert_true(r.max_overlap < 1e-13 && r.force_residual < 1e-12);
      distance[k] = r.packing_fraction, contacts[k] = r.contacts;
    }
    assert_true(fabs(distance[1] - distance[0]) < 1e-12); /* equal to the last digits */
    assert_int_equal(contacts[0], contacts[1]);
  }
}

/* r -> (1 + strain) r by numbers: a point and the cell vectors. */
CASE(strain_is_affine) {
  jam_create_options o = options(2, 1);
  const double x[2] = {0.2, 0.4}, sigma = 0.1, strain[4] = {0.5, 0.25, 0.0, 0.25};
  double cell[4];
  OWNED jam_system *sys = created_from(&o, x, 2, &sigma, 1);
  assert_int_equal(jam_strain(sys, strain, 4), JAM_OK);
  assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
  assert_true(fabs(cell[0] - 1.5) < 1e-15 && cell[1] == 0.0);
  assert_true(fabs(cell[2] - 0.25) < 1e-15 && fabs(cell[3] - 1.25) < 1e-15);
  const double *at = view_of(sys, JAM_VIEW_POSITIONS);
  assert_true(fabs(at[0] - 0.4) < 1e-15 && fabs(at[1] - 0.5) < 1e-15);
}

/* In d = 2 and 3: cell_given. */
CASE(files_in_higher_dimensions) {
  const char *const path = "cell_test.xyz";
  for (int32_t dim = 4; dim <= 5; ++dim) {
    double cell[25] = {0.0};
    size_t count = (size_t)(dim * dim);
    jam_create_options o = options(dim, 12);
    jam_system *sys = NULL, *other = NULL;
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c <= r; ++c) cell[r * dim + c] = r == c ? 1.0 + r / 7.0 : c % 2 ? 0.1 : -1.0 / 3.0;
    o.packing_fraction = 0.01;
    assert_int_equal(create_in_cell(&o, cell, count, NULL, 0, NULL, 0, &sys), JAM_OK);
    assert_int_equal(jam_get_cell(sys, cell, count, NULL), JAM_OK);
    assert_int_equal(jam_write(sys, "cell_test.dat", JAM_FORMAT_AUTO), JAM_E_UNSUPPORTED);
    assert_int_equal(jam_write(sys, path, JAM_FORMAT_AUTO), JAM_OK);
    for (int k = 0; k < 2; ++k) {
      if (k == 0) assert_int_equal(jam_read(path, NULL, NULL, NULL, &other), JAM_OK);
      if (k == 1) other = from_checkpoint(sys);
      expect_cell(other, cell, count);
      same_view(sys, other, JAM_VIEW_POSITIONS);
      jam_destroy(other);
    }
    jam_destroy(sys);
  }
  remove(path);
}

/* Vectors of the lattice of the unit cube. With m = 1e6 they are reduced to it; with 1e12 the transform has m^2 = 1e24,
 * which 64-bit integers do not hold. */
CASE(huge_multiples) {
  for (int much = 0; much < 2; ++much) {
    const double m = much ? 1e12 : 1e6, rows[9] = {1, 0, 0, m, 1, 0, 0, m, 1}, x[3] = {0}, sigma = 0.1;
    jam_create_options o = options(3, 1);
    OWNED jam_system *sys = NULL;
    double cell[9];
    assert_int_equal(create_in_cell(&o, rows, 9, x, 3, &sigma, 1, &sys), much ? JAM_E_ARGUMENT : JAM_OK);
    if (much) break;
    assert_int_equal(jam_get_cell(sys, cell, 9, NULL), JAM_OK);
    for (int k = 0; k < 9; ++k) assert_true(cell[k] == (k % 4 == 0));
  }
}

CASE(refused) {
  const double left[4] = {1, 0, 0, -1}, singular[4] = {1, 2, 2, 4}, flat[4] = {1, 0, 0, 1e-7},
               nan_cell[4] = {1, 0, NAN, 1}, zero[4] = {0}, tall[4] = {1.0, 0.0, 0.0, 2.0}, sigma = 0.9,
               x[4] = {0.0, 0.0, 0.5, 1.0};
  jam_create_options o = options(2, 2);
  OWNED jam_system *sys = NULL;
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
}

/* Mari-Kurchan shifts are fractions of the cell vectors. A strain that would give the cell other vectors is refused; a
 * crunch with strains keeps the vectors that it has. */
CASE(shifts_are_kept) {
  const double small[4] = {0.0, 0.3, 0.0, 0.0}, large[4] = {0.0, 17.0, 0.0, 0.0};
  double cell[4];
  SIZED(jam_crunch_report, r);
  DEFAULTS(create, o);
  o.dim = 2, o.n = 32, o.seed = 1, o.model = JAM_MODEL_MK, o.packing_fraction = 1e-3;
  OWNED jam_system *sys = created(&o);
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
}
