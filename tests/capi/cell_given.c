/* A cell stays as it was given: aspect ratios on each axis, tilts, walls; what is done in it does not depend on the
 * names of the axes; only extreme vectors give way to shorter ones, and a note says so. */
#include <math.h>
#include "steps.h"

enum { N = 24 };

static jam_create_options options(int dim, double fraction) {
  DEFAULTS(create, o);
  o.dim = dim, o.n = N, o.packing_fraction = fraction;
  return o;
}

/* Sides 1, but `ratio` along one axis; each vector leans along the earlier axes by `lean` of their edges. */
static void make_cell(int dim, int axis, double ratio, double lean, double *cell) {
  for (int r = 0; r < dim; ++r)
    for (int c = 0; c < dim; ++c) {
      const double edge = c == axis ? ratio : 1.0;
      cell[r * dim + c] = r == c ? edge : c < r ? lean * fmin(edge, r == axis ? ratio : 1.0) : 0.0;
    }
}

static void expect_same_bits(jam_system *a, jam_system *b) {
  double cell[9];
  const jam_info info = info_of(a);
  assert_int_equal(jam_get_cell(a, cell, (size_t)(info.dim * info.dim), NULL), JAM_OK);
  expect_cell(b, cell, (size_t)(info.dim * info.dim));
  same_view(a, b, JAM_VIEW_POSITIONS);
  same_view(a, b, JAM_VIEW_DIAMETERS);
}

static void expect_read_back(jam_system *sys, int walls) {
  static const char *const path[] = {"cell_given.xyz", "cell_given.data"};
  OWNED jam_system *other = NULL;
  for (int k = 0; k < 2; ++k) {
    assert_int_equal(jam_write(sys, path[k], JAM_FORMAT_AUTO), JAM_OK);
    assert_int_equal(jam_read(path[k], NULL, NULL, NULL, &other), JAM_OK);
    expect_same_bits(sys, other);
    if (!walls) {
      jam_comparison_report same = {.struct_size = sizeof same};
      assert_true(jam_compare(sys, other, &same, NULL, 0, NULL) >= 0);
      assert_true(same.displacement_max == 0.0);
    }
    jam_destroy(other);
    remove(path[k]);
  }
  other = from_checkpoint(sys);
  expect_same_bits(sys, other);
}

/* Growth, dynamics and Monte Carlo leave the cell, and copies and strains act along the axis that is named. */
static void work_in(jam_system *sys, const double *cell, int dim, int axis, int walls) {
  OWNED jam_system *copies = NULL;
  int32_t count[3] = {1, 1, 1};
  double tiled[9], strain[9] = {0.0};
  const size_t len = (size_t)(dim * dim);
  DEFAULTS(compress, c);
  c.growth_rate = 0.03, c.pressure = 20.0;
  assert_true(jam_compress(sys, &c, NULL) >= 0);
  run(sys, 5.0);
  DEFAULTS(monte_carlo, m);
  m.sweeps = 5;
  assert_true(jam_monte_carlo(sys, &m, NULL) >= 0);
  expect_cell(sys, cell, (size_t)(dim * dim));
  expect_read_back(sys, walls);
  if (walls) return;
  count[axis] = 3;
  assert_int_equal(jam_tile(sys, count, (size_t)dim, &copies), JAM_OK);
  for (int q = 0; q < dim; ++q)
    for (int k = 0; k < dim; ++k) tiled[q * dim + k] = count[q] * cell[q * dim + k];
  expect_cell(copies, tiled, (size_t)(dim * dim));
  expect_read_back(copies, 0);
  strain[axis * dim + axis] = 0.1; /* stretches component `axis` of every vector */
  memcpy(tiled, cell, len * sizeof *cell);
  for (int q = 0; q < dim; ++q) tiled[q * dim + axis] += 0.1 * cell[q * dim + axis];
  assert_int_equal(jam_strain(sys, strain, len), JAM_OK);
  expect_cell(sys, tiled, (size_t)(dim * dim));
  expect_read_back(sys, 0);
}

CASE(cells_stay) {
  static const double ratios[] = {1.0, 1.19, 1.21, 3.0, 50.0, 0.25}, leans[] = {0.0, 0.3, -0.5, 1.7};
  for (int dim = 2; dim <= 3; ++dim)
    for (int axis = 0; axis < dim; ++axis)
      for (size_t r = 0; r < sizeof ratios / sizeof *ratios; ++r)
        for (size_t l = 0; l < sizeof leans / sizeof *leans; ++l)
          for (int wall = -1; wall < (l == 0 ? dim : 0); ++wall) {
            double cell[9];
            jam_create_options o = options(dim, 0.1);
            OWNED jam_system *sys = NULL, *given = NULL;
            const double *x, *s;
            size_t len, n;
            if (wall >= 0) o.walls = 1 << wall;
            make_cell(dim, axis, ratios[r], leans[l], cell);
            if (create_in_cell(&o, cell, (size_t)(dim * dim), NULL, 0, NULL, 0, &sys) < 0)
              fail_msg("d %d axis %d ratio %g lean %g wall %d: %s", dim, axis, ratios[r], leans[l], wall,
                       jam_last_error());
            assert_string_equal(jam_notes(sys), "");
            expect_cell(sys, cell, (size_t)(dim * dim));
            jam_view(sys, JAM_VIEW_POSITIONS, &x, &len), jam_view(sys, JAM_VIEW_DIAMETERS, &s, &n);
            assert_int_equal(create_in_cell(&o, cell, (size_t)(dim * dim), x, len, s, n, &given), JAM_OK);
            assert_string_equal(jam_notes(given), "");
            expect_same_bits(sys, given);
            if (wall < 0) {
              int64_t transform[9];
              double rotation[9];
              assert_int_equal(jam_set_cell(sys, cell, (size_t)(dim * dim), transform, (size_t)(dim * dim), rotation,
                                            (size_t)(dim * dim), NULL),
                               JAM_OK);
              expect_cell(sys, cell, (size_t)(dim * dim));
              for (int k = 0; k < dim * dim; ++k)
                assert_true(transform[k] == (k % (dim + 1) == 0) && rotation[k] == (k % (dim + 1) == 0));
            }
            work_in(sys, cell, dim, axis, wall >= 0);
          }
}

