#include <algorithm>
#include <cmath>

#include "core/cell_change.hpp"
#include "core/pair_rule.hpp"
#include "crunch/approach/lp_step.hpp"
#include "crunch/phases.hpp"
#include "linalg/dot.hpp"

namespace jam::inside {
namespace {

// A free cell changes its shape too: a lattice of one sphere has nothing else that could leave its saddle. Lengths
// change by less than the share, and the volume stays.
void strain_at_random(Packing &p, Rng &rng, double share) {
  const size_t d = static_cast<size_t>(p.dim);
  std::vector<double> strain(d * d);
  const auto open = [&](size_t c) { return (p.container.closed() >> c & 1) == 0; };
  for (size_t a = 0; a < d; ++a)
    for (size_t b = a; b < d; ++b)
      if (open(a) && open(b)) strain[a * d + b] = (2.0 * rng.uniform() - 1.0) * share / static_cast<double>(d);
  PairList none;
  strain_at_fixed_volume(p, none, strain);
}

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
    // of spheres, or of the strain, which moves own images alone
    const double longest = std::max(step.longest, largest_entry(s.last.answer.strain));
    s.next.moved = longest;
    const bool converged = step.gain < t.closed_gap;
    if (converged && s.next.bound <= narrowest && longest < narrowest) break;
    s.next.bound = std::max(narrowest, std::min(converged ? t.narrower * s.next.bound : s.next.bound, 10.0 * longest));
  }
  return Phase::identify;
}

bool recompress(CrunchState &s) {
  const auto &parts = s.tuning.decompression;
  const size_t done = s.history.stage.decompressions;
  if (done >= parts.size() || !(parts[done] > 0.0)) return false;
  ++s.history.stage.decompressions;
  Packing &p = s.out.packing;
  s.monitor.log(JAM_LOG_INFO, "not shown to be jammed at phi %.12f: decompresses by %.0e of the diameters",
                packing_fraction(p), parts[done]);
  // Gaps open by this part of sigma_ij = (1 + Delta) (s_i + s_j) / 2, or of (s_i + s_j) / 2.
  const size_t d = static_cast<size_t>(p.dim);
  const double gap = parts[done] * std::min(1.0, 1.0 + p.non_additivity),
               room = s.tuning.displaced * gap / std::sqrt(static_cast<double>(d));
  Rng rng(p.seed, Stream::recompression, static_cast<uint64_t>(done) << 40);
  for (size_t k = 0; k < p.position.size(); ++k)
    p.position[k] += (2.0 * rng.uniform() - 1.0) * room * p.diameter[k / d];
  for (double &diameter : p.diameter) diameter *= 1.0 - parts[done];
  if (s.o.strain == JAM_STRAIN_FREE) strain_at_random(p, rng, (1.0 - 2.0 * s.tuning.displaced) * gap);
  wrap_positions(p);
  record_opening(s);
  s.history.stage.path_taken = false;
  s.last.active = ActiveSet();
  restart_lps(s, first_bound(p, s.o, s.tuning));
  return true;
}

}  // namespace jam::inside
