#include "proof/newton.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/double_double.hpp"
#include "lp/packing_lp.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

// All pairs of spheres that a step may close, contacts first.
std::vector<NearPair> all_pairs(const ProofScene &s) {
  std::vector<NearPair> out;
  for (size_t c = 0; c < s.contacts(); ++c) {
    const auto at = s.image.begin() + static_cast<std::ptrdiff_t>(c * s.dim);
    out.push_back({s.sphere[s.a[c]], s.partner(c), std::vector<int32_t>(at, at + s.dim), 0.0});
  }
  for (NearPair &pair : near_pairs(s)) out.push_back(std::move(pair));
  return out;
}

// Gamma becomes the largest at which no pair overlaps, 0 where two centres are one; returns by how much it grows, over
// Gamma.
double fit_gamma(ProofScene &s, std::vector<NearPair> &pairs) {
  double least = HUGE_VAL;
  for (const NearPair &pair : pairs) least = std::min(least, opening_of(s, pair));
  s.grow(least);
  for (NearPair &pair : pairs) pair.opening = opening_of(s, pair);
  return least / s.gamma();
}

// The LP of one step, and which of the pairs has each row.
struct Step {
  PairList list;
  PackingLp lp;
  std::vector<size_t> pair;
};
// Lengths in steps of `step` diameters of ratio 1; a pair that is farther open than both spheres can move has no row.
void make_step(const ProofScene &s, const std::vector<NearPair> &pairs, double step, Step &out) {
  const size_t d = static_cast<size_t>(s.dim);
  // Rows of both spheres change by 2 |r| / (unit sigma2) times |s_i - s_j| each, Gamma by as much as a closed pair.
  const double unit = std::sqrt(s.gamma()), reach = 4.0 * std::sqrt(static_cast<double>(d)),
               growth = reach / *std::min_element(s.ratio.begin(), s.ratio.end());
  for (size_t k = 0; k < pairs.size(); ++k) {
    const NearPair &pair = pairs[k];
    const double sigma2 = s.weight(pair.i, pair.j), c = pair.opening / (s.gamma() * step);
    if (c > reach / std::sqrt(sigma2) + growth) continue;
    out.pair.push_back(k), out.list.i.push_back(pair.i), out.list.j.push_back(pair.j), out.lp.c.push_back(c);
    for (size_t q = 0; q < d; ++q)
      out.lp.a.push_back((s.round(pair.j) ? -4.0
                          : pair.j < 0    ? 4.0
                                          : 2.0) *
                         apart(s, pair, q).value() / (unit * sigma2));
  }
  out.lp.dim = s.dim, out.lp.n = static_cast<int32_t>(s.ratio.size()), out.lp.pairs = &out.list, out.lp.bound = 1.0;
}

// The pairs that are closed are the contacts of the scene.
void take_closed(ProofScene &s, const std::vector<NearPair> &pairs, const std::vector<double> &force) {
  s.a.clear(), s.b.clear(), s.image.clear(), s.force.clear(), s.sphere.clear();
  s.implied.clear(), s.row.clear();
  std::vector<char> touches(s.ratio.size(), 0);
  for (const NearPair &pair : pairs)
    if (pair.opening <= proof_tuning::closed) for_spheres(pair.i, pair.j, [&](int32_t i) { touches[i] = 1; });
  for (size_t i = 0; i < touches.size(); ++i) {
    s.node[i] = touches[i] ? static_cast<int32_t>(s.sphere.size()) : -1;
    if (touches[i]) s.sphere.push_back(static_cast<int32_t>(i));
  }
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].opening > proof_tuning::closed) continue;
    const int32_t j = pairs[k].j;
    s.a.push_back(s.node[pairs[k].i]), s.b.push_back(j < 0 ? j : s.node[j]), s.force.push_back(force[k]);
    s.image.insert(s.image.end(), pairs[k].image.begin(), pairs[k].image.end());
  }
  pin_rotations(s);
}

}  // namespace

LpsEnd close_by_lps(ProofScene &scene) {
  if (scene.own_images || scene.strict) return LpsEnd::no_end;
  if (!clp_is_built()) return LpsEnd::without_clp;
  ProofScene s = scene;
  std::vector<NearPair> pairs = all_pairs(s);
  std::vector<double> force(pairs.size());
  fit_gamma(s, pairs);
  if (!(s.gamma() > 0.0)) return LpsEnd::no_end;
  LpSolution before;
  double length = proof_tuning::vanishing;
  for (int k = 0; k < proof_tuning::most_rounds; ++k) {
    CallScope::look();
    Step step;
    make_step(s, pairs, length, step);
    if (step.pair.size() > proof_tuning::largest_lp) return LpsEnd::too_many_rows;
    const bool same_rows = before.basis_rows.size() == step.pair.size();
    LpSolution found = solve_lp_clp(step.lp, lp_rounding, nullptr, same_rows ? &before : nullptr);
    if (!found.solved) return LpsEnd::no_end;
    for (size_t x = 0; x < s.high.size(); ++x) add_to(s.high[x], s.low[x], found.s[x] * length * std::sqrt(s.gamma()));
    std::fill(force.begin(), force.end(), 0.0);
    for (size_t row = 0; row < step.pair.size(); ++row) force[step.pair[row]] = found.y[row];
    const double gain = fit_gamma(s, pairs);
    before = std::move(found);
    if (gain > proof_tuning::still_climbs * length) continue;
    length *= proof_tuning::vanishing;
    if (length < proof_tuning::closed) {
      take_closed(s, pairs, force);
      scene = std::move(s);
      return LpsEnd::closed;
    }
  }
  return LpsEnd::no_end;
}

}  // namespace jam::inside
