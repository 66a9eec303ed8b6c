// Leaving a saddle: forces balance, but a flex opens contacts. The spheres move along it until pairs block.
#include <algorithm>
#include <cmath>

#include "core/pair_rule.hpp"
#include "crunch/state.hpp"

namespace jam {
namespace {

// The flex or, where nothing is decided, what may be one; or its opposite: where the forces leave a rest, the spheres
// go where it pushes them.
std::vector<double> direction_of(const CrunchState &s, const PackingVerdict &verdict) {
  const size_t d = s.out.packing.dim;
  std::vector<double> v(s.out.packing.position.size(), 0.0);
  const std::vector<double> &motion = verdict.result.flex.empty() ? verdict.result.attempt : verdict.result.flex;
  for (size_t q = 0; q < verdict.sphere.size(); ++q)
    for (size_t c = 0; c < d; ++c) v[verdict.sphere[q] * d + c] = motion[q * d + c];
  const ContactNetwork &net = verdict.contacts;
  double push = 0.0;
  for (size_t k = 0; k < net.size(); ++k)
    for (size_t c = 0; c < d; ++c)
      push += net.force[k] * net.vector[k * d + c] * (v[net.pairs.i[k] * d + c] - v[net.pairs.j[k] * d + c]);
  if (push < 0.0)
    for (double &x : v) x = -x;
  return v;
}

}  // namespace

// A vertex of an LP along the flex, with all near pairs as rows: every flex ends at a pair or at the bound.
Kick leave_saddle(CrunchState &s, const PackingVerdict &verdict) {
  // An attempt is made once narrow LPs have left it open.
  const RigidityResult &r = verdict.result;
  if ((r.flex.empty() && (r.attempt.empty() || !s.exact)) || s.kicks >= s.tuning.max_kicks) return Kick::none;
  ++s.kicks;
  Packing &p = s.out.packing;
  const size_t d = p.dim;
  const double unit = diameter_mean(p);
  const std::vector<double> v = direction_of(s, verdict);
  int32_t fixed = verdict.sphere.front();
  double longest = 0.0, bound = s.tuning.kick;
  // Rows hold to a tolerance times the bound: where pairs block early, it narrows.
  for (bool again = true; again;) {
    PairList pairs = find_pairs(p, 2.0 * std::sqrt(static_cast<double>(d)) * bound * unit, 1.0);
    PackingLp lp = make_lp(p, pairs, unit);
    lp.bound = bound;
    for (double &c : lp.c) c = std::max(c, 0.0);  // closed ones overlap by rounding
    LpSolution x = solve_motion_clp(lp, v, fixed, &s.monitor);
    if (!x.solved || s.monitor.interrupted()) return Kick::none;
    longest = 0.0;
    for (const int32_t i : verdict.sphere)
      for (size_t c = 0; c < d; ++c) longest = std::max(longest, std::fabs(x.s[i * d + c]));
    again = longest < 0.01 * bound && longest > s.tuning.closed_gap;
    bound = 10.0 * longest;
    if (!again && longest > s.tuning.closed_gap) take_step(p, pairs, 0.0, x, unit);
  }
  s.monitor.log(JAM_LOG_INFO, "saddle at phi %.12f with %lld flexes: moves %.1e diameters along them",
                packing_fraction(p), static_cast<long long>(verdict.result.flexes), longest);
  if (!(longest > s.tuning.closed_gap)) return Kick::none;
  // Where no force balances at the end of narrow LPs, diameters can grow, and LPs go on.
  if (longest < s.tuning.narrow_bound && !(s.exact && r.stressed == Verdict::no)) return Kick::blocked;
  s.bound = first_bound(s.out.packing, s.o, s.tuning);
  s.moved = 1.0;
  s.stalled = 0;
  s.exact = false;
  return Kick::free;
}

}  // namespace jam
