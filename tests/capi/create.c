/* jam_create and its neighbours: every refusal named in the header, views, setters, copies, seeds. */
#include <math.h>
#include <stdlib.h>

#include "steps.h"

/* Status as told, handle untouched, text holding `part`. */
static void refused(const jam_create_options *o, const double *x, size_t nx, const double *s, size_t ns,
                    jam_status status, const char *part) {
  jam_system *out = (jam_system *)0x1;
  assert_int_equal(create_from(o, x, nx, s, ns, &out), status);
  assert_ptr_equal(out, (jam_system *)0x1);
  if (!strstr(jam_last_error(), part)) fail_msg("'%s' does not hold '%s'", jam_last_error(), part);
}

CASE(callers_set_the_text_of_an_error) {
  char longer[5000];
  jam_set_error("of my own");
  assert_string_equal(jam_last_error(), "of my own");
  memset(longer, 'x', sizeof longer - 1);
  longer[sizeof longer - 1] = '\0';
  jam_set_error(longer);
  assert_true(strlen(jam_last_error()) > 100 && strspn(jam_last_error(), "x") == strlen(jam_last_error()));
  jam_set_error(NULL);
  assert_string_equal(jam_last_error(), "");
}

CASE(bad_options_are_refused) {
  DEFAULTS(create, o);
  o.n = 10, o.dim = 1;
  refused(&o, NULL, 0, NULL, 0, JAM_E_DIMENSION, "dim is 1");
  o.dim = 9;
  refused(&o, NULL, 0, NULL, 0, JAM_E_DIMENSION, "dim is 9");
  assert_int_equal(jam_create(NULL, NULL, NULL), JAM_E_NULL);
}

/* Members that an older, shorter struct lacks keep their defaults. */
CASE(shorter_structs_keep_defaults) {
  DEFAULTS(create, o);
  o.n = 50, o.seed = 9, o.box = -1.0; /* box lies beyond the size told: it must not be read */
  o.struct_size = offsetof(jam_create_options, box);
  OWNED jam_system *sys = created(&o);
  const jam_info info = info_of(sys);
  assert_true(info.box == 1.0 && info.seed == 9 && info.n == 50 && info.monodisperse == 1);
  assert_true(fabs(info.packing_fraction - 0.2) < 1e-14);
}

CASE(too_dense_starts_are_refused) {
  DEFAULTS(create, o);
  double mixture[500];
  o.n = 500, o.packing_fraction = 0.55; /* saturation of random sequential addition is 0.384 in d = 3 */
  refused(&o, NULL, 0, NULL, 0, JAM_E_UNPLACEABLE, "ends near 0.384");
  for (int k = 0; k < 500; ++k)
    mixture[k] = k ? 1.0 : 1.001; /* unequal spheres can pack more densely: they are tried */
  refused(&o, NULL, 0, mixture, 500, JAM_E_UNPLACEABLE, "reached packing fraction 0.3");
  o.n = 1, o.packing_fraction = 0.9; /* one sphere wider than the box */
  refused(&o, NULL, 0, NULL, 0, JAM_E_UNPLACEABLE, "shortest period");
}

/* Up to saturation (0.5471 in d = 2, 0.3841 in d = 3; Zhang and Torquato 2013) there is a place for each sphere;
 * beyond, the text says that no room is left, and the fraction reached is that of saturation: systems of 2000 spheres
 * differ by less than 0.005. */
CASE(random_starts_reach_saturation) {
  static const double below[] = {0.54, 0.375}, saturation[] = {0.5471, 0.3841};
  double mixture[2000];
  for (int k = 0; k < 2000; ++k) mixture[k] = k < 200 ? 1.4 : 1.0 + 1e-4 * k;
  for (int dim = 2; dim <= 3; ++dim) {
    DEFAULTS(create, o);
    o.dim = dim, o.n = 2000, o.packing_fraction = below[dim - 2];
    OWNED jam_system *sys = created(&o);
    jam_destroy(sys);
    assert_int_equal(create_from(&o, NULL, 0, mixture, 2000, &sys), JAM_OK);
    jam_destroy(sys);
    o.walls = 1;
    o.packing_fraction *= 0.98; /* walls take room */
    assert_int_equal(jam_create(&o, NULL, &sys), JAM_OK);
    o.walls = 0, o.packing_fraction = 1.02 * saturation[dim - 2];
    refused(&o, NULL, 0, NULL, 0, JAM_E_UNPLACEABLE, "no room is left");
    const char *text = strstr(jam_last_error(), "fraction ");
    assert_non_null(text);
    double reached = strtod(text + 9, NULL);
    assert_true(fabs(reached - saturation[dim - 2]) < 0.005);
  }
}

CASE(bad_arrays_are_refused) {
  DEFAULTS(create, o);
  double x[9] = {0.1, 0.1, 0.1, 0.5, 0.5, 0.5, 0.9, 0.9, 0.9}, s = 0.2, three[3] = {0.2, -0.1, 0.2};
  refused(&o, x, 8, &s, 1, JAM_E_ARGUMENT, "not a multiple of dim");
  refused(&o, NULL, 9, &s, 1, JAM_E_NULL, "positions");
  o.n = 3;
  refused(&o, x, 0, &s, 1, JAM_E_ARGUMENT, "positions has no numbers");
  refused(&o, NULL, 0, &s, 0, JAM_E_ARGUMENT, "diameters has no numbers");
  o.n = 0;
  refused(&o, x, 9, NULL, 1, JAM_E_NULL, "diameters");
  refused(&o, x, 9, NULL, 0, JAM_E_ARGUMENT, "without diameters");
  refused(&o, x, 9, three, 3, JAM_E_ARGUMENT, "diameters[1] is -0.1");
  three[1] = NAN;
  refused(&o, x, 9, three, 3, JAM_E_NONFINITE, "diameters[1]");
  refused(&o, x, 9, three, 2, JAM_E_ARGUMENT, "1 or n");
  o.n = 4;
  refused(&o, x, 9, &s, 1, JAM_E_ARGUMENT, "n * dim is 12");
  o.n = 0, x[4] = INFINITY;
  refused(&o, x, 9, &s, 1, JAM_E_NONFINITE, "sphere 1, component 1");
}

