// Narrow LPs, where the wide one leaves it open which contacts carry force. Doubles then cannot distinguish a weak
// force from a narrow gap: a force of 1e-7 across a gap of 1e-8 is below the tolerance of an LP, and near a saddle the
// slope of the density is smaller still. In units of a narrow bound both are plain. A simplex vertex is exact: rows in
// its basis are closed to rounding, however many close together. The next LP starts from the same basis; the bound
// follows the steps, which shrink as those of Newton's method do.
#include <algorithm>
#include <cmath>

#include "crunch/state.hpp"

namespace jam {
namespace {

// A basis for the simplex method from an interior point's answer: rows with force are tight, spheres with force free.
LpSolution basis_of(const CrunchState &s) {
  LpSolution out;
  const std::vector<char> on = force_carrying(s.lp, s.answer, 0.0);
  for (const char tight : on) out.basis_rows.push_back(tight ? basis_at_lower : basis_inside);
  for (const int32_t z : s.active.coordination)
    for (int c = 0; c < s.lp.dim; ++c) out.basis_columns.push_back(z > 0 ? basis_inside : basis_at_lower);
  out.basis_columns.insert(out.basis_columns.end(), static_cast<size_t>(s.lp.strains) + 1, basis_inside);
  return out;
}

}  // namespace

Phase exact_vertex(CrunchState &s) {
  const Tuning &t = s.tuning;
  const double unit = diameter_mean(s.out.packing);
  // polish cleared s.pairs
  PairList before = s.multipliers.pairs;
  LpSolution last = basis_of(s);
  s.exact = true;
  s.bound = std::min(s.bound, t.narrow_bound);
  for (int k = 0; k < t.max_narrow_lps; ++k) {
    const double reach = build_lp(s, t.reach_per_bound * s.bound * unit);
    last.basis_rows = carry_over(before, last.basis_rows, s.pairs);
    s.answer = solve_lp_clp(s.lp, clp_tolerance, &s.monitor, &last);
    if (s.hooks.answer) s.hooks.answer(s.answer, JAM_LP_CLP);
    if (s.interrupted()) break;
    if (!s.answer.solved) {
      s.monitor.log(JAM_LOG_WARNING, "narrow LP: no answer in %d pivots", s.answer.iterations);
      return judge(s);  // of the contacts that are there
    }
    ++s.out.report.lp_solves;
    s.out.report.lp_solver = JAM_LP_CLP;
    before = s.pairs, last = s.answer;
    const LpStep step = make_step(s, reach);
    if (s.show(JAM_PHASE_CRUNCH, step.gain, step.longest)) s.stop(JAM_STOP_CANCELLED, JAM_CANCELLED);
    if (s.out.report.stop_reason != JAM_STOP_NONE) break;
    double longest = step.longest;  // of spheres, or of the strain, which moves own images alone
    for (const double e : s.answer.strain) longest = std::max(longest, std::fabs(e));
    const bool converged = step.gain < t.closed_gap;
    if (converged && longest * longest < t.closed_gap && clp_tolerance * s.bound < t.closed_gap) break;
    s.bound = std::min(converged ? t.narrower * s.bound : s.bound, std::max(10.0 * longest, std::sqrt(t.closed_gap)));
  }
  return Phase::identify;
}

}  // namespace jam
