// Limits of a call: making a system can be watched, cancelled and timed; searches for pairs stop at the memory limit
// and when the call is cancelled or its time is over.
#include <jam/jam.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "failing_new.hpp"
#include "steps.h"

namespace {

jam_create_options options(int64_t n, double fraction) {
  DEFAULTS(create, o);
  o.n = n, o.packing_fraction = fraction;
  return o;
}

std::vector<double> positions(const jam_system *sys) {
  const double *const view = view_of(sys, JAM_VIEW_POSITIONS);
  return {view, view + info_of(sys).n * info_of(sys).dim};
}

struct Seen {
  int calls = 0, stop_at = 1 << 30;
  double fraction = -1.0;
  int64_t steps = -1;
};
int32_t watch(const jam_progress *p, void *user) {
  auto *seen = static_cast<Seen *>(user);
  assert_int_equal(p->phase, JAM_PHASE_CREATE);
  assert_true(p->packing_fraction >= seen->fraction && p->steps >= seen->steps);
  seen->fraction = p->packing_fraction, seen->steps = p->steps;
  return ++seen->calls >= seen->stop_at;
}

jam_start watched_by(Seen &seen) {
  jam_start start = start_at(nullptr, 0, nullptr, 0);
  start.progress = watch, start.user = &seen;
  return start;
}

// Near its limit a random start takes minutes.
CASE(slow_start_is_watched_and_stopped) {
  jam_create_options o = options(20000, 0.38);
  Seen seen;
  seen.stop_at = 3;
  const jam_start start = watched_by(seen);
  jam_system *sys = reinterpret_cast<jam_system *>(1);
  assert_int_equal(jam_create(&o, &start, &sys), JAM_CANCELLED);
  assert_null(sys);
  assert_int_equal(seen.calls, 3);
  assert_true(seen.fraction > 0.0 && seen.fraction < 0.38 && seen.steps > 0);

  o.wall_time = 0.1;
  sys = reinterpret_cast<jam_system *>(1);
  assert_int_equal(jam_create(&o, nullptr, &sys), JAM_LIMIT);
  assert_null(sys);
}

CASE(watching_changes_nothing) {
  const jam_create_options o = options(500, 0.25);
  Seen seen;
  const jam_start start = watched_by(seen);
  OWNED jam_system *plain = random_spheres(3, 500, 0.25, 1), *watched = nullptr;
  assert_int_equal(jam_create(&o, &start, &watched), JAM_OK);
  assert_true(positions(plain) == positions(watched));
}

// Above saturation no number of trials helps: told at once, and not for mixtures or few spheres, which pack otherwise.
CASE(fractions_out_of_reach) {
  for (int dim = 2; dim <= 8; ++dim) {
    static const double saturation[] = {0.547, 0.384, 0.26, 0.171, 0.109, 0.0684, 0.0423};
    jam_create_options o = options(20000, 1.02 * saturation[dim - 2]);
    o.dim = dim;
    jam_system *sys = nullptr;
    SAYS(jam_create(&o, nullptr, &sys), JAM_E_UNPLACEABLE, "ends near");
  }
  jam_destroy(random_spheres(3, 1, 0.5, 1));  // 1.3 times saturation
}

CASE(memory_limit_of_a_call) {
  OWNED jam_system *sys = random_spheres(3, 2000, 0.2, 1);
  size_t rows = 0;
  assert_int_equal(jam_gaps(sys, 1.0, 0, nullptr, 0, nullptr, 0, &rows), JAM_OK);
  assert_true(rows > 0);
  assert_int_equal(jam_set_memory_limit(sys, 1e5), JAM_OK);
  SAYS(jam_gaps(sys, 1.0, 0, nullptr, 0, nullptr, 0, &rows), JAM_E_MEMORY, "pairs");
  OWNED jam_system *copy = copy_of(sys);
  assert_int_equal(jam_gaps(copy, 1.0, 0, nullptr, 0, nullptr, 0, &rows), JAM_E_MEMORY);
  assert_int_equal(jam_crunch(sys, nullptr, nullptr), JAM_E_MEMORY);
  assert_int_equal(jam_set_memory_limit(sys, 0.0), JAM_E_ARGUMENT);
  assert_int_equal(jam_set_memory_limit(sys, NAN), JAM_E_ARGUMENT);
  assert_int_equal(jam_set_memory_limit(nullptr, 1.0), JAM_E_NULL);
  assert_int_equal(jam_set_memory_limit(sys, INFINITY), JAM_OK);
  assert_int_equal(jam_gaps(sys, 1.0, 0, nullptr, 0, nullptr, 0, &rows), JAM_OK);
  jam_destroy(sys);

  jam_create_options o = options(2000, 0.2);
  o.memory_limit = 1e5;
  sys = nullptr;
  assert_int_equal(jam_create(&o, nullptr, &sys), JAM_OK);
  assert_int_equal(jam_gaps(sys, 1.0, 0, nullptr, 0, nullptr, 0, &rows), JAM_E_MEMORY);
}

// A crunch whose estimate exceeds the limit twice does not begin; below that each matrix decides before it is
// factorised. What fits runs.
CASE(memory_limit_of_factors) {
  OWNED jam_system *sys = random_spheres(3, 6000, 0.3, 1);
  const std::vector<double> before = positions(sys);
  SIZED(jam_estimate_report, e);
  assert_int_equal(jam_estimate_crunch(sys, nullptr, &e), JAM_OK);
  DEFAULTS(crunch, o);
  SIZED(jam_crunch_report, r);
  assert_int_equal(jam_set_memory_limit(sys, 0.4 * e.bytes), JAM_OK);
  largest = 0;
  SAYS(jam_crunch(sys, &o, &r), JAM_E_MEMORY, "need");
  assert_true(static_cast<double>(largest) < 0.25 * e.bytes);
  assert_true(positions(sys) == before);
  assert_int_equal(jam_get_crunch_report(sys, &r), JAM_E_STATE);
  o.wall_time = 1.0;  // what follows may begin; the refusal above must come however slow the processor is
  assert_int_equal(jam_set_memory_limit(sys, 0.6 * e.bytes), JAM_OK);
  const jam_status between = jam_crunch(sys, &o, &r);
  assert_true(between == JAM_LIMIT || between == JAM_E_MEMORY);
  assert_true(static_cast<double>(largest) < 0.6 * e.bytes);
  assert_int_equal(jam_set_memory_limit(sys, 1.1 * e.bytes), JAM_OK);
  assert_int_equal(jam_crunch(sys, &o, &r), JAM_LIMIT);
  jam_destroy(sys);

  sys = random_spheres(3, 400, 0.3, 1);  // the rigidity test, and modes of its network
  assert_int_equal(jam_crunch(sys, nullptr, nullptr), JAM_OK);
  assert_int_equal(jam_set_memory_limit(sys, 1e5), JAM_OK);
  SIZED(jam_moduli_report, moduli);
  SAYS(jam_moduli(sys, nullptr, &moduli), JAM_E_MEMORY, "factorised");
}

// One sphere that sees most of the pairs: the mean diameter does not announce them. Found by the soak test: 14 GB under
// a limit of 0.1.
CASE(memory_limit_of_one_sphere) {
  const double x[] = {0.5, 0.5, 0.5, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0, 0.0, 0.4, 0.0, 0.0};
  const double diameters[] = {0.8, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3};
  DEFAULTS(create, o);
  o.n = 6, o.memory_limit = 1e8;
  OWNED jam_system *sys = created_from(&o, x, 18, diameters, 6);
  size_t rows = 0;
  largest = 0;
  SAYS(jam_gaps(sys, 100.0, 0, nullptr, 0, nullptr, 0, &rows), JAM_E_MEMORY, "pairs");
  assert_true(largest < 100000000);
}

// A search for many pairs inside a crunch: its time ends it, and the packing is kept.
CASE(crunch_of_many_pairs) {
  OWNED jam_system *sys = random_spheres(3, 3000, 0.2, 1);
  DEFAULTS(crunch, o);
  o.neighbour_radius = 9.0, o.wall_time = 0.2;
  assert_int_equal(jam_set_memory_limit(sys, INFINITY), JAM_OK);
  assert_int_equal(jam_crunch(sys, &o, nullptr), JAM_LIMIT);
  assert_int_equal(jam_run(sys, nullptr, nullptr), JAM_OK);
}

// Lists of all pairs of 12000 spheres take a second. The callback, and the limit of time, end them before the first
// event; the packing is as before.
CASE(lists_of_verbs_are_left) {
  jam_create_options o = options(12000, 0.1);
  o.dim = 8, o.overlap = JAM_OVERLAP_ALLOW;  // in so few diameters a side, every search takes all pairs
  OWNED jam_system *sys = created(&o);
  const std::vector<double> before = positions(sys);
  for (const bool by_callback : {true, false}) {
    jam_set_progress(sys, by_callback ? stop_at_once : nullptr, nullptr);
    DEFAULTS(relax, soft);
    if (!by_callback) soft.wall_time = 0.02;
    SIZED(jam_relax_report, r);
    assert_int_equal(jam_relax(sys, &soft, &r), by_callback ? JAM_CANCELLED : JAM_LIMIT);
    assert_int_equal(r.stop_reason, by_callback ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME);
    assert_int_equal(r.evaluations, 0);
    assert_true(positions(sys) == before);
  }
  jam_destroy(sys);

  // Outer lists of the Mari-Kurchan model.
  jam_create_options quenched = options(9000, 0.01);
  quenched.model = JAM_MODEL_MK;
  assert_int_equal(jam_create(&quenched, nullptr, &sys), JAM_OK);
  for (const bool by_callback : {true, false}) {
    jam_set_progress(sys, by_callback ? stop_at_once : nullptr, nullptr);
    DEFAULTS(run, run);
    if (!by_callback) run.wall_time = 0.02;
    SIZED(jam_md_report, r);
    assert_int_equal(jam_run(sys, &run, &r), by_callback ? JAM_CANCELLED : JAM_LIMIT);
    assert_int_equal(r.stop_reason, by_callback ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME);
    assert_true(r.events == 0 && r.seconds == 0.0);  // it never began
  }
}

CASE(lists_of_verbs_keep_to_the_memory) {
  OWNED jam_system *sys = random_spheres(3, 3000, 0.3, 1);
  const std::vector<double> before = positions(sys);
  assert_int_equal(jam_set_memory_limit(sys, 1e4), JAM_OK);
  DEFAULTS(run, run);
  DEFAULTS(monte_carlo, sweeps);
  sweeps.step = 0.01;
  for (const bool monte_carlo : {true, false}) {
    SAYS(monte_carlo ? jam_monte_carlo(sys, &sweeps, nullptr) : jam_run(sys, &run, nullptr), JAM_E_MEMORY,
         "neighbour lists");
    assert_true(positions(sys) == before);
  }
  assert_int_equal(jam_set_memory_limit(sys, 1e9), JAM_OK);
  run.collisions_per_particle = 1.0;
  assert_int_equal(jam_run(sys, &run, nullptr), JAM_OK);
}

}  // namespace
