/* Soft spheres by the C header: which calls take overlaps, what is refused, what comes back. */
#include "columns.h"
#include "steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void expect_overlap(jam_status status) {
  SAYS(status, JAM_E_OVERLAP, "overlap by");
  assert_non_null(strstr(jam_last_error(), "jam_decompress"));
}

CASE(hard_verbs_refuse_overlaps) {
  OWNED jam_system *sys = soft_start(60, 0.7, 1);
  jam_estimate_report e = {.struct_size = sizeof e};
  expect_overlap(jam_run(sys, NULL, NULL));
  expect_overlap(jam_compress(sys, NULL, NULL));
  expect_overlap(jam_crunch(sys, NULL, NULL));
  DEFAULTS(monte_carlo, mc);
  mc.step = 0.1; /* no state of hard spheres overlaps: every step would be rejected */
  assert_int_equal(jam_monte_carlo(sys, &mc, NULL), JAM_E_OVERLAP);
  expect_overlap(jam_estimate_crunch(sys, NULL, &e));
  /* What the text advises mends it. */
  double factor = 0.0;
  assert_int_equal(sscanf(strstr(jam_last_error(), "(sys, ") + 6, "%lf", &factor), 1);
  OWNED jam_system *copy = copy_of(sys);
  assert_int_equal(jam_scale_diameters(copy, factor), JAM_OK);
  run(copy, 1.0);
  /* Setters take overlaps here, and nowhere else. */
  double closer[180];
  for (size_t k = 0; k < 180; ++k) closer[k] = 0.5 * view_of(sys, JAM_VIEW_POSITIONS)[k];
  assert_int_equal(jam_set_positions(sys, closer, 180), JAM_OK);
  assert_int_equal(jam_scale_diameters(sys, 1.01), JAM_OK);
  assert_int_equal(jam_scale_diameters(sys, 1e3), JAM_E_OVERLAP); /* wider than the box */
  OWNED jam_system *hard = NULL;
  assert_int_equal(jam_create(NULL, NULL, &hard), JAM_E_ARGUMENT);
  hard = random_spheres(3, 60, 0.0, 1);
  SAYS(jam_relax(hard, NULL, NULL), JAM_E_STATE, "JAM_OVERLAP_ALLOW");
  assert_int_equal(jam_decompress(hard, NULL, NULL), JAM_E_STATE);
}

/* Soft Monte Carlo leaves overlaps, of a system that had none too. Calls for hard spheres say so, soft ones go on. */
CASE(soft_monte_carlo_leaves_overlaps) {
  OWNED jam_system *sys = random_spheres(3, 60, 0.3, 1);
  DEFAULTS(monte_carlo, o);
  o.alpha = 2.0, o.temperature = 0.1, o.sweeps = 50;
  assert_int_equal(jam_monte_carlo(sys, &o, NULL), JAM_OK);
  expect_overlap(jam_crunch(sys, NULL, NULL));
  assert_true(jam_relax(sys, NULL, NULL) >= 0);
}

/* Energy after a strain x times e, relaxed. */
static double strained_energy(const jam_system *sys, const double *e, double x) {
  double strain[9];
  jam_relax_report r = {.struct_size = sizeof r};
  for (int k = 0; k < 9; ++k) strain[k] = x * e[k];
  OWNED jam_system *copy = copy_of(sys);
  assert_int_equal(jam_strain(copy, strain, 9), JAM_OK);
  assert_int_equal(jam_relax(copy, NULL, &r), JAM_OK);
  return r.energy;
}

