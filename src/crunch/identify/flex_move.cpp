#include "crunch/identify/flex_move.hpp"

#include <algorithm>
#include <cmath>

#include "core/cell_change.hpp"
#include "core/motion.hpp"
#include "core/pair_rule.hpp"
#include "crunch/approach/lp_step.hpp"
#include "crunch/control.hpp"
#include "crunch/identify/narrow_lps.hpp"

namespace jam::inside {
namespace {

// The flex or, where the test is undecided, the motion that may be one; or its opposite. Forces that do not balance
// exactly choose the sign: the spheres move where the net force pushes them.
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
      push += net.force[k] * net.vector[k * d + c] *
              (v[net.pairs.i[k] * d + c] - (net.pairs.wall(k) ? 0.0 : v[net.pairs.j[k] * d + c]));
  if (push < 0.0)
    for (double &x : v) x = -x;
  return v;
}

// r -> r + t (eps r + v) for all vectors r between spheres, then back to the old volume. False where Mari-Kurchan
// shifts would change.
bool deform_into(Packing &q, const Packing &p, const std::vector<double> &v, const std::vector<double> &eps, double t) {
  q = p;
  const int d = p.dim;
  std::vector<double> rows = p.cell.rows();
  const auto deform = [&](double *x) {
    Cell::Vector y{};
    for (int a = 0; a < d; ++a)
      for (int b = 0; b < d; ++b) y[a] += t * eps[a * d + b] * x[b];
    for (int a = 0; a < d; ++a) x[a] += y[a];
  };
  for (int c = 0; c < d; ++c) deform(&rows[c * d]);
  for (size_t k = 0; k < q.position.size(); k += d) deform(&q.position[k]);
  for (size_t k = 0; k < v.size(); ++k) q.position[k] += t * v[k];
  const NormalCell normal = normal_cell(d, rows.data());
  if (!keeps_shifts(p, normal)) return false;
  enter_cell(q, normal);
  const double back = p.cell.side() / q.cell.side();
  rows = q.cell.rows();
  for (double &x : rows) x *= back;
  for (double &x : q.position) x *= back;
  q.cell = strained_cell(d, rows);
  wrap_positions(q);
  return true;
}

}  // namespace

// A vertex of an LP along the flex, with all near pairs as rows: every flex ends at a pair or at the bound.
FlexMove move_along_flex(CrunchState &s, const PackingVerdict &verdict) {
  // An attempt is made once narrow LPs have left it open.
  const RigidityResult &r = verdict.result;
  if ((r.flex.empty() && (r.attempt.empty() || narrow_lps_left(s))) || s.found.flex_moves >= s.tuning.max_attempts)
    return FlexMove::none;
  ++s.found.flex_moves;
  Packing &p = s.out.packing;
  const size_t d = p.dim;
  const double unit = diameter_mean(p);
  const std::vector<double> v = direction_of(s, verdict);
  int32_t fixed = verdict.sphere.front();
  double longest = 0.0, bound = s.tuning.longest_flex_move;
  // Rows are met to a tolerance times the bound, so the bound is narrowed where pairs block early.
  for (bool again = true; again;) {
    PairList pairs = find_pairs(p, 2.0 * std::sqrt(static_cast<double>(d)) * bound * unit, 1.0);
    PackingLp lp = make_lp(p, pairs, unit);
    lp.bound = bound;
    for (double &c : lp.c) c = std::max(c, 0.0);  // closed ones overlap by rounding
    LpSolution x = solve_motion_clp(lp, v, fixed, ~p.container.closed(), &s.monitor);
    if (!x.solved || s.monitor.interrupted()) return FlexMove::none;
    longest = 0.0;
    for (const int32_t i : verdict.sphere)
      for (size_t c = 0; c < d; ++c) longest = std::max(longest, std::fabs(x.s[i * d + c]));
    again = longest < s.tuning.narrower * bound && longest > s.tuning.closed_gap;
    bound = 10.0 * longest;
    if (!again && longest > s.tuning.closed_gap) take_step(p, pairs, 0.0, x, unit);
  }
  s.monitor.log(JAM_LOG_INFO, "saddle at phi %.12f with %lld flexes: moves %.1e diameters along them",
                packing_fraction(p), static_cast<long long>(verdict.result.flexes), longest);
  if (s.history.behind(p)) record_opening(s);
  if (!(longest > s.tuning.closed_gap)) return FlexMove::none;
  // Where no force balances at the end of narrow LPs, diameters can grow, and LPs continue.
  if (longest < s.tuning.narrow_bound && !(!narrow_lps_left(s) && r.stressed == Verdict::no)) return FlexMove::blocked;
  restart_lps(s, first_bound(s.out.packing, s.o, s.tuning));
  return FlexMove::free;
}

// |r + t (eps r + v)|^2 = r^2 + 2 t r . (eps r + v) + t^2 |eps r + v|^2: contacts open, so only near pairs can block.
bool move_along_strained_flex(CrunchState &s, const PackingVerdict &strict) {
  const RigidityResult &r = strict.result;
  if (r.flex.empty() || r.strain.empty() || s.found.flex_moves >= s.tuning.max_attempts) return false;
  ++s.found.flex_moves;
  Packing &p = s.out.packing;
  const size_t d = static_cast<size_t>(p.dim);
  double largest = 0.0;
  std::vector<double> v(p.position.size(), 0.0), eps = r.strain;
  for (size_t q = 0; q < strict.sphere.size(); ++q)
    for (size_t c = 0; c < d; ++c) v[strict.sphere[q] * d + c] = r.flex[q * d + c];
  const double unit = diameter_mean(p);
  for (double x : v) largest = std::max(largest, std::fabs(x));
  for (double x : eps) largest = std::max(largest, unit * std::fabs(x));
  for (double t = s.tuning.longest_flex_move * unit / largest; t * largest > 1e-6 * unit; t *= 0.5) {
    Packing q;
    if (!deform_into(q, p, v, eps, t) || closest_pair(q).gap < -s.tuning.step_overlap(p)) continue;
    s.monitor.log(JAM_LOG_INFO, "saddle of the free cell at phi %.12f with %lld flexes: moves %.1e diameters",
                  packing_fraction(p), static_cast<long long>(r.flexes), t * largest / unit);
    p = std::move(q);
    record_opening(s);
    restart_lps(s, s.tuning.first_bound);
    return true;
  }
  return false;
}

}  // namespace jam::inside
