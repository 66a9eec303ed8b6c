/* jam_rigidity and jam_flex: packings that are jammed, fluids and lattices that are not, and what flexes look like. */
#include <math.h>
#include <stdlib.h>
#include "steps.h"
#include "verdicts.h"

CASE(crunched) {
  OWNED jam_system *sys = random_spheres(3, 64, 0.0, 3);
  SIZED(jam_crunch_report, report);
  double out[3 * 64];
  size_t needed = 0;
  assert_int_equal(jam_crunch(sys, NULL, &report), JAM_OK);
  assert_int_equal(report.jammed, 1);
  assert_int_equal(report.stationary, 1);
  assert_int_equal(report.flexes, 0);
  assert_int_equal(report.strictly_jammed, JAM_VERDICT_UNTESTED);
  assert_int_equal(report.strict_contacts_needed, 3 * (report.stable - 1) + 6);
  assert_true(report.rigidity_margin > 1e-8);
  jam_rigidity_report r = rigidity_test(sys, JAM_RIGIDITY_COLLECTIVE, JAM_OK);
  assert_int_equal(r.stable, report.stable);
  assert_int_equal(r.contacts_needed, report.isostatic_contacts);
  assert_true(r.force_residual < 1e-10);
  assert_int_equal(jam_flex(sys, JAM_RIGIDITY_COLLECTIVE, out, 3 * 64, NULL, 0, &needed), JAM_E_STATE);
  /* With one contact more than isostatic at most, a fixed cube cannot be strictly jammed. */
  r = rigidity_test(sys, JAM_RIGIDITY_STRICT, JAM_NOT_JAMMED);
  assert_int_equal(r.contacts_needed, -1); /* no forces balance on the cell */
  assert_non_null(strstr(jam_last_error(), "collectively jammed, but not strictly jammed: "));
  assert_non_null(
      strstr(jam_last_error(), "jam_crunch with a free cell (strain=free) makes a strictly jammed packing"));
  assert_int_equal(jam_get_crunch_report(sys, &report), JAM_OK);
  assert_int_equal(report.strictly_jammed, JAM_VERDICT_NO);
  assert_int_equal(jam_scale_diameters(sys, 1.0 - 1e-3), JAM_OK);
  r = rigidity_test(sys, JAM_RIGIDITY_COLLECTIVE, JAM_NOT_JAMMED);
  assert_int_equal(r.contacts_needed, -1);
  assert_non_null(strstr(jam_last_error(), "; jam_flex gives a motion, jam_crunch makes a jammed packing"));
  rigidity_test(sys, JAM_RIGIDITY_STRICT, JAM_NOT_JAMMED);
  assert_int_equal(strncmp(jam_last_error(), "not strictly jammed: no pair touches; ", 38), 0);
}

/* Following the flex of a square lattice, no pair comes closer than touching. */
CASE(flex_of_a_lattice) {
  for (int32_t kind = JAM_RIGIDITY_COLLECTIVE; kind <= JAM_RIGIDITY_STRICT; ++kind) {
    OWNED jam_system *sys = square_lattice(6);
    const jam_rigidity_report r = rigidity_test(sys, kind, JAM_NOT_JAMMED);
    double out[72], strain[4], moved[72], largest = 0.0, trace = 0.0;
    const double *x = NULL;
    size_t needed = 0, n = 0;
    assert_int_equal(r.stationary, JAM_VERDICT_YES);
    assert_int_equal(r.flexes, kind == JAM_RIGIDITY_STRICT ? 11 : 10);
    assert_int_equal(r.contacts, 72);
    assert_int_equal(r.undercoordinated, 0);
    assert_int_equal(jam_flex(sys, kind, NULL, 0, NULL, 0, &needed), JAM_OK);
    assert_int_equal(needed, 72);
    assert_int_equal(jam_flex(sys, kind, out, 71, NULL, 0, &needed), JAM_E_BUFFER);
    assert_int_equal(jam_flex(sys, kind, out, 72, strain, 4, &needed), JAM_OK);
    for (int k = 0; k < 36; ++k) largest = fmax(largest, hypot(out[2 * k], out[2 * k + 1]));
    for (int k = 0; k < 4; ++k) largest = fmax(largest, fabs(strain[k]));
    trace = strain[0] + strain[3];
    assert_true(largest > 1e-3 && largest < 1.0 + 1e-9 && trace < 1e-12);
    if (kind == JAM_RIGIDITY_COLLECTIVE) {
      assert_int_equal(jam_view(sys, JAM_VIEW_POSITIONS, &x, &n), JAM_OK);
      for (size_t k = 0; k < n; ++k) moved[k] = x[k] + 0.02 * out[k];
      assert_int_equal(jam_set_positions(sys, moved, n), JAM_OK); /* refused if a pair overlapped */
    }
  }
}

