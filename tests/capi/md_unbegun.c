/* A call that is stopped before its dynamics have begun can be resumed, to the bits of a call that was not stopped. */
#include <math.h>
#include "steps.h"

/* How a stopped call is continued: on the handle, on a copy, from a checkpoint. */
enum { HERE, COPY, FILE_, WAYS };
static jam_system *move(jam_system *sys, int way) {
  if (way == HERE) return sys;
  jam_system *next = way == COPY ? copy_of(sys) : from_checkpoint(sys);
  jam_destroy(sys);
  return next;
}

/* Stops a call with this verb twice before it has begun, then lets it end. */
static jam_status md(jam_system *sys, int verb, int32_t resume, double wall_time, int32_t *reason) {
  jam_md_report r;
  jam_monte_carlo_report mc;
  jam_status status;
  r.struct_size = sizeof r, mc.struct_size = sizeof mc;
  DEFAULTS(run, run);
  DEFAULTS(compress, compress);
  DEFAULTS(monte_carlo, carlo);
  run.collisions_per_particle = 3.0, run.resume = resume, run.wall_time = wall_time;
  compress.pressure = 20.0, compress.growth_rate = 0.1, compress.resume = resume, compress.wall_time = wall_time;
  carlo.sweeps = 20, carlo.resume = resume, carlo.wall_time = wall_time;
  if (verb == JAM_PHASE_RUN)
    status = jam_run(sys, &run, &r);
  else if (verb == JAM_PHASE_COMPRESS)
    status = jam_compress(sys, &compress, &r);
  else
    status = jam_monte_carlo(sys, &carlo, &mc), r.stop_reason = mc.stop_reason;
  if (reason) *reason = r.stop_reason;
  return status;
}

CASE(a_call_that_has_not_begun_is_resumed) {
  const int32_t verbs[] = {JAM_PHASE_RUN, JAM_PHASE_COMPRESS, JAM_PHASE_MONTE_CARLO};
  for (size_t v = 0; v < 3; ++v) {
    OWNED jam_system *whole = random_spheres(3, 2000, 0.0, 5);
    assert_int_equal(md(whole, verbs[v], 0, INFINITY, NULL), JAM_OK);
    for (int way = 0; way < WAYS; ++way)
      for (int cut = 0; cut < 2; ++cut) { /* by wall_time, by a cancel that came before */
        OWNED jam_system *sys = random_spheres(3, 2000, 0.0, 5);
        const int32_t why = cut ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME;
        int32_t reason = 0;
        for (int k = 0; k < 2; ++k) {
          if (cut) jam_cancel(sys);
          assert_int_equal(md(sys, verbs[v], k, cut ? INFINITY : 1e-9, &reason), cut ? JAM_CANCELLED : JAM_LIMIT);
          assert_int_equal(reason, why);
          assert_true(strlen(jam_last_error()) > 0);
          assert_int_equal(info_of(sys).paused, verbs[v]);
          sys = move(sys, way);
          assert_int_equal(info_of(sys).paused, verbs[v]);
        }
        assert_int_equal(md(sys, verbs[v], 1, INFINITY, NULL), JAM_OK);
        same(sys, whole);
      }
  }
}

/* Each call makes one sweep of the tuning at least: calls without any time come to the bits of one that has all of it.
 */
CASE(a_tuning_is_resumed) {
  OWNED jam_system *whole = random_spheres(3, 200, 0.0, 5), *sys = random_spheres(3, 200, 0.0, 5);
  int calls = 0;
  assert_int_equal(md(whole, JAM_PHASE_MONTE_CARLO, 0, INFINITY, NULL), JAM_OK);
  SIZED(jam_monte_carlo_report, r);
  DEFAULTS(monte_carlo, o);
  o.sweeps = 20, o.wall_time = 1e-9;
  do {
    o.resume = calls > 0;
    assert_int_equal(jam_monte_carlo(sys, &o, &r), JAM_LIMIT);
    if (calls % 100 == 50) sys = move(sys, FILE_);
    if (calls % 100 == 90) sys = move(sys, COPY);
  } while (!(r.step > 0.0) && ++calls < 1000);
  assert_true(calls > 100 && calls < 1000);
  assert_int_equal(md(sys, JAM_PHASE_MONTE_CARLO, 1, INFINITY, NULL), JAM_OK);
  same(sys, whole);
}

