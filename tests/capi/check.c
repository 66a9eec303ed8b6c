/* jam_check_packing: the verdict on a packing as it is, and that the handle stays as it was. */
#include <math.h>
#include "steps.h"
#include "verdicts.h"

enum { most_spheres = 256, most = JAM_MAX_DIM * most_spheres };

static jam_check_report check(jam_system *sys, int32_t crunch, jam_status expected) {
  jam_check_report r = {.struct_size = sizeof r};
  DEFAULTS(check, o);
  o.crunch = crunch;
  assert_int_equal(jam_check_packing(sys, &o, &r), expected);
  assert_int_equal(r.struct_size, sizeof r);
  assert_true(strlen(jam_check_text(&r)) > 60);
  if (expected > 0) assert_string_equal(jam_last_error(), jam_check_text(&r));
  return r;
}

/* side^d spheres that touch along the axes. */
static jam_system *cubic(int32_t dim, int side, int32_t overlap, double sigma) {
  double x[most];
  int64_t n = 1;
  for (int c = 0; c < dim; ++c) n *= side;
  DEFAULTS(create, o);
  o.dim = dim, o.n = n, o.box = side, o.overlap = overlap;
  for (int64_t k = 0; k < n; ++k) {
    int64_t rest = k;
    for (int c = 0; c < dim; ++c, rest /= side) x[k * dim + c] = (double)(rest % side);
  }
  return created_from(&o, x, (size_t)(n * dim), &sigma, 1);
}

/* Saddles in all dimensions, and the same spheres apart. */
CASE(cubic_lattices) {
#ifdef JAM_SANITIZED /* d = 7 and 8 take nine tenths of the time: the release build tries them */
  const int32_t last = 6;
#else
  const int32_t last = JAM_MAX_DIM;
#endif
  for (int32_t dim = 2; dim <= last; ++dim) {
    OWNED jam_system *sys = cubic(dim, dim < 5 ? 3 : 2, JAM_OVERLAP_REFUSE, 1.0);
    jam_check_report r = check(sys, 1, JAM_NOT_JAMMED);
    assert_true(r.jammed == JAM_VERDICT_NO && r.strictly_jammed == JAM_VERDICT_NO && r.stationary == JAM_VERDICT_YES);
    assert_true(r.reason == JAM_CHECK_FLEX && r.flexes > 0 && r.dim == dim && r.rattlers == 0);
    assert_true(r.contacts == dim * r.n && r.closed_pairs == r.contacts && r.undecided_contacts == 0);
    assert_true(fabs(r.nearest_gap) < 1e-14 && r.diameter_factor == 1.0 && r.crunch_contacts == -1);
    jam_destroy(sys);
    sys = cubic(dim, 2, JAM_OVERLAP_REFUSE, 0.4);
    r = check(sys, 1, JAM_NOT_JAMMED);
    assert_true(r.reason == JAM_CHECK_APART && r.contacts == 0 && r.excess_contacts == 0 && r.rattlers == r.n);
  }
}

/* Contacts, report and positions are those of the crunch, before and after. */
CASE(leaves_the_handle_alone) {
  jam_crunch_report before = {.struct_size = sizeof before}, after = {.struct_size = sizeof after};
  size_t m = 0, rows = 0;
  OWNED jam_system *sys = random_spheres(3, 64, 0.0, 1), *kept = NULL;
  check(sys, 1, JAM_NOT_JAMMED);
  assert_int_equal(jam_contacts(sys, NULL, 0, &m), JAM_E_STATE);
  assert_int_equal(jam_crunch(sys, NULL, &before), JAM_OK);
  kept = copy_of(sys);
  const jam_check_report r = check(sys, 1, JAM_OK);
  assert_true(r.jammed == JAM_VERDICT_YES && r.reason == JAM_CHECK_PROOF && r.contacts == before.contacts);
  assert_true(r.force_residual < 1e-10 && r.rigidity_margin > 1e-10 && r.max_contact_gap < 1e-10);
  assert_true(r.min_gap == before.min_gap && r.crunch_contacts == -1 && isnan(r.crunch_displacement_max));
  same(kept, sys);
  assert_int_equal(jam_get_crunch_report(sys, &after), JAM_OK);
  assert_memory_equal(&before, &after, sizeof before);
  assert_int_equal(jam_crunch_history(sys, JAM_HISTORY_COLUMNS, NULL, 0, &rows), JAM_OK);
  assert_true(rows > 0);
}