CASE(bad_calls) {
  OWNED jam_system *sys = square_lattice(3);
  double out[18];
  size_t needed = 0;
  assert_int_equal(jam_rigidity(sys, 2, NULL), JAM_E_ARGUMENT);
  assert_int_equal(jam_flex(sys, -1, out, 18, NULL, 0, &needed), JAM_E_ARGUMENT);
  assert_int_equal(jam_flex(sys, JAM_RIGIDITY_COLLECTIVE, NULL, 0, NULL, 0, NULL), JAM_E_NULL);
  assert_int_equal(jam_cancel(sys), JAM_OK);
  assert_int_equal(jam_rigidity(sys, JAM_RIGIDITY_COLLECTIVE, NULL), JAM_CANCELLED);
}

/* Columns of two disks that hold each other over the period: each is a part with one state of self-stress. Its two
 * disks may move apart sideways. Slides of the parts are all counted, other flexes up to a limit, and the states then
 * are not known. */
CASE(flexes_beyond_the_limit) {
  const int32_t columns[] = {300, 520};
  for (int c = 0; c < 2; ++c) {
    const int32_t m = columns[c];
    const double cell[4] = {3.0 * m, 0.0, 0.0, 2.0}, diameter = 1.0;
    double *x = malloc(4 * (size_t)m * sizeof *x);
    jam_start start = {.struct_size = sizeof start};
    OWNED jam_system *sys = NULL;
    assert_non_null(x);
    for (int32_t k = 0; k < 2 * m; ++k) x[2 * k] = 3.0 * (k / 2) + 0.1, x[2 * k + 1] = 0.35 + k % 2;
    DEFAULTS(create, o);
    o.dim = 2, o.n = 2 * m;
    start.positions = x, start.positions_len = 4 * (size_t)m, start.diameters = &diameter, start.diameters_len = 1;
    start.cell = cell, start.cell_len = 4;
    assert_int_equal(jam_create(&o, &start, &sys), JAM_OK);
    const jam_rigidity_report r = rigidity_test(sys, JAM_RIGIDITY_COLLECTIVE, JAM_NOT_JAMMED);
    assert_int_equal(r.contacts, 2 * m);
    assert_int_equal(r.self_stresses, m == 300 ? m : -1);
    if (m == 300)
      assert_int_equal(r.flexes, 3 * m - 2);
    else
      assert_true(r.flexes >= 512 && strstr(jam_last_error(), "at least "));
    free(x);
  }
}

/* Spheres as wide as a slab, whose edges are open or closed: each slides along the axes on which it touches no
 * wall, and nothing else moves. */
CASE(slides_beyond_the_limit) {
  const int side = 24;
  double x[3 * 576];
  const double cell[9] = {36.0, 0.0, 0.0, 0.0, 36.0, 0.0, 0.0, 0.0, 1.0}, diameter = 1.0;
  for (int closed = 0; closed < 2; ++closed) {
    jam_start start = {.struct_size = sizeof start};
    jam_check_report c = {.struct_size = sizeof c};
    OWNED jam_system *sys = NULL;
    for (int k = 0; k < side * side; ++k)
      x[3 * k] = 1.5 * (k % side) + 0.6, x[3 * k + 1] = 1.5 * (k / side) + 0.6, x[3 * k + 2] = 0.5;
    DEFAULTS(create, o);
    o.n = side * side, o.walls = closed ? 6u : 4u;
    start.positions = x, start.positions_len = 3 * 576, start.diameters = &diameter, start.diameters_len = 1;
    start.cell = cell, start.cell_len = 9;
    assert_int_equal(jam_create(&o, &start, &sys), JAM_OK);
    const jam_rigidity_report r = rigidity_test(sys, JAM_RIGIDITY_COLLECTIVE, JAM_NOT_JAMMED);
    assert_int_equal(r.flexes, 2 * o.n - 2 + closed);
    assert_int_equal(r.self_stresses, o.n);
    assert_null(strstr(jam_last_error(), "at least"));
    assert_int_equal(jam_check_packing(sys, NULL, &c), JAM_NOT_JAMMED);
    assert_int_equal(c.reason, JAM_CHECK_SLIDE);
  }
}
