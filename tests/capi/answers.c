/* A status that is not JAM_OK comes with a sentence: in jam_last_error, and in the log. */
#include "steps.h"

static char logged[600];

static void keep_line(int32_t level, const char *line, void *user) {
  (void)user;
  if (level == JAM_LOG_WARNING) snprintf(logged, sizeof logged, "%s", line);
}

/* The last call had this status, says these words, and logged them. */
static void said(jam_status status, jam_status expected, const char *words) {
  assert_int_equal(status, expected);
  if (!strstr(jam_last_error(), words)) fail_msg("\"%s\" is not in \"%s\"", words, jam_last_error());
  assert_true(strncmp(logged, jam_last_error(), 390) == 0);
  logged[0] = 0;
}

static jam_system *start(int64_t n, double fraction, int32_t overlap) {
  DEFAULTS(create, o);
  o.dim = 2, o.n = n, o.packing_fraction = fraction, o.overlap = overlap, o.seed = 3;
  jam_system *sys = created(&o);
  assert_int_equal(jam_set_log(sys, keep_line, JAM_LOG_WARNING, NULL), JAM_OK);
  return sys;
}

/* Its forces balance by several states of self-stress, and it can shear. */
static jam_system *square(void) {
  jam_system *sys = square_lattice(6);
  assert_int_equal(jam_set_log(sys, keep_line, JAM_LOG_WARNING, NULL), JAM_OK);
  return sys;
}

CASE(stopped_calls_say_what_stopped_them) {
  OWNED jam_system *sys = start(60, 0.4, JAM_OVERLAP_REFUSE);
  DEFAULTS(run, run);
  run.wall_time = 1e-3, run.collisions_per_particle = 1e9;
  said(jam_run(sys, &run, NULL), JAM_LIMIT, "wall_time");
  DEFAULTS(crunch, crunch);
  crunch.max_lps = 1, crunch.method = JAM_CRUNCH_SEQUENTIAL_LP;
  said(jam_crunch(sys, &crunch, NULL), JAM_LIMIT, "max_lps");
  jam_set_progress(sys, stop_at_once, NULL);
  said(jam_crunch(sys, NULL, NULL), JAM_CANCELLED, "callback");
  said(jam_compress(sys, NULL, NULL), JAM_CANCELLED, "callback");
  DEFAULTS(monte_carlo, mc);
  mc.sweeps = 1000000;
  said(jam_monte_carlo(sys, &mc, NULL), JAM_CANCELLED, "callback");
}

CASE(verdicts_say_why) {
  OWNED jam_system *fluid = start(60, 0.4, JAM_OVERLAP_REFUSE), *lattice = square(),
                   *soft = start(60, 0.2, JAM_OVERLAP_ALLOW);
  size_t m;
  said(jam_rigidity(fluid, JAM_RIGIDITY_COLLECTIVE, NULL), JAM_NOT_JAMMED, "not collectively jammed");
  said(jam_rigidity(lattice, JAM_RIGIDITY_STRICT, NULL), JAM_NOT_JAMMED, "not strictly jammed");
  DEFAULTS(geometry, g);
  g.tolerance = 1e-8;
  said(jam_contacts_from_geometry(fluid, &g, NULL), JAM_NOT_JAMMED, "jam_contacts_by_distance");
  assert_true(jam_contacts_from_geometry(lattice, NULL, NULL) > 0);
  logged[0] = 0;
  said(jam_stress_states(lattice, NULL, 0, NULL, 0, NULL, &m), JAM_AMBIGUOUS, "states of self-stress");
  said(jam_relax(soft, NULL, NULL), JAM_NOT_JAMMED, "no overlaps are left");
}

/* The report that the handle keeps has the status of its call. */
CASE(reports_keep_their_status) {
  OWNED jam_system *sys = start(60, 0.4, JAM_OVERLAP_REFUSE), *lattice = square();
  SIZED(jam_crunch_report, r);
  DEFAULTS(crunch, o);
  o.max_lps = 1, o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  assert_int_equal(jam_crunch(sys, &o, NULL), JAM_LIMIT);
  assert_int_equal(jam_get_crunch_report(sys, &r), JAM_OK);
  assert_int_equal(r.status, JAM_LIMIT);
  assert_int_equal(jam_crunch(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_get_crunch_report(sys, &r), JAM_OK);
  assert_int_equal(r.status, JAM_OK);
  jam_status status = jam_contacts_from_geometry(lattice, NULL, NULL);
  assert_true(status > 0);
  assert_int_equal(jam_get_crunch_report(lattice, &r), JAM_OK);
  assert_int_equal(r.status, status);
}

/* A failing verb logs its text, too. */
CASE(failures_are_logged) {
  OWNED jam_system *sys = start(60, 0.4, JAM_OVERLAP_REFUSE);
  said(jam_relax(sys, NULL, NULL), JAM_E_STATE, "overlap");
}