/* Spheres that overlap by a thousandth: their gaps are known no better. */
CASE(overlaps) {
  OWNED jam_system *sys = cubic(3, 3, JAM_OVERLAP_ALLOW, 1.001);
  const jam_check_report r = check(sys, 0, JAM_AMBIGUOUS);
  assert_true(r.jammed == JAM_VERDICT_UNDECIDED && fabs(r.diameter_factor * 1.001 - 1.0) < 1e-12);
  assert_true(r.resolution > 9e-4 && r.nearest_gap < 0.0);
  jam_destroy(sys);
  sys = cubic(3, 3, JAM_OVERLAP_ALLOW, 1.9);
  assert_int_equal(jam_check_packing(sys, NULL, NULL), JAM_AMBIGUOUS);
}

/* A crunch of the copy that does not end in time leaves the verdict that was there. */
CASE(crunch_out_of_time) {
  jam_check_report r = {.struct_size = sizeof r}, whole = r;
  OWNED jam_system *sys = random_spheres(3, 64, 0.0, 1);
  const double *const x = view_of(sys, JAM_VIEW_POSITIONS);
  double few[3 * 64];
  DEFAULTS(create, start);
  start.overlap = JAM_OVERLAP_ALLOW;
  assert_int_equal(jam_compress(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_crunch(sys, NULL, NULL), JAM_OK);
  for (size_t k = 0; k < 3 * 64; ++k) few[k] = floor(x[k] * 1e6 + 0.5) * 1e-6;
  OWNED jam_system *rounded = created_from(&start, few, 3 * 64, view_of(sys, JAM_VIEW_DIAMETERS), 1);
  DEFAULTS(check, o);
  o.crunch = 0;
  assert_int_equal(jam_check_packing(rounded, &o, &whole), JAM_AMBIGUOUS);
  o.crunch = 1, o.wall_time = 1e-6;
  assert_int_equal(jam_check_packing(rounded, &o, &r), JAM_AMBIGUOUS);
  assert_memory_equal(&r, &whole, sizeof r);
  assert_true(r.n == 64 && r.reason == JAM_CHECK_DIGITS && r.crunch_jammed == JAM_VERDICT_UNTESTED);
}

CASE(what_was_not_tested_is_told) {
  OWNED jam_system *sys = cubic(2, 4, JAM_OVERLAP_REFUSE, 1.0);
  jam_check_report r = {.struct_size = 2};
  assert_int_equal(jam_check_packing(sys, NULL, NULL), JAM_NOT_JAMMED);
  assert_string_equal(jam_check_text(NULL), "");
  assert_string_equal(jam_check_text(&r), "");
  assert_int_equal(jam_set_progress(sys, stop_at_once, NULL), JAM_OK);
  r.struct_size = sizeof r, r.jammed = 77;
  assert_int_equal(jam_check_packing(sys, NULL, &r), JAM_CANCELLED);
  assert_true(r.jammed == JAM_VERDICT_UNTESTED && r.strictly_jammed == JAM_VERDICT_UNTESTED && isnan(r.nearest_gap));
  assert_non_null(strstr(jam_check_text(&r), "Not tested"));
  jam_rigidity_report rigid = {.struct_size = sizeof rigid, .jammed = 77};
  assert_int_equal(jam_rigidity(sys, JAM_RIGIDITY_STRICT, &rigid), JAM_CANCELLED);
  assert_true(rigid.jammed == JAM_VERDICT_UNTESTED && rigid.stationary == JAM_VERDICT_UNTESTED);
}
