/* What a crunch does not depend on: another thread, the unit of length; and which calls it refuses. */
#include <math.h>
#include <pthread.h>

#include "systems.h"
#include "verdicts.h"

static jam_system *random_start(int64_t n, int64_t seed) {
  DEFAULTS(create, o);
  o.n = n, o.packing_fraction = 0.3, o.seed = seed;
  return created(&o);
}

/* A cancel with no call running stops the next verb, and only that one. */
CASE(a_cancel_stops_the_next_verb) {
  jam_system *sys = random_start(60, 5);
  assert_int_equal(jam_cancel(sys), JAM_OK);
  assert_int_equal(jam_set_progress(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_scale_diameters(sys, 0.99), JAM_OK);
  crunch(sys, NULL, JAM_CANCELLED);
  crunch(sys, NULL, JAM_OK);
  jam_destroy(sys);
}

CASE(bad_options_are_refused) {
  jam_system *sys = random_start(100, 5);
  DEFAULTS(crunch, o);
  o.max_lps = 0;
  crunch(sys, &o, JAM_E_ARGUMENT);
  assert_non_null(strstr(jam_last_error(), "max_lps is 0"));
  o.max_lps = 2, o.lp_solver = 9;
  crunch(sys, &o, JAM_E_ARGUMENT);
  o.lp_solver = 0, o.gain_tolerance = NAN;
  crunch(sys, &o, JAM_E_ARGUMENT);
  jam_destroy(sys);
}

static void *crunch_thread(void *user) {
  SIZED(jam_crunch_report, r);
  return (void *)(intptr_t)(jam_crunch((jam_system *)user, NULL, &r) == JAM_OK);
}

/* Two handles on two threads and one alone: the same bits. */
CASE(threads_and_determinism) {
  jam_system *sys[3];
  pthread_t thread[2];
  int k;
  void *ok;
  for (k = 0; k < 3; ++k) sys[k] = random_start(150, 8);
  for (k = 0; k < 2; ++k) pthread_create(&thread[k], NULL, crunch_thread, sys[k]);
  for (k = 0; k < 2; ++k) {
    pthread_join(thread[k], &ok);
    assert_true(ok != NULL);
  }
  assert_non_null(crunch_thread(sys[2]));
  for (k = 0; k < 2; ++k) same_view(sys[k], sys[2], JAM_VIEW_POSITIONS);
  for (k = 0; k < 3; ++k) jam_destroy(sys[k]);
}

/* Tolerances are in diameters: the same packing in a box a thousand times larger gives the same numbers. */
CASE(box_does_not_matter) {
  jam_system *small = random_start(100, 4), *large;
  jam_crunch_report a, b;
  const double *x, *s;
  double y[300], t[100];
  size_t k;
  x = view_of(small, JAM_VIEW_POSITIONS);
  for (k = 0; k < 300; ++k) y[k] = x[k] * 1024.0;
  s = view_of(small, JAM_VIEW_DIAMETERS);
  for (k = 0; k < 100; ++k) t[k] = s[k] * 1024.0;
  DEFAULTS(create, o);
  o.box = 1024.0;
  assert_int_equal(create_from(&o, y, 300, t, 100, &large), JAM_OK);
  a = crunch(small, NULL, JAM_OK);
  b = crunch(large, NULL, JAM_OK);
  assert_int_equal(a.contacts, b.contacts);
  assert_true(fabs(a.packing_fraction - b.packing_fraction) < 1e-12);
  jam_destroy(small);
  jam_destroy(large);
}
