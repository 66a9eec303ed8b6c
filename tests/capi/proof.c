/* Calls of proofs: arguments, statuses, texts, and what a proof of two sizes of disks says. */
#include <math.h>
#include <stdio.h>

#include "steps.h"

enum { n = 64 };
static double sizes[n];

static jam_system *jammed(void) {
  DEFAULTS(create, o);
  o.n = n, o.dim = 2, o.seed = 1, o.packing_fraction = 0.3;
  for (int i = 0; i < n; ++i) sizes[i] = i % 2 ? 1.4 : 1.0;
  jam_system *sys = created_from(&o, NULL, 0, sizes, n);
  assert_int_equal(jam_compress(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_crunch(sys, NULL, NULL), JAM_OK);
  return sys;
}

CASE(bad_arguments_are_refused) {
  static const char file[] = "no_stable.jamproof";
  jam_proof_report r = {.struct_size = sizeof r};
  double low[2 * n], ratio[n];
  size_t needed = 0;
  OWNED jam_system *sys = random_spheres(3, 20, 0.0, 1);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, NULL, 0, &r), JAM_E_STATE);
  assert_int_equal(jam_refined_positions(sys, NULL, 0, NULL, 0, NULL, 0, &needed), JAM_E_STATE);
  remove(file);
  assert_int_equal(jam_contacts_from_geometry(sys, NULL, NULL), JAM_NOT_JAMMED); /* a network without contacts */
  SAYS(jam_write_proof(sys, file, JAM_RIGIDITY_COLLECTIVE, NULL, 0), JAM_E_STATE, "no sphere is stable");
  assert_null(fopen(file, "r"));
  jam_destroy(sys);
  DEFAULTS(create, o);
  o.n = 20, o.container = JAM_CONTAINER_BALL;
  sys = created(&o); /* no stable sphere whose rotation could be fixed */
  assert_int_equal(jam_contacts_from_geometry(sys, NULL, NULL), JAM_NOT_JAMMED);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, NULL, 0, &r), JAM_AMBIGUOUS);
  SAYS(jam_write_proof(sys, file, JAM_RIGIDITY_COLLECTIVE, NULL, 0), JAM_E_STATE, "no sphere is stable");
  jam_destroy(sys);
  sys = jammed();
  memcpy(ratio, sizes, sizeof ratio);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, ratio, n - 1, &r), JAM_E_ARGUMENT);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, NULL, n, &r), JAM_E_NULL);
  ratio[5] = 1.4 * (1.0 + 1e-6); /* not the packing's ratios */
  SAYS(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, ratio, n, &r), JAM_E_ARGUMENT, "ratio[5]");
  SAYS(jam_refined_positions(sys, ratio, n, NULL, 0, NULL, 0, &needed), JAM_E_ARGUMENT, "ratio[5]");
  assert_int_equal(jam_refined_positions(sys, NULL, 0, NULL, 0, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, 2 * n);
  ratio[5] = NAN;
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, ratio, n, &r), JAM_E_NONFINITE);
  ratio[5] = -1.4;
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, ratio, n, &r), JAM_E_ARGUMENT);
  assert_int_equal(jam_prove(sys, 2, NULL, 0, &r), JAM_E_ARGUMENT);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_STRICT, sizes, n, &r), JAM_E_ARGUMENT); /* diameters as they are */
  assert_int_equal(jam_write_proof(sys, NULL, JAM_RIGIDITY_COLLECTIVE, NULL, 0), JAM_E_NULL);
  assert_int_equal(jam_write_proof(sys, "/no/such/folder/x", JAM_RIGIDITY_COLLECTIVE, NULL, 0), JAM_E_IO);
  assert_int_equal(jam_refined_positions(sys, NULL, 0, NULL, 0, NULL, 0, NULL), JAM_E_NULL);
  assert_int_equal(jam_refined_positions(sys, NULL, 0, NULL, 0, low, 2 * n - 1, &needed), JAM_E_BUFFER);
}

/* The exact ratio 1.4 of the user is no double, so that the proof speaks of the double nearest to it; centres move by
   less than the radius that the diameters after the crunch would need. */
CASE(a_packing_of_two_sizes_is_proved) {
  OWNED jam_system *sys = jammed(), *copy = NULL;
  jam_proof_report r = {.struct_size = sizeof r}, plain = {.struct_size = sizeof plain};
  double high[2 * n], low[2 * n], kept[2 * n];
  const double *before = view_of(sys, JAM_VIEW_POSITIONS);
  memcpy(kept, before, sizeof kept);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, sizes, n, &r), JAM_OK);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, NULL, 0, &plain), JAM_OK);
  assert_int_equal(r.theorem, JAM_THEOREM_EXACT);
  assert_int_equal(r.cause, JAM_CAUSE_NONE);
  assert_int_equal(r.contacts, 2 * (r.stable - 1) + 1);
  assert_true(r.radius > 0.0 && r.radius < 1e-28); /* two doubles hold 32 digits */
  assert_true(r.fraction_error > 0.0 && r.fraction_error < 1e-27);
  assert_true(r.least_force > r.force_error && r.force_error > 0.0);
  assert_true(r.inner == r.radius && r.outer > 1e-10); /* about the exact packing itself nothing moves */
  assert_true(fabs(r.packing_fraction - plain.packing_fraction) < 1e-12);
  assert_int_equal(jam_refined_positions(sys, sizes, n, high, 2 * n, low, 2 * n, NULL), JAM_OK);
  const double *x = view_of(sys, JAM_VIEW_POSITIONS);
  assert_memory_equal(x, kept, sizeof kept); /* const: nothing moved */
  for (int i = 0; i < 2 * n; ++i) {
    assert_true(fabs(high[i] - x[i]) < 1e-12);
    assert_true(fabs(low[i]) <= 1.2e-16 * fmax(fabs(high[i]), 1e-3));
  }
  assert_int_equal(jam_copy(sys, &copy), JAM_OK);
}

