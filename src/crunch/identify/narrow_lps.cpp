#include "crunch/identify/narrow_lps.hpp"

#include <algorithm>
#include <cmath>

#include "crunch/approach/lp_step.hpp"
#include "crunch/control.hpp"
#include "crunch/identify/end.hpp"

namespace jam::inside {

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
