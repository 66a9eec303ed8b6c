#include <algorithm>
#include <cmath>

#include "crunch/approach/lp_step.hpp"
#include "crunch/control.hpp"
#include "crunch/phases.hpp"

namespace jam::inside {
namespace {

// Along a flex that only the curvature of a round wall ends, a step reaches a small part of the growth of its LP.
// Newton's steps on contacts and forces may get there.
bool curved_and_slow(const CrunchState &s) {
  const int32_t reason = s.out.report.stop_reason;
  return s.out.packing.container.curved() != 0 && (reason == JAM_STOP_STALLED || reason == JAM_STOP_LP_LIMIT);
}

// Spheres that come no nearer may be jammed. A limit of the call says nothing about them.
Phase end_early(CrunchState &s) {
  return s.out.report.stop_reason == JAM_STOP_STALLED ? give_verdict(s, {}) : Phase::done;
}

}  // namespace

Phase identify(CrunchState &s) {
  if (frees_cell(s)) return free_cell(s);
  if (s.last.active.rows.empty()) {
    if (s.out.report.stop_reason == JAM_STOP_NONE && !s.found.narrow && s.o.polish) return Phase::narrow_lps;
    if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;
    return s.o.polish && recompress(s) ? Phase::approach : give_verdict(s, {});
  }
  s.out.contacts = make_contacts(s.out.packing, s.last.pairs, s.last.answer, s.last.active);
  const bool slow = curved_and_slow(s);
  if (s.out.report.stop_reason != JAM_STOP_NONE && !(slow && s.o.polish)) return end_early(s);
  if (s.o.polish && !polish_contacts(s)) return Phase::done;
  if (slow && !s.found.polished) return end_early(s);
  if (slow) stop(s, JAM_STOP_NONE, JAM_OK);
  if (s.o.polish && !s.found.polished && !converged(s)) {
    s.next.gain_tolerance = default_crunch_options().gain_tolerance;
    forget_contacts(s);
    return Phase::approach;
  }
  if (s.o.polish && !s.found.polished && !s.found.narrow) return Phase::narrow_lps;
  return decide_jamming(s);
}

Phase narrow_lps(CrunchState &s) {
  const Tuning &t = s.tuning;
  s.found.narrow = true;
  const double narrowest = std::sqrt(t.closed_gap);  // the motion whose square is rounding
  s.next.moved = 0.0;                                // they begin at an optimum: its forces are near theirs
  s.next.bound = std::min(s.next.bound, t.narrow_bound);
  for (int k = 0; k < t.max_narrow_lps; ++k) {
    const double reach = build_lp(s, t.reach_per_bound * s.next.bound * diameter_mean(s.out.packing));
    IpmControl control;
    control.tolerance = s.o.lp_tolerance * s.next.bound;
    control.ridge = 0.0;
    const LpAnswer answer = solve_lp(s, control);
    if (stop_if_interrupted(s)) break;
    if (answer != LpAnswer::kept) {
      s.monitor.log(JAM_LOG_WARNING, "narrow LP: no answer");
      return decide_jamming(s);  // of the contacts that are there
    }
    const LpStep step = make_step(s, reach);
    if (report_step(s, JAM_PHASE_CRUNCH, step.gain, step.longest)) stop(s, JAM_STOP_CANCELLED, JAM_CANCELLED);
    if (s.out.report.stop_reason != JAM_STOP_NONE) break;
    double longest = step.longest;  // of spheres, or of the strain, which moves own images alone
    for (const double e : s.last.answer.strain) longest = std::max(longest, std::fabs(e));
    s.next.moved = longest;
    const bool converged = step.gain < t.closed_gap;
    if (converged && s.next.bound <= narrowest && longest < narrowest) break;
    s.next.bound = std::max(narrowest, std::min(converged ? t.narrower * s.next.bound : s.next.bound, 10.0 * longest));
  }
  return Phase::identify;
}

}  // namespace jam::inside