/* The relaxed tensor along any gradient is the curvature of the relaxed energy a volume. */
CASE(elastic_tensor) {
  enum { GRADIENTS = 3 };
  static const double gradient[GRADIENTS][9] = {
      {0.3, -0.8, 0.5, 0.1, 0.6, -0.4, 0.9, 0.2, -0.7},
      {0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, /* to first order a rotation */
      {-0.2, 0.4, 0.7, 0.9, -0.5, 0.3, -0.6, 0.8, 0.1}};
  OWNED jam_system *sys = soft_start(80, 0.75, 3);
  jam_relax_report r = {.struct_size = sizeof r};
  jam_moduli_report m = {.struct_size = sizeof m};
  double affine[81], relaxed[81], bare[81], shear = 0.0;
  size_t needed;
  DEFAULTS(hessian, h);
  h.stiffness = JAM_STIFFNESS_SOFT, h.prestress = 1.0;
  assert_int_equal(jam_elastic_tensor(sys, &h, NULL, 0, NULL, 0, &needed), JAM_E_STATE);
  assert_int_equal(jam_relax(sys, NULL, &r), JAM_OK);
  assert_int_equal(jam_elastic_tensor(sys, &h, NULL, 0, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, 81);
  assert_int_equal(jam_elastic_tensor(sys, &h, NULL, 0, NULL, 0, NULL), JAM_E_NULL);
  assert_int_equal(jam_elastic_tensor(sys, &h, affine, 80, NULL, 0, NULL), JAM_E_BUFFER);
  assert_int_equal(jam_elastic_tensor(sys, &h, affine, 81, relaxed, 81, NULL), JAM_OK);
  for (int g = 0; g < GRADIENTS; ++g) {
    const double x = 2e-6, *e = gradient[g];
    double form = 0.0, free_form = 0.0;
    for (int k = 0; k < 81; ++k) {
      form += e[k / 9] * e[k % 9] * relaxed[k];
      free_form += e[k / 9] * e[k % 9] * affine[k];
    }
    const double change =
        (strained_energy(sys, e, x) - 2.0 * strained_energy(sys, e, 0.0) + strained_energy(sys, e, -x)) / (x * x);
    print_message("form %.6g (affine %.6g), energies %.6g\n", form, free_form, change);
    assert_true(fabs(change / form - 1.0) < 1e-4);
    assert_true(form < free_form + 1e-9);
  }
  assert_int_equal(jam_moduli(sys, &h, &m), JAM_OK);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (a != b) shear += relaxed[10 * (3 * a + b)] / 6.0;
  assert_true(fabs(shear / m.shear - 1.0) < 1e-12);
  /* The bulk modulus is -V dP/dV: diameters up by x are lengths down by x, and energies stay. */
  const double x = 1e-7;
  jam_relax_report up = {.struct_size = sizeof up};
  OWNED jam_system *grown = copy_of(sys);
  assert_int_equal(jam_scale_diameters(grown, 1.0 + x), JAM_OK);
  assert_int_equal(jam_relax(grown, NULL, &up), JAM_OK);
  assert_true(fabs((up.pressure * pow(1.0 + x, 3.0) - r.pressure) / (3.0 * x) / m.bulk - 1.0) < 1e-3);
  h.prestress = 1.5;
  assert_int_equal(jam_moduli(sys, &h, &m), JAM_E_ARGUMENT);
  /* Unstressed, a rotation costs nothing. */
  h.prestress = 0.0;
  assert_int_equal(jam_elastic_tensor(sys, &h, NULL, 0, bare, 81, NULL), JAM_OK);
  for (int ab = 0; ab < 9; ++ab)
    for (int cd = 0; cd < 9; ++cd)
      assert_true(fabs(bare[9 * ab + cd] - bare[9 * (3 * (ab % 3) + ab / 3) + cd]) < 1e-10);
}

/* Rounding is named where no sum of forces meets the tolerance, and not a crystal. */
CASE(forces_at_rounding) {
  OWNED jam_system *sys = soft_start(60, 0.7, 1);
  DEFAULTS(decompress, o);
  o.force_tolerance = 1e-20;
  SAYS(jam_decompress(sys, &o, NULL), JAM_PRECISION, "forces are at rounding");
}

static int32_t stop_soon(const jam_progress *p, void *user) {
  assert_true(p->phase == JAM_PHASE_DECOMPRESS || p->phase == JAM_PHASE_RELAX);
  return ++*(int *)user > 1;
}

CASE(down_to_jamming) {
  OWNED jam_system *sys = soft_start(80, 0.72, 5), *copy = NULL;
  jam_decompress_report d = {.struct_size = sizeof d};
  jam_crunch_report report = {.struct_size = sizeof report};
  assert_int_equal(jam_copy(sys, &copy), JAM_OK);
  assert_int_equal(jam_decompress(sys, NULL, &d), JAM_OK);
  assert_true(d.isostatic == 1 && d.same_network == 1 && d.excess_contacts == 0 && d.common_contacts == d.contacts);
  /* the extrapolation leaves a small part of the distance */
  assert_true(fabs(d.jammed_fraction / d.crunch_fraction - 1.0) < 0.01 * d.distance && d.force_difference < 0.1);
  assert_int_equal(jam_get_crunch_report(sys, &report), JAM_OK);
  assert_true(report.jammed == 1 && report.contacts == d.contacts && report.packing_fraction == d.crunch_fraction);
  size_t needed = 0;
  assert_int_equal(column_of(jam_decompress_history, sys, JAM_SOFT_SECONDS + 1, 0, NULL, 0, &needed), JAM_OK);
  assert_true(needed == (size_t)(d.steps - d.restored) + 1);
  double *p = malloc(needed * sizeof *p);
  assert_int_equal(column_of(jam_decompress_history, sys, JAM_SOFT_SECONDS + 1, JAM_SOFT_PRESSURE, p, needed, &needed),
                   JAM_OK);
  for (size_t k = 1; k < needed; ++k) assert_true(p[k] < p[k - 1]);
  assert_true(p[needed - 1] == d.pressure);
  free(p);
  int calls = 0;
  assert_int_equal(jam_set_progress(copy, stop_soon, &calls), JAM_OK);
  assert_int_equal(jam_cancel(copy), JAM_OK);
  assert_int_equal(jam_scale_diameters(copy, 0.999), JAM_OK); /* waits for the next verb */
  assert_int_equal(jam_decompress(copy, NULL, &d), JAM_CANCELLED);
  assert_int_equal(d.stop_reason, JAM_STOP_CANCELLED);
  assert_int_equal(calls, 0); /* else the callback stopped it */
  assert_int_equal(jam_set_progress(copy, NULL, NULL), JAM_OK);
  assert_int_equal(jam_decompress(copy, NULL, &d), JAM_OK); /* goes on, to another end: it starts from where it was */
}

CASE(unjammed_start) {
  OWNED jam_system *sys = soft_start(60, 0.3, 1);
  jam_decompress_report d = {.struct_size = sizeof d};
  jam_relax_report r = {.struct_size = sizeof r};
  assert_int_equal(jam_decompress(sys, NULL, &d), JAM_NOT_JAMMED);
  assert_true(d.stop_reason == JAM_STOP_UNJAMMED && d.energy == 0.0 && d.same_network == -1 &&
              isnan(d.crunch_fraction));
  assert_int_equal(jam_relax(sys, NULL, &r), JAM_NOT_JAMMED);
  assert_true(r.converged == 1 && r.rattlers == 60 && r.contacts == 0);
}

static int32_t stop_in_crunch(const jam_progress *p, void *user) {
  (void)user;
  return p->phase == JAM_PHASE_CRUNCH || p->phase == JAM_PHASE_POLISH;
}

/* A crunch that did not end compares nothing, and what stopped it stops the call. */
CASE(a_stop_in_the_crunch_is_one_of_the_call) {
  OWNED jam_system *sys = soft_start(80, 0.72, 5);
  jam_decompress_report d = {.struct_size = sizeof d};
  DEFAULTS(decompress, o);
  o.isostatic = 0, o.pressure = 1e-3;
  assert_int_equal(jam_set_progress(sys, stop_in_crunch, NULL), JAM_OK);
  assert_int_equal(jam_decompress(sys, &o, &d), JAM_CANCELLED);
  assert_int_equal(d.stop_reason, JAM_STOP_CANCELLED);
  assert_true(d.same_network == -1 && d.common_contacts == -1 && isnan(d.crunch_fraction));
  assert_true(d.pressure <= 1e-3 && d.contacts > 0); /* the soft packing is kept */
}

static void cancel_at_log(int32_t level, const char *line, void *user) {
  (void)level;
  if (strstr(line, " excess 0 ")) jam_cancel(user);
}

/* The log of a step comes before the test whether its network is isostatic. */
CASE(the_test_for_an_isostatic_network_can_be_stopped) {
  OWNED jam_system *sys = soft_start(80, 0.72, 5), *unmoved = copy_of(sys);
  jam_decompress_report d = {.struct_size = sizeof d};
  DEFAULTS(decompress, o);
  o.crunch = 0;
  assert_int_equal(jam_set_log(sys, cancel_at_log, JAM_LOG_INFO, sys), JAM_OK);
  assert_int_equal(jam_decompress(sys, &o, &d), JAM_CANCELLED);
  assert_true(d.stop_reason == JAM_STOP_CANCELLED && d.excess_contacts == 0 && d.isostatic == 0);
  o.max_evaluations = 1;
  assert_int_equal(jam_set_log(sys, NULL, JAM_LOG_NONE, NULL), JAM_OK);
  assert_int_equal(jam_set_positions(sys, view_of(unmoved, JAM_VIEW_POSITIONS), 240), JAM_OK);
  assert_int_equal(jam_decompress(sys, &o, &d), JAM_LIMIT);
  SAYS(jam_decompress_history(sys, JAM_SOFT_COLUMNS, NULL, 0, &(size_t){0}), JAM_E_STATE, "no minimum");
}

/* Without memory for the Hessian, forces balance without Newton's method, and no test for saddles takes them back. */
CASE(minima_without_memory_for_the_hessian) {
  for (int32_t minimiser = JAM_MINIMISER_NEWTON; minimiser <= JAM_MINIMISER_LBFGS; ++minimiser) {
    OWNED jam_system *sys = soft_start(400, 0.7, 3);
    jam_relax_report r = {.struct_size = sizeof r};
    DEFAULTS(relax, o);
    o.minimiser = minimiser, o.force_tolerance = 1e-8;
    assert_int_equal(jam_set_memory_limit(sys, 1.5e6), JAM_OK);
    assert_int_equal(jam_relax(sys, &o, &r), JAM_OK);
    assert_true(r.converged == 1 && r.force_residual < 1e-8 && r.excess_contacts > 0);
  }
}

/* No minimum to shear from: nothing is known of one. */
CASE(shears_without_a_first_minimum) {
  OWNED jam_system *sys = soft_start(60, 0.7, 1);
  jam_shear_report r = {.struct_size = sizeof r};
  const double end = 1e-3;
  DEFAULTS(shear, o);
  o.max_evaluations = 1;
  assert_int_equal(jam_shear(sys, &o, &end, 1, NULL, 0, &r), JAM_LIMIT);
  assert_true(r.strain == 0.0 && isnan(r.stress) && isnan(r.energy) && r.contacts == -1 && r.rattlers == -1);
  assert_true(fabs(r.packing_fraction - 0.7) < 1e-12);
  SAYS(jam_shear_history(sys, JAM_SHEAR_COLUMNS, NULL, 0, &(size_t){0}), JAM_E_STATE, "no minimum");
  o.max_evaluations = INT64_MAX;
  assert_int_equal(jam_shear(sys, &o, &end, 1, NULL, 0, &r), JAM_OK);
  assert_true(r.rigid == 1 && r.contacts > 0 && r.energy > 0.0);
}
