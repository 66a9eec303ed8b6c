// Rare ends of a crunch, forced through CrunchSeams: an interior point that fails, a path that gives up, a polish that
// refuses.
#include <algorithm>
#include <cmath>
#include <string>
#include "test.h"

#include "crunch_scenes.hpp"

using namespace jam;

namespace {

void same_bits(const CrunchResult &a, const CrunchResult &b) {
  assert_memory_equal(a.packing.position.data(), b.packing.position.data(), a.packing.position.size() * sizeof(double));
  assert_memory_equal(a.packing.diameter.data(), b.packing.diameter.data(), a.packing.diameter.size() * sizeof(double));
  assert_int_equal(a.contacts.size(), b.contacts.size());
  assert_memory_equal(a.contacts.force.data(), b.contacts.force.data(), a.contacts.force.size() * sizeof(double));
}

// On two threads a crunch repeats its bits too: they share the work in the same way each time.
void two_threads_repeat(void **) {
  const Packing p = start(1500, 3, 0.35, 4);
  jam_crunch_options o = default_crunch_options();
  o.threads = 2, o.max_lps = 3;
  const CrunchResult r = run(p, o);
  assert_true(r.report.factorisations > 10);
  same_bits(r, run(p, o));
}

// Every answer of the interior point is spoiled, each time in another way: Clp must finish the job alone, on the same
// jamming point that it finds as the chosen solver.
void clp_takes_over(void **) {
  const Packing p = start(40, 3, 0.3, 3);
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  int ipm = 0, clp = 0;
  CrunchSeams seams;
  seams.answer = [&](LpSolution &x, jam_lp_solver solver) {
    if (solver == JAM_LP_CLP) {
      ++clp;
      return;
    }
    if (ipm % 4 == 0) x.solved = false;
    if (ipm % 4 == 1) x.g += 1e-6;  // some pair would overlap
    if (ipm % 4 == 2)
      for (double &y : x.y) y *= 1.001;  // |sum y - 1|
    if (ipm % 4 == 3) x.g = std::nan("");
    ++ipm;
  };
  const CrunchResult r = run(p, o, &seams);
  assert_int_equal(r.status, JAM_OK);
  assert_int_equal(r.report.lp_solver, JAM_LP_CLP);
  assert_true(clp == r.report.lp_solves && ipm == 2 * clp);
  assert_true(r.report.jammed && r.report.max_overlap < 1e-12 && r.report.force_residual < 1e-12);
  o.lp_solver = JAM_LP_CLP;
  same_bits(r, run(p, o));
}

// Clp alone leads every start to a jammed packing: an answer that misses its tolerance by a little is no reason to give
// up.
void clp_alone(void **) {
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP, o.lp_solver = JAM_LP_CLP;
  for (int seed = 1; seed <= 12; ++seed) {
    const CrunchResult r = run(start(40, 3, 0.3, seed), o);
    assert_true(r.status == JAM_OK && r.report.jammed && r.report.lp_solver == JAM_LP_CLP &&
                r.report.max_overlap < 1e-12);
  }
}

// Both solvers fail after a few LPs: a status with the state after those, which holds no overlap, and no contacts.
void nobody_solves(void **) {
  const Packing p = start(40, 3, 0.3, 3);
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  int asked = 0;
  CrunchSeams seams;
  seams.answer = [&](LpSolution &x, jam_lp_solver) { x.solved = x.solved && ++asked <= 3; };
  const CrunchResult r = run(p, o, &seams);
  assert_int_equal(r.status, JAM_E_SOLVER);
  assert_true(!r.text.empty() && r.report.stop_reason == JAM_STOP_SOLVER && !r.report.jammed);
  assert_true(r.report.lp_solves >= 1 && r.contacts.size() == 0 && r.report.rattlers == 40);
  o.max_lps = static_cast<int32_t>(r.report.lp_solves);
  const CrunchResult limited = run(p, o);
  assert_int_equal(limited.status, JAM_LIMIT);
  assert_memory_equal(r.packing.position.data(), limited.packing.position.data(),
                      r.packing.position.size() * sizeof(double));
  assert_true(closest_pair(r.packing).gap > -1e-13);
}

// A path that ends undecided: the chain starts again at the same point and its answer is the chain's own; the history
// too.
void chain_takes_over(void **) {
  const Packing p = start(60, 3, 0.3, 4);
  jam_crunch_options o = default_crunch_options(), chain = o;
  CrunchSeams seams;
  seams.attempt = [](CrunchResult &r) { r.status = JAM_NOT_CONVERGED; };
  History history, expected;
  const CrunchResult r = run(p, o, &seams, &history);
  chain.method = JAM_CRUNCH_SEQUENTIAL_LP;
  const CrunchResult alone = run(p, chain, nullptr, &expected);
  assert_true(r.status == JAM_OK && r.report.jammed && r.report.method == JAM_CRUNCH_SEQUENTIAL_LP);
  assert_true(r.report.factorisations > alone.report.factorisations);  // the path's are counted too
  same_bits(r, alone);
  assert_int_equal(history.rows().size(), expected.rows().size());
  assert_true(history.rows().back()[JAM_HISTORY_PHI] == r.report.packing_fraction);
  assert_true(history.rows().front()[JAM_HISTORY_PHASE] == JAM_STEP_LP);
}

// Inside a crunch a refusal is followed by one more LP. When its network is refused too, its answer stays and the log
// says so; when that one passes, the result is as good as any.
void one_more_lp(void **) {
  const Packing p = start(60, 3, 0.3, 6);
  jam_crunch_options o = default_crunch_options(), bare = o;
  bare.polish = 0;
  const CrunchResult plain = run(p, bare);
  for (int refusals = 1; refusals <= 2; ++refusals) {
    int asked = 0;
    CrunchSeams seams;
    ContactNetwork given;
    seams.before_polish = [&](const Packing &, ContactNetwork &net) {
      if (++asked > 2)
        return;  // what follows belongs to the chain, which is tried when the path's answer is not jammed
      for (double &f : net.force) f = asked <= refusals ? -f : f;
      given = net;
    };
    std::string log;
    Monitor monitor;
    listen(monitor, log);
    CrunchResult first;
    seams.attempt = [&](CrunchResult &r) { first = r; };
    crunch(p, o, monitor, nullptr, &seams);
    assert_true(log.find("polish refused: a force turns negative; one more LP") != std::string::npos);
    assert_true((log.find("the LP's answer stays") != std::string::npos) == (refusals == 2));
    assert_true(asked >= 2 && first.report.lp_solves == plain.report.lp_solves + 1);
    assert_true(std::fabs(first.report.packing_fraction - plain.report.packing_fraction) < 1e-12 &&
                first.report.contacts == plain.report.contacts);
    assert_true(first.report.jammed == (refusals == 1));  // the certificate sees negative forces
    if (refusals == 1) assert_true(first.report.force_residual < 1e-14);
    if (refusals == 2)
      assert_memory_equal(first.contacts.force.data(), given.force.data(), given.size() * sizeof(double));
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(two_threads_repeat), cmocka_unit_test(clp_takes_over),
                              cmocka_unit_test(clp_alone),          cmocka_unit_test(nobody_solves),
                              cmocka_unit_test(chain_takes_over),   cmocka_unit_test(one_more_lp)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
