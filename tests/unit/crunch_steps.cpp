// No step may let two spheres meet that the neighbour list does not know: looked at over all pairs after every step.
#include <cmath>
#include "test.h"

#include "crunch/phases.hpp"
#include "crunch_scenes.hpp"
#include "lp/packing_lp.hpp"

using namespace jam::inside;

namespace {

// Two spheres without a common row run into each other: followed in part only, and by a half at least where that is
// safe.
CASE(unlisted_pair) {
  for (const double gap : {0.011, 0.02, 0.1, 0.15}) {
    Packing p;
    p.set_cube(2, 1.0);
    p.position = {0.4, 0.5, 0.5 + gap, 0.5};
    p.diameter = {0.1, 0.1};
    p.velocity.assign(4, 0.0);
    const double unit = 0.1, reach = 0.01;
    PairList pairs = find_pairs(p, reach, 1.0);
    assert_int_equal(pairs.size(), 0);
    LpSolution x;
    x.s = {0.6, 0.0, -0.6, 0.0};  // 0.12 nearer in all
    x.g = 0.02;                   // and a little larger
    const double alpha = take_step(p, pairs, reach, x, unit);
    assert_true(closest_pair(p).gap > -1e-13);
    const double longest = gap / (0.12 + 0.1 * (std::sqrt(1.02) - 1.0));
    assert_true(longest > 1.0 ? alpha == 1.0 : alpha > 0.45 * longest && alpha < 1.0);
    assert_true(std::fabs(p.diameter[0] - 0.1 * std::sqrt(1.0 + alpha * 0.02)) < 1e-15);
  }
}

struct Case {
  int n, dim;
  double phi, ratio;
};
const Case dilute[] = {{60, 2, 0.05, 1.0},  {60, 3, 0.02, 1.0}, {60, 3, 0.2, 1.0},   {50, 4, 0.01, 1.0},
                       {40, 5, 0.005, 1.0}, {60, 2, 0.1, 10.0}, {60, 3, 0.05, 10.0}, {5, 3, 0.05, 1.0}};

// The path bounds what all spheres travel between two lists; here every pair and image is looked at after each Newton
// step. From a dilute start, where jam_crunch lets LPs go first, it need not get far, but it must stay safe.
CASE(path_from_low_density) {
  for (const Case &c : dilute) {
    Packing p = start(c.n, c.dim, c.phi, 11, c.ratio);
    BarrierPathControl control;
    control.tuning.max_path_factorisations = 150;
    int steps = 0;
    double worst = 1.0;
    control.on_step = [&](double, size_t, const PathPoint &) {
      ++steps;
      worst = std::min(worst, closest_pair(p).gap);
    };
    NewtonSystem system;
    Monitor monitor;
    monitor.begin();
    follow_barrier_path(p, control, system, monitor);
    print_message("n %d d %d phi %g ratio %g: %d steps to phi %.3f, smallest gap %.1e\n", c.n, c.dim, c.phi, c.ratio,
                  steps, packing_fraction(p), worst);
    assert_true(steps > 5 && worst > -1e-13);
    if (c.phi >= 0.2) assert_true(packing_fraction(p) > 2.0 * c.phi);
  }
}

// Sequential LPs, stopped after each of its first LPs, which take the longest steps.
CASE(sequential_lp_from_low_density) {
  for (const Case &c : dilute) {
    const Packing p = start(c.n, c.dim, c.phi, 11, c.ratio);
    jam_crunch_options o = default_crunch_options();
    o.method = JAM_CRUNCH_SEQUENTIAL_LP;
    double phi = c.phi;
    for (o.max_lps = 1; o.max_lps <= 6; ++o.max_lps) {
      const CrunchResult r = run(p, o);
      assert_true(closest_pair(r.packing).gap > -1e-13);
      assert_true(packing_fraction(r.packing) >= phi * (1.0 - 1e-12));
      phi = packing_fraction(r.packing);
      if (r.status == JAM_E_SOLVER && !clp_is_built()) break;  // an LP that goes to Clp
      assert_true(r.status >= 0);
    }
    assert_true(phi > 1.5 * c.phi);
  }
}

// A bound far too wide for its neighbour radius: the user's options must not break the promise either.
CASE(careless_options) {
  const Packing p = start(60, 3, 0.1, 11);
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  o.neighbour_radius = 1.3, o.step_bound = 3.0;
  bool shortened = false;
  for (o.max_lps = 1; o.max_lps <= 8; ++o.max_lps) {
    History history;
    const CrunchResult r = run(p, o, nullptr, &history);
    assert_true(closest_pair(r.packing).gap > -1e-13);
    for (const HistoryRow &row : history.rows()) shortened = shortened || row[JAM_HISTORY_PART] < 1.0;
  }
  assert_true(shortened);
}

}  // namespace