CASE(overlap_is_named_or_shrunk) {
  DEFAULTS(create, o);
  const double x[6] = {0.02, 0.5, 0.5, 0.94, 0.5, 0.5}, s = 0.1; /* 0.08 apart through the wall */
  refused(&o, x, 6, &s, 1, JAM_E_OVERLAP, "spheres 0 and 1 overlap by 0.2");
  o.overlap = JAM_OVERLAP_SHRINK;
  OWNED jam_system *sys = created_from(&o, x, 6, &s, 1);
  const double *const view = view_of(sys, JAM_VIEW_DIAMETERS);
  assert_true(fabs(view[0] - 0.08) < 1e-15 && view[1] == view[0]);
  const double wide = 1e9; /* than the box */
  refused(&o, x, 3, &wide, 1, JAM_E_OVERLAP,
          "they did not fit the cell: to shrink means to multiply all diameters by 1e-09");
  o.shrink_min = 0.0;
  OWNED jam_system *shrunk = created_from(&o, x, 3, &wide, 1);
  assert_true(view_of(shrunk, JAM_VIEW_DIAMETERS)[0] == 1.0);
}

CASE(seeds_differ) {
  OWNED jam_system *a = random_spheres(3, 300, 0.0, 42), *b = random_spheres(3, 300, 0.0, 43);
  assert_memory_not_equal(view_of(a, JAM_VIEW_POSITIONS), view_of(b, JAM_VIEW_POSITIONS), 900 * sizeof(double));
}

CASE(setters_and_copies) {
  DEFAULTS(create, o);
  OWNED jam_system *sys = NULL, *copy = NULL;
  double moved[12];
  o.n = 4, o.packing_fraction = 0.05;
  assert_int_equal(jam_create(&o, NULL, &sys), JAM_OK);
  const double *x = view_of(sys, JAM_VIEW_POSITIONS);
  assert_int_equal(jam_copy(sys, &copy), JAM_OK);
  for (size_t k = 0; k < 12; ++k) moved[k] = (double)(k / 3) * 0.25 + 1.0;
  assert_int_equal(jam_set_positions(sys, moved, 11), JAM_E_ARGUMENT);
  assert_int_equal(jam_set_positions(sys, moved, 12), JAM_OK);
  const double *again = view_of(sys, JAM_VIEW_POSITIONS);
  assert_ptr_equal(again, x);
  assert_true(x[3] == 0.25);
  moved[3] = moved[0], moved[4] = moved[1], moved[5] = moved[2];
  assert_int_equal(jam_set_positions(sys, moved, 12), JAM_E_OVERLAP);
  assert_true(x[3] == 0.25);
  assert_int_equal(jam_scale_diameters(sys, 100.0), JAM_E_OVERLAP);
  assert_int_equal(jam_scale_diameters(sys, NAN), JAM_E_ARGUMENT);
  assert_int_equal(jam_scale_diameters(sys, 0.5), JAM_OK);
  again = view_of(copy, JAM_VIEW_POSITIONS);
  assert_true(again[0] != x[0]);
  jam_destroy(NULL);
}

CASE(statuses_and_builds_have_words) {
  assert_string_equal(jam_status_string(JAM_E_NULL), "a needed pointer is NULL");
  assert_string_equal(jam_status_string(12345), "unknown status");
  assert_string_equal(jam_stop_string(JAM_STOP_CONVERGED), "converged");
  assert_int_equal(jam_abi_version(), JAM_ABI);
  assert_true(jam_commit()[0] == 0 || strspn(jam_commit(), "0123456789abcdef") == 12);
}

/* Random starts in every dimension have no overlap, checked pair by pair with nearest images. */
CASE(random_starts_have_no_overlaps) {
  for (int d = 2; d <= JAM_MAX_DIM; ++d) {
    DEFAULTS(create, o);
    const double *x, *s;
    double diameters[60];
    for (size_t i = 0; i < 60; ++i) diameters[i] = 1.0 + (double)(i % 7);
    o.n = 60, o.dim = d, o.packing_fraction = pow(2.0, 2 - d) * 0.3, o.box = 3.0;
    OWNED jam_system *sys = created_from(&o, NULL, 0, diameters, 60);
    x = view_of(sys, JAM_VIEW_POSITIONS), s = view_of(sys, JAM_VIEW_DIAMETERS);
    for (size_t i = 0; i < 60; ++i)
      for (size_t j = 0; j < i; ++j) {
        double r2 = 0.0;
        for (int c = 0; c < d; ++c) {
          double dx = x[i * d + c] - x[j * d + c];
          dx -= 3.0 * nearbyint(dx / 3.0);
          r2 += dx * dx;
        }
        assert_true(sqrt(r2) >= 0.5 * (s[i] + s[j]));
      }
  }
}
