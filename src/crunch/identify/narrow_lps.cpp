#include "crunch/identify/narrow_lps.hpp"

#include <algorithm>
#include <cmath>

#include "crunch/approach/lp_step.hpp"
#include "crunch/control.hpp"
#include "crunch/identify/end.hpp"

namespace jam::inside {
namespace {

using Narrow = CrunchFindings::Narrow;

// A basis for the simplex method from an interior point's answer: rows with force are tight, spheres with force free.
LpSolution basis_of(const CrunchState &s) {
  LpSolution out;
  const std::vector<char> on = force_carrying(s.last.lp, s.last.answer, 0.0);
  for (const char tight : on) out.basis_rows.push_back(tight ? basis_at_lower : basis_inside);
  for (const int32_t z : s.last.active.coordination)
    for (int c = 0; c < s.last.lp.dim; ++c) out.basis_columns.push_back(z > 0 ? basis_inside : basis_at_lower);
  out.basis_columns.insert(out.basis_columns.end(), static_cast<size_t>(s.last.lp.strains) + 1, basis_inside);
  return out;
}

LpAnswer solve_by_interior_point(CrunchState &s) {
  IpmControl control;
  control.tolerance = s.o.lp_tolerance * s.next.bound;
  control.ridge = 0.0;
  return solve_lp(s, control);
}

// Each LP begins at the vertex of the one before.
LpAnswer solve_by_simplex(CrunchState &s, PairList &before, LpSolution &last) {
  last.basis_rows = carry_over(before, last.basis_rows, s.last.pairs);
  s.last.answer = solve_lp_clp(s.last.lp, clp_tolerance, &s.monitor, &last);
  if (s.hooks.answer) s.hooks.answer(s.last.answer, JAM_LP_CLP);
  if (s.monitor.interrupted()) return LpAnswer::interrupted;
  if (!s.last.answer.solved) return LpAnswer::refused;
  ++s.out.report.lp_solves;
  s.out.report.lp_solver = JAM_LP_CLP;
  before = s.last.pairs, last = s.last.answer;
  return LpAnswer::kept;
}

}  // namespace

bool narrow_lps_left(const CrunchState &s) {
  return s.found.narrow == Narrow::none || (s.found.narrow == Narrow::by_interior_point && clp_is_built());
}

Phase narrow_lps(CrunchState &s) {
  const Tuning &t = s.tuning;
  const bool simplex = s.found.narrow == Narrow::by_interior_point;
  s.found.narrow = simplex ? Narrow::by_simplex : Narrow::by_interior_point;
  PairList before = s.next.multipliers.pairs;  // polish cleared s.last.pairs
  LpSolution last = basis_of(s);
  // Down to the motion whose square is rounding, or to the bound at which rows are met to rounding.
  const double narrowest = std::sqrt(t.closed_gap), last_bound = simplex ? t.closed_gap / clp_tolerance : narrowest;
  s.next.moved = 0.0;  // they begin at an optimum: its forces are near theirs
  s.next.bound = simplex ? t.narrow_bound : std::min(s.next.bound, t.narrow_bound);
  for (int k = 0; k < t.max_narrow_lps; ++k) {
    const double reach = build_lp(s, t.reach_per_bound * s.next.bound * diameter_mean(s.out.packing));
    const LpAnswer answer = simplex ? solve_by_simplex(s, before, last) : solve_by_interior_point(s);
    if (stop_if_interrupted(s)) break;
    if (answer != LpAnswer::kept) {
      s.found.narrow = Narrow::by_simplex;  // Clp was asked too, and has no answer to begin from
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
    if (converged && s.next.bound <= last_bound && longest < narrowest) break;
    s.next.bound = std::max(narrowest, std::min(converged ? t.narrower * s.next.bound : s.next.bound, 10.0 * longest));
  }
  return Phase::identify;
}

}  // namespace jam::inside
