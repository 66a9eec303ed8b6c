// Rare ends of a crunch, forced through CrunchHooks: an interior point that fails, a path that gives up, a polish that
// refuses.
#include <algorithm>
#include <cmath>
#include <string>
#include "test.h"

#include "crunch_scenes.hpp"

using namespace jam::inside;

namespace {

void same_bits(const CrunchResult &a, const CrunchResult &b) {
  assert_memory_equal(a.packing.position.data(), b.packing.position.data(), a.packing.position.size() * sizeof(double));
  assert_memory_equal(a.packing.diameter.data(), b.packing.diameter.data(), a.packing.diameter.size() * sizeof(double));
  assert_int_equal(a.contacts.size(), b.contacts.size());
  assert_memory_equal(a.contacts.force.data(), b.contacts.force.data(), a.contacts.force.size() * sizeof(double));
}

// A crunch of 60 spheres and what it has to say.
struct Told {
  std::string log;
  Monitor monitor;
  CrunchResult of(const jam_crunch_options &o, const CrunchHooks *hooks, int level = JAM_LOG_WARNING) {
    listen(monitor, log, level);
    return crunch(start(60, 3, 0.3, 6), o, monitor, nullptr, hooks);
  }
  bool has(const std::string &words) const { return log.find(words) != std::string::npos; }
};

// With forces of the wrong sign a polish refuses its network.
void pull(ContactNetwork &net) {
  for (double &f : net.force) f = -f;
}

// Crunches on several threads have the same bits, however many they are: the work is cut in the same way each time.
CASE(threads_repeat) {
#ifdef JAM_SANITIZED  // the release build has repeated two threads
  const std::vector<int> again{8};
#else
  const std::vector<int> again{2, 8};
#endif
  for (const int32_t method : {JAM_CRUNCH_SEQUENTIAL_LP, JAM_CRUNCH_BARRIER_PATH}) {
    const Packing p = start(method == JAM_CRUNCH_SEQUENTIAL_LP ? 1500 : 400, 3, 0.35, 4);
    jam_crunch_options o = default_crunch_options();
    o.threads = 2, o.max_lps = 2, o.method = method;
    const CrunchResult r = run(p, o);
    assert_true(r.report.lp_solves > 0);
    for (const int threads : again) {
      o.threads = threads;
      same_bits(r, run(p, o));
    }
  }
}

// Every answer of the interior point is spoiled, each time in another way: Clp must finish the job alone, on the same
// jamming point that it finds as the chosen solver.
CASE(clp_takes_over) {
  const Packing p = start(40, 3, 0.3, 3);
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  int ipm = 0, clp = 0;
  CrunchHooks hooks;
  hooks.answer = [&](LpSolution &x, jam_lp_solver solver) {
    if (solver == JAM_LP_CLP) {
      ++clp;
      return;
    }
    if (ipm % 5 == 0) x.solved = false;
    if (ipm % 5 == 1) x.g += 1e-6;  // some pair would overlap
    if (ipm % 5 == 2)
      for (double &y : x.y) y *= 1.001;  // |sum y - 1|
    if (ipm % 5 == 3) x.g = std::nan("");
    if (ipm % 5 == 4) std::fill(x.s.begin(), x.s.end(), 0.0), x.g = -0.5;  // feasible, and all spheres shrink
    ++ipm;
  };
  const CrunchResult r = run(p, o, &hooks);
  assert_int_equal(r.status, JAM_OK);
  assert_int_equal(r.report.lp_solver, JAM_LP_CLP);
  assert_true(clp == r.report.lp_solves && ipm > 0 && ipm <= 2 * clp);  // Clp answers each LP
  assert_true(r.report.jammed && r.report.max_overlap < 1e-12 && r.report.force_residual < 1e-12);
  o.lp_solver = JAM_LP_CLP;
  same_bits(r, run(p, o));
}

// Both solvers fail after a few LPs: a status with the state after those, which holds no overlap, and no contacts.
CASE(nobody_solves) {
  const Packing p = start(40, 3, 0.3, 3);
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  int asked = 0;
  CrunchHooks hooks;
  hooks.answer = [&](LpSolution &x, jam_lp_solver) { x.solved = x.solved && ++asked <= 3; };
  const CrunchResult r = run(p, o, &hooks);
  assert_int_equal(r.status, JAM_E_SOLVER);
  assert_true(!r.text.empty() && r.report.stop_reason == JAM_STOP_SOLVER && !r.report.jammed);
  assert_true(r.report.lp_solves >= 1 && r.contacts.size() == 0 && r.report.rattlers == -1);
  o.max_lps = static_cast<int32_t>(r.report.lp_solves);
  const CrunchResult limited = run(p, o);
  assert_int_equal(limited.status, JAM_LIMIT);
  assert_memory_equal(r.packing.position.data(), limited.packing.position.data(),
                      r.packing.position.size() * sizeof(double));
  assert_true(closest_pair(r.packing).gap > -1e-13);
}

// Loose tolerances of the LPs are no reason to change the solver, nor to go round until max_lps. What a crunch cannot
// use is said.
CASE(loose_tolerances_keep_the_solver) {
  for (const int32_t method : {JAM_CRUNCH_BARRIER_PATH, JAM_CRUNCH_SEQUENTIAL_LP})
    for (const double tolerance : {1e-12, 1e-9, 1e-7, 1e-2}) {
      jam_crunch_options o = default_crunch_options();
      o.method = method, o.lp_tolerance = tolerance;
      Told told;
      const CrunchResult r = told.of(o, nullptr);
      assert_int_equal(r.status, JAM_OK);
      assert_int_equal(r.report.lp_solver, JAM_LP_IPM);
      assert_true(r.report.jammed && r.report.force_residual < 1e-12);
      assert_true(told.has("lp_tolerance is") == (tolerance > 1e-9));
    }
}

// A refusal of the polish is followed by narrow LPs, whose network is as good as any. The log says so.
CASE(refused_polish_takes_narrow_lps) {
  const jam_crunch_options o = default_crunch_options();
  const CrunchResult plain = run(start(60, 3, 0.3, 6), o);
  int64_t before = 0, answers = 0;
  bool refused = false;
  CrunchHooks hooks;
  hooks.before_polish = [&](const Packing &, ContactNetwork &net) {
    if (refused) return;
    refused = true, before = answers;
    pull(net);
  };
  hooks.answer = [&](LpSolution &, jam_lp_solver) { ++answers; };
  Told told;
  const CrunchResult r = told.of(o, &hooks);
  assert_true(told.has("polish refused: a force turns negative"));
  assert_true(refused && answers > before);
  assert_true(r.report.jammed && r.report.contacts == plain.report.contacts && r.report.force_residual < 1e-13);
  assert_true(std::fabs(r.report.packing_fraction - plain.report.packing_fraction) < 1e-12);
}

// Refused at a loose tolerance, wide LPs go on; the call is stopped in the next one. Positions have changed since the
// contacts were named, so there are none.
CASE(a_stop_behind_a_refused_polish_leaves_no_contacts) {
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP, o.gain_tolerance = 1e-2;
  bool refused = false;
  Monitor monitor;
  CrunchHooks hooks;
  hooks.before_polish = [&](const Packing &, ContactNetwork &net) {
    refused = true;
    pull(net);
  };
  hooks.answer = [&](LpSolution &, jam_lp_solver) {
    if (refused) monitor.cancel();
  };
  monitor.begin();
  const CrunchResult r = crunch(start(60, 3, 0.3, 6), o, monitor, nullptr, &hooks);
  assert_true(refused);
  assert_int_equal(r.status, JAM_CANCELLED);
  assert_true(r.contacts.size() == 0 && r.report.contacts == -1 && r.report.rattlers == -1 && !r.report.stationary);
  assert_true(std::isnan(r.report.max_contact_gap));
}

// A network that is refused every time: the LP's contacts stay, and the test of them gives verdict and forces.
CASE(refused_polish_ends) {
  CrunchHooks hooks;
  hooks.before_polish = [](const Packing &, ContactNetwork &net) { pull(net); };
  Told told;
  const CrunchResult r = told.of(default_crunch_options(), &hooks);
  assert_true(told.has("polish refused"));
  assert_true(r.report.jammed && r.report.min_force > 0.0 && r.report.force_residual < 1e-9);
  assert_true(r.report.max_overlap < 1e-12 && r.report.max_contact_gap < 1e-10);
}

// Narrow LPs without any answer: the contacts that are there are tested, and no other solver begins from half an LP.
CASE(unanswered_narrow_lps_end) {
  const Packing p = start(60, 3, 0.3, 6);
  CrunchHooks hooks;
  bool narrow = false;
  bool asked[2] = {false, false};  // the interior point, Clp
  hooks.before_polish = [&](const Packing &, ContactNetwork &net) {
    narrow = true;
    pull(net);
  };
  hooks.answer = [&](LpSolution &x, jam_lp_solver solver) {
    if (narrow) x.solved = false, asked[solver == JAM_LP_CLP] = true;
  };
  const CrunchResult r = run(p, default_crunch_options(), &hooks);
  assert_true(asked[0] && asked[1] == clp_is_built());
  assert_true(r.report.jammed && r.report.min_force > 0.0 && r.report.force_residual < 1e-9);
}

// A crunch to a duality gap whose path goes on, and whose log says why.
jam_crunch_report goes_on(const jam_crunch_options &o, const CrunchHooks &hooks, const char *why) {
  Told told;
  const CrunchResult r = told.of(o, &hooks, JAM_LOG_INFO);
  assert_true(told.has("finite gap: " + std::string(why) + ", the path goes on"));
  assert_true(r.status == JAM_OK && r.report.max_overlap < 1e-12 && r.report.force_residual < 1e-13);
  return r.report;
}

// Forces that do not balance at a duality gap: the path goes on. Here the LP at the gap has no
// answer once, and the crunch ends at a smaller gap; then no residual is small enough, and it ends jammed.
CASE(forces_that_do_not_balance_at_a_gap) {
  jam_crunch_options o = default_crunch_options();
  o.duality_gap = 1e-6;
  const CrunchResult whole = run(start(60, 3, 0.3, 6), o);
  assert_int_equal(whole.report.stop_reason, JAM_STOP_DUALITY_GAP);
  CrunchHooks spoiled, strict;
  int64_t asked = 0;
  spoiled.answer = [&](LpSolution &x, jam_lp_solver) { x.solved = ++asked != whole.report.lp_solves; };
  strict.tuning.balanced = 0.0;
  const char *why = "forces do not balance";
  const jam_crunch_report smaller = goes_on(o, spoiled, why), jammed = goes_on(o, strict, why);
  assert_int_equal(smaller.stop_reason, JAM_STOP_DUALITY_GAP);
  assert_true(smaller.duality_gap < 0.5 * whole.report.duality_gap);
  assert_int_equal(jammed.stop_reason, JAM_STOP_CONVERGED);
  assert_true(jammed.jammed && jammed.undecided_contacts == 0);
}

// A path that ends at a hundred times the gap asked for: the balanced forces tell that, and the path goes on.
CASE(gaps_larger_than_asked_for) {
  jam_crunch_options o = default_crunch_options();
  o.duality_gap = 1e-6;
  CrunchHooks hooks;
  hooks.tuning.lp_to_path_gap = 0.01;
  const jam_crunch_report r = goes_on(o, hooks, "larger than asked for");
  assert_int_equal(r.stop_reason, JAM_STOP_DUALITY_GAP);
  assert_true(r.duality_gap > 0.0 && r.duality_gap <= o.duality_gap);
}

// Cancelled, or out of time, while the LP at the gap names contacts: that is no failure of the forces, and no contacts
// are left.
CASE(interrupted_at_a_gap) {
  jam_crunch_options o = default_crunch_options();
  o.duality_gap = 1e-6;
  const CrunchResult whole = run(start(60, 3, 0.3, 6), o);
  for (const bool cancelled : {true, false}) {
    Told told;
    CrunchHooks hooks;
    int64_t asked = 0;
    hooks.answer = [&](LpSolution &, jam_lp_solver) {
      if (++asked != whole.report.lp_solves) return;
      if (cancelled)
        told.monitor.cancel();
      else
        told.monitor.wall_time = 1e-9;
    };
    const CrunchResult r = told.of(o, &hooks, JAM_LOG_INFO);
    assert_int_equal(r.status, cancelled ? JAM_CANCELLED : JAM_LIMIT);
    assert_int_equal(r.report.stop_reason, cancelled ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME);
    assert_true(r.contacts.size() == 0 && r.report.rattlers == -1 && !r.report.stationary);
    assert_true(!told.has("do not balance"));
    assert_memory_equal(r.packing.position.data(), whole.packing.position.data(),
                        whole.packing.position.size() * sizeof(double));
  }
}

}  // namespace
