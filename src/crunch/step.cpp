// Moving by an LP's answer without ever making an overlap.
#include <algorithm>
#include <cmath>

#include "core/pair_rule.hpp"
#include "crunch/crunch.hpp"

namespace jam {
namespace {

Packing moved(const Packing &p, PairList &pairs, const LpSolution &x, double alpha, double unit) {
  Packing q = p;
  for (size_t k = 0; k < q.position.size(); ++k) q.position[k] += alpha * unit * x.s[k];
  const double factor = std::sqrt(1.0 + alpha * x.g);
  for (double &s : q.diameter) s *= factor;
  wrap_positions(q, pairs);
  return q;
}

// Upper bound of how much nearer any two spheres come: the two longest displacements.
double closest_approach(const LpSolution &x, int dim, double unit) {
  double first = 0.0, second = 0.0;
  for (size_t k = 0; k < x.s.size(); k += dim) {
    double s2 = 0.0;
    for (int c = 0; c < dim; ++c) s2 += x.s[k + c] * x.s[k + c];
    const double s = std::sqrt(s2) * unit;
    if (s > first)
      second = first, first = s;
    else if (s > second)
      second = s;
  }
  return first + second;
}

}  // namespace

// Listed pairs: the linearised rows are tighter than the true ones (|r + s|^2 = |r|^2 + 2 r.s + |s|^2), and the set of
// (s, g) that obeys them is convex and holds 0, so alpha (s, g) is safe for every alpha in [0, 1].
// Unlisted pairs: |r| >= reach + sigma_ij. The step brings them nearer by at most the sum of the two longest
// displacements and widens their contact distance by at most the growth of the largest diameter, so they stay apart if
// these make no more than reach: |r'| - sigma'_ij >= reach - (s_1 + s_2) - growth >= 0. If that does not settle it,
// every pair and image is looked at and alpha halved until none overlaps: at low density, where reach follows the free
// spacing, no pair can meet unseen.
double take_step(Packing &p, PairList &pairs, double reach, const LpSolution &x, double unit) {
  const double growth = (std::sqrt(1.0 + std::max(x.g, 0.0)) - 1.0) * contact_distance_max(p);
  PairList shifted = pairs;
  Packing q = moved(p, shifted, x, 1.0, unit);
  double alpha = 1.0;
  if (closest_approach(x, p.dim, unit) + growth > reach) {
    while (closest_pair(q).gap < -1e-13) {
      alpha *= 0.5;
      if (alpha < 1e-6) return 0.0;
      shifted = pairs;
      q = moved(p, shifted, x, alpha, unit);
    }
  }
  p.position.swap(q.position);
  p.diameter.swap(q.diameter);
  pairs.offset.swap(shifted.offset);
  return alpha;
}

}  // namespace jam