/* The same spheres with the axes named in another order have the same pairs, distances and waves. */
CASE(names_of_axes_do_not_matter) {
  for (int dim = 2; dim <= 3; ++dim) {
    double g[3][40], cell[9], turned[9], y[3 * N];
    jam_create_options o = options(dim, 0.2);
    jam_system *sys = NULL, *other = NULL;
    const double *x, *s;
    size_t len, n;
    DEFAULTS(correlation, go);
    go.r_max = 3.0, go.bins = 40;
    make_cell(dim, 0, 7.0, 0.0, cell);
    assert_int_equal(create_in_cell(&o, cell, (size_t)(dim * dim), NULL, 0, NULL, 0, &sys), JAM_OK);
    jam_view(sys, JAM_VIEW_POSITIONS, &x, &len), jam_view(sys, JAM_VIEW_DIAMETERS, &s, &n);
    for (int shift = 0; shift < dim; ++shift) {
      size_t needed;
      for (size_t k = 0; k < len; ++k) y[k - k % (size_t)dim + (k + (size_t)shift) % (size_t)dim] = x[k];
      make_cell(dim, shift, 7.0, 0.0, turned);
      assert_int_equal(create_in_cell(&o, turned, (size_t)(dim * dim), y, len, s, n, &other), JAM_OK);
      assert_int_equal(jam_pair_correlation(other, &go, NULL, 0, g[shift], 40, &needed), JAM_OK);
      for (int k = 0; k < 40; ++k) assert_true(fabs(g[shift][k] - g[0][k]) < 1e-9);
      jam_destroy(other);
    }
    jam_destroy(sys);
  }
}

/* The lattice of given vectors by those of a handle: a tilt of many edges is taken off in place, vectors that are
 * nearly parallel are reduced. Vectors that are not lower-triangular are turned with the spheres, and stay what they
 * are. */
CASE(extreme_vectors_are_replaced) {
  static const struct {
    double cell[4];
    int same, rotated;
  } cases[] = {{{1, 0, 3.3, 1.1}, 1, 0},   {{1, 0, 9, 1}, 1, 0},         {{1, 0, 40, 1}, 0, 0},
               {{1, 0, 0.41, 0.01}, 0, 1}, {{0, 2, -1, 0}, 1, 1},        {{3, 4, -0.8, 0.6}, 1, 1},
               {{50, 0, 0, 1}, 1, 0},      {{50, 0, 0.3 * 50, 1}, 1, 0}, {{1, 0, 20, 50}, 1, 0}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    const double *const given = cases[k].cell, x[2] = {0.3, 0.2}, sigma = 1e-3;
    double cell[4], rotation[4];
    int64_t t[4];
    jam_create_options o = options(2, 0.0);
    o.n = 1;
    OWNED jam_system *sys = created_in_cell(&o, given, 4, x, 2, &sigma, 1);
    assert_int_equal(strstr(jam_notes(sys), "replaced by shorter ones of the same lattice") == NULL, cases[k].same);
    assert_int_equal(strstr(jam_notes(sys), "rotated with the cell") != NULL, cases[k].rotated);
    size_t rows = 0;
    assert_int_equal(jam_set_cell(sys, given, 4, t, 4, rotation, 4, &rows), JAM_OK);
    assert_int_equal(rows, 2);
    assert_int_equal(jam_get_cell(sys, cell, 3, &rows), JAM_E_BUFFER);
    assert_int_equal(t[0] == 1 && t[1] == 0 && t[2] == 0 && t[3] == 1, cases[k].same);
    assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
    if (cases[k].same && !cases[k].rotated) assert_memory_equal(cell, given, sizeof cell);
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) { /* T cell, turned by Q, are the vectors */
        double sum = 0.0;
        for (int q = 0; q < 2; ++q)
          sum += ((double)t[2 * r] * given[q] + (double)t[2 * r + 1] * given[2 + q]) * rotation[2 * c + q];
        assert_true(fabs(sum - cell[2 * r + c]) < 1e-12);
      }
    expect_read_back(sys, 0);
  }
}

/* A shear goes on by one vector of the cell after the other; at last the vectors are replaced, once with a note. */
CASE(shear_without_end) {
  const double shear[4] = {0.0, 0.7, 0.0, 0.0}, lower[4] = {0.0, 0.0, 0.1, 0.0};
  double cell[4];
  jam_create_options o = options(2, 0.02);
  int replaced = 0;
  o.overlap = JAM_OVERLAP_ALLOW;
  OWNED jam_system *sys = created(&o);
  for (int k = 1; k <= 60; ++k) {
    assert_int_equal(jam_strain(sys, shear, 4), JAM_OK);
    assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
    replaced = replaced || fabs(cell[2] - 0.7 * k * cell[3]) > 1e-9;
    assert_int_equal(replaced, *jam_notes(sys) != 0);
    assert_true(fabs(cell[0] * cell[3] - 1.0) < 1e-12 && fabs(cell[2]) < 17.0);
  }
  assert_true(replaced && !strchr(jam_notes(sys), '\n'));
  assert_null(strstr(jam_notes(sys), "rotated"));
  assert_int_equal(jam_strain(sys, lower, 4), JAM_OK);
  assert_non_null(strstr(jam_notes(sys), "the spheres were rotated with the cell"));
}
