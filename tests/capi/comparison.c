/* Two packings are compared where that has a meaning: what differs is refused or said. */
#include <math.h>

#include "systems.h"

static jam_create_options defaults(int32_t dim, int64_t n) {
  DEFAULTS(create, o);
  o.dim = dim, o.n = n, o.seed = 5, o.packing_fraction = 0.05;
  return o;
}

static jam_system *made(const jam_create_options *o, const double *positions, size_t len, const double *sigma) {
  return created_from(o, positions, len, sigma, sigma ? (size_t)o->n : 0);
}

static jam_status compare(const jam_system *a, const jam_system *b, jam_comparison_report *c) {
  memset(c, 0, sizeof *c);
  c->struct_size = sizeof *c;
  return jam_compare(a, b, c, NULL, 0, NULL);
}

/* Destroys both. */
static void refused(jam_system *a, jam_system *b, const char *what) {
  jam_comparison_report c;
  const jam_status status = compare(a, b, &c);
  if (status != JAM_E_ARGUMENT || !strstr(jam_last_error(), what))
    fail_msg("status %d, '%s', wanted '%s'", status, status ? jam_last_error() : "", what);
  jam_destroy(a);
  jam_destroy(b);
}

CASE(sizes_and_cells_must_agree) {
  jam_create_options a = defaults(2, 20), b = defaults(2, 20);
  const double cell[4] = {1.0, 0.0, 0.25, 1.0};
  b.n = 21;
  refused(made(&a, NULL, 0, NULL), made(&b, NULL, 0, NULL), "n = 20 and 21");
  b = defaults(3, 20);
  refused(made(&a, NULL, 0, NULL), made(&b, NULL, 0, NULL), "d = 2 and 3");
  b = defaults(2, 20), b.box = 2.0;
  refused(made(&a, NULL, 0, NULL), made(&b, NULL, 0, NULL), "component 0 of vector 0 is 1 and 2");
  jam_system *tilted = created_in_cell(&a, cell, 4, NULL, 0, NULL, 0);
  refused(made(&a, NULL, 0, NULL), tilted, "component 0 of vector 1 is 0 and 0.25");
}

/* A pair that touches in one model need not touch in another. */
CASE(models_must_agree) {
  jam_create_options a = defaults(3, 20), b = defaults(3, 20);
  b.model = JAM_MODEL_MK;
  refused(made(&a, NULL, 0, NULL), made(&b, NULL, 0, NULL), "other alone is of Mari and Kurchan");
  refused(made(&b, NULL, 0, NULL), made(&a, NULL, 0, NULL), "sys alone is of Mari and Kurchan");
  a.model = JAM_MODEL_MK, a.mk_zeta = 0.25, b.mk_zeta = 0.5;
  refused(made(&a, NULL, 0, NULL), made(&b, NULL, 0, NULL), "mk_zeta is 0.25 and 0.5");
  a.mk_zeta = 0.5, a.seed = 6;
  refused(made(&a, NULL, 0, NULL), made(&b, NULL, 0, NULL), "seeds 6 and 5");
  a = b = defaults(3, 20);
  b.non_additivity = 0.125;
  refused(made(&a, NULL, 0, NULL), made(&b, NULL, 0, NULL), "non_additivity is 0 and 0.125");
}

CASE(equal_models_are_compared) {
  jam_create_options o = defaults(3, 20);
  OWNED jam_system *a = NULL, *b = NULL;
  jam_comparison_report c;
  o.model = JAM_MODEL_MK;
  a = made(&o, NULL, 0, NULL);
  assert_int_equal(jam_copy(a, &b), JAM_OK);
  assert_int_equal(compare(a, b, &c), JAM_OK);
  assert_true(c.displacement_max == 0.0);
  jam_destroy(b);
  o.mk_zeta = 0.0; /* no shifts: the seed does not matter */
  jam_destroy(a);
  a = made(&o, NULL, 0, NULL);
  o.seed = 7;
  b = made(&o, NULL, 0, NULL);
  assert_int_equal(compare(a, b, &c), JAM_OK);
  assert_int_equal(c.stable_in_both, 20);
}