/* Crunch and check take the option, and their reports agree with jam_prove. */
CASE(crunch_and_check_prove_when_asked) {
  OWNED jam_system *sys = jammed();
  jam_proof_report proof = {.struct_size = sizeof proof};
  jam_crunch_report crunched = {.struct_size = sizeof crunched};
  jam_check_report checked = {.struct_size = sizeof checked};
  assert_int_equal(jam_get_crunch_report(sys, &crunched), JAM_OK);
  assert_int_equal(crunched.theorem, JAM_THEOREM_NONE);
  assert_true(isinf(crunched.proof_radius));
  DEFAULTS(crunch, crunch);
  crunch.prove = 1;
  assert_int_equal(jam_crunch(sys, &crunch, &crunched), JAM_OK);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, NULL, 0, &proof), JAM_OK);
  assert_int_equal(crunched.theorem, JAM_THEOREM_EXACT);
  assert_true(crunched.proof_radius == proof.radius);
  DEFAULTS(check, check);
  assert_int_equal(jam_check_packing(sys, &check, &checked), JAM_OK);
  assert_int_equal(checked.theorem, JAM_THEOREM_NONE);
  assert_null(strstr(jam_check_text(&checked), "proved, radius"));
  check.prove = 1;
  assert_int_equal(jam_check_packing(sys, &check, &checked), JAM_OK);
  assert_int_equal(checked.theorem, JAM_THEOREM_EXACT);
  assert_true(checked.proof_radius < 1e-28);
  assert_non_null(strstr(jam_check_text(&checked), "proved, radius"));
}

CASE(the_text_of_a_proof_is_short) {
  assert_string_equal(jam_proof_text(JAM_THEOREM_EXACT, JAM_CAUSE_NONE, 4e-31, NAN, NAN), "proved, radius 4e-31");
  assert_string_equal(jam_proof_text(JAM_THEOREM_TRAPPED, JAM_CAUSE_EXCESS, 3e-28, 130.0, 129.0),
                      "trapped within 3e-28, excess 130, 129");
  assert_string_equal(jam_proof_text(JAM_THEOREM_NONE, JAM_CAUSE_FORCE, NAN, 1e-12, 3e-11),
                      "not proved, force 1e-12, 3e-11");
  assert_string_equal(jam_proof_text(7, 0, 0.0, 0.0, 0.0), "");
  assert_string_equal(jam_proof_text(JAM_THEOREM_NONE, JAM_CAUSE_SADDLE, NAN, 2.5e-11, 4e-13),
                      "not proved, saddle 2.5e-11, 4e-13");
  assert_string_equal(jam_proof_text(0, 8, 0.0, 0.0, 0.0), "");
}

/* Few spheres with contacts that lie a diameter apart: a step of Newton's method has no bound there, and no pair is so
   near that an LP may close it. Nothing is proved, and that is the answer. */
CASE(contacts_that_are_wide_open_prove_nothing) {
  static const struct {
    int32_t container, n;
    uint64_t seed;
    double fraction;
  } scenes[] = {{JAM_CONTAINER_BRICK, 4, 283498360, 0.11782852382484808},
                {JAM_CONTAINER_BRICK, 2, 233799658, 0.1946000370123504},
                {JAM_CONTAINER_CYLINDER, 4, 54816107, 0.14988370422450784},
                {JAM_CONTAINER_BALL, 5, 974180972, 0.18107074223966385}};
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; ++k) {
    jam_proof_report r = {.struct_size = sizeof r};
    DEFAULTS(create, o);
    DEFAULTS(geometry, wide);
    o.container = scenes[k].container, o.n = scenes[k].n, o.seed = scenes[k].seed;
    o.packing_fraction = scenes[k].fraction, wide.tolerance = 0.999999;
    OWNED jam_system *sys = created(&o);
    assert_true(jam_contacts_from_geometry(sys, &wide, NULL) >= 0);
    assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, NULL, 0, &r), JAM_AMBIGUOUS);
    assert_int_equal(r.theorem, JAM_THEOREM_NONE);
  }
}

/* Mari-Kurchan shifts are no cell vectors. */
CASE(shifted_pairs_are_refused_by_name) {
  jam_crunch_report r = {.struct_size = sizeof r};
  DEFAULTS(create, o);
  o.n = 40, o.model = JAM_MODEL_MK, o.packing_fraction = 0.2;
  OWNED jam_system *sys = created(&o);
  assert_true(jam_crunch(sys, NULL, &r) >= 0);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, NULL, 0, NULL), JAM_E_UNSUPPORTED);
  assert_int_equal(jam_prove(sys, JAM_RIGIDITY_STRICT, NULL, 0, NULL), JAM_E_UNSUPPORTED);
}