/* A run that continues has its own options: another one is refused by its name, and the run waits on. */
CASE(a_resumed_run_keeps_its_options) {
  OWNED jam_system *sys = random_spheres(3, 50, 0.0, 5);
  SIZED(jam_monte_carlo_report, r);
  DEFAULTS(monte_carlo, o);
  o.sweeps = 20, o.step = 0.1, o.wall_time = 1e-9;
  assert_int_equal(jam_monte_carlo(sys, &o, &r), JAM_LIMIT);
  for (int k = 0; k < 5; ++k) {
    static const char *const names[] = {"alpha", "step", "swap_share", "run", "first_sweep"};
    jam_monte_carlo_options_init(&o, sizeof o);
    o.resume = 1, o.sweeps = 20;
    if (k == 0) o.alpha = 2.0;
    if (k == 1) o.step = 0.2;
    if (k == 2) o.swap_share = 0.1;
    if (k == 3) o.run = 7;
    if (k == 4) o.first_sweep = 3;
    SAYS(jam_monte_carlo(sys, &o, &r), JAM_E_ARGUMENT, names[k]);
    assert_int_equal(info_of(sys).paused, JAM_PHASE_MONTE_CARLO);
  }
  jam_monte_carlo_options_init(&o, sizeof o);
  o.resume = 1, o.sweeps = 20, o.step = 0.1;
  assert_int_equal(jam_monte_carlo(sys, &o, &r), JAM_OK);
}

/* The same of runs from one configuration. */
CASE(a_tuning_of_runs_is_resumed) {
  jam_isoconf_report r[2];
  const double instants[] = {2.0, 5.0};
  OWNED jam_system *whole = random_spheres(3, 200, 0.0, 5), *sys = random_spheres(3, 200, 0.0, 5);
  jam_status status;
  int calls = 0;
  r[0].struct_size = r[1].struct_size = sizeof r[0];
  DEFAULTS(isoconf, o);
  DEFAULTS(monte_carlo, mc);
  o.runs = 3;
  assert_int_equal(jam_isoconf(whole, &o, &mc, instants, 2, NULL, 0, &r[0]), JAM_OK);
  o.wall_time = 1e-9;
  do {
    status = jam_isoconf(sys, &o, &mc, instants, 2, NULL, 0, &r[1]);
    if (calls % 100 == 50) sys = move(sys, FILE_);
    o.resume = 1;
  } while (status == JAM_LIMIT && !(r[1].step > 0.0) && ++calls < 1000);
  assert_true(calls > 100 && calls < 1000);
  o.wall_time = INFINITY;
  assert_int_equal(jam_isoconf(sys, &o, &mc, instants, 2, NULL, 0, &r[1]), JAM_OK);
  assert_true(r[0].step == r[1].step && r[1].runs == 3);
}

/* A call that has not begun leaves the results of a crunch: nothing has moved. */
CASE(results_stay_until_something_moves) {
  size_t pairs = 0;
  OWNED jam_system *sys = random_spheres(2, 30, 0.0, 5);
  SIZED(jam_crunch_report, r);
  assert_true(jam_crunch(sys, NULL, &r) >= 0);
  assert_int_equal(md(sys, JAM_PHASE_RUN, 0, 1e-9, NULL), JAM_LIMIT);
  assert_int_equal(jam_contacts(sys, NULL, 0, &pairs), JAM_OK);
  assert_true(pairs > 0);
}