CASE(a_translation_changes_nothing) {
  jam_create_options o = defaults(3, 20);
  OWNED jam_system *a = made(&o, NULL, 0, NULL), *b = copy_of(a);
  double moved[60];
  for (int k = 0; k < 60; ++k) moved[k] = view_of(a, JAM_VIEW_POSITIONS)[k] + (k % 3 == 0 ? 0.4 : 0.1);
  assert_int_equal(jam_set_positions(b, moved, 60), JAM_OK);
  jam_comparison_report c;
  assert_int_equal(compare(a, b, &c), JAM_OK);
  assert_true(c.stable_in_both == 20 && c.displacement_max < 1e-13 && c.packing_fraction_change == 0.0);
}

/* Growth multiplies all diameters by one factor: that is the change of the packing fraction. Other changes are named.
 */
CASE(diameters_that_differ_are_named) {
  const double x[8] = {0.125, 0.125, 0.625, 0.125, 0.125, 0.625, 0.625, 0.625};
  const double sigma[4] = {0.25, 0.25, 0.125, 0.25}, swapped[4] = {0.25, 0.125, 0.25, 0.25};
  jam_create_options o = defaults(2, 4);
  OWNED jam_system *a = made(&o, x, 8, sigma), *b = made(&o, x, 8, sigma);
  jam_comparison_report c;
  double moved[8];
  size_t m;
  assert_int_equal(jam_scale_diameters(b, 0.7), JAM_OK);
  assert_int_equal(compare(a, b, &c), JAM_OK);
  assert_true(fabs(c.packing_fraction_change + 0.51 * M_PI / 4 * (3 * 0.0625 + 0.015625)) < 1e-14);
  jam_destroy(b);
  b = made(&o, x, 8, swapped);
  memset(&c, 0, sizeof c);
  c.struct_size = sizeof c;
  for (size_t k = 0; k < 8; ++k) moved[k] = 1.0;
  SAYS(jam_compare(a, b, &c, moved, 8, &m), JAM_AMBIGUOUS, "2 of 4 spheres");
  assert_non_null(strstr(jam_last_error(), "sphere 1 with 1.14285714 and 0.571428571 mean diameters"));
  for (size_t k = 0; k < 8; ++k) assert_true(moved[k] == 0.0);
  assert_true(c.displacement_max == 0.0 && c.packing_fraction_change == 0.0);
}

CASE(a_network_that_is_missing_is_named) {
  jam_create_options o = defaults(2, 32);
  OWNED jam_system *a = made(&o, NULL, 0, NULL), *b = NULL;
  jam_comparison_report c;
  assert_int_equal(jam_crunch(a, NULL, NULL), JAM_OK);
  assert_int_equal(jam_copy(a, &b), JAM_OK);
  assert_int_equal(compare(a, b, &c), JAM_OK);
  assert_true(c.overlap == 1.0 && c.overlap_a == 1.0 && c.contacts_a == c.contacts_b && c.contacts_a > 0);
  assert_int_equal(jam_scale_diameters(b, 0.9), JAM_OK); /* clears the network */
  assert_int_equal(compare(a, b, &c), JAM_AMBIGUOUS);
  assert_string_equal(jam_last_error(), "other has no contact network: contacts were not compared");
  assert_true(isnan(c.overlap) && isnan(c.overlap_a) && c.contacts_a > 0 && c.contacts_b == -1);
  assert_int_equal(c.common_contacts, -1);
  assert_int_equal(compare(b, a, &c), JAM_AMBIGUOUS);
  assert_string_equal(jam_last_error(), "sys has no contact network: contacts were not compared");
  assert_int_equal(compare(b, b, &c), JAM_OK);
  assert_true(isnan(c.overlap) && c.displacement_max == 0.0);
}
