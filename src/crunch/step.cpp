// Moving by an LP's answer without ever making an overlap.
#include <algorithm>
#include <cmath>

#include "core/motion.hpp"
#include "core/pair_rule.hpp"
#include "crunch/crunch.hpp"

namespace jam {
namespace {

Packing moved(const Packing &p, PairList &pairs, const LpSolution &x, double alpha, double unit,
              const StrainBasis &basis) {
  Packing q = p;
  const std::vector<double> strain = x.strain.empty() ? x.strain : strain_matrix(basis, x.strain, alpha);
  move_packing(q, pairs, x.s.data(), alpha * unit, std::sqrt(1.0 + alpha * x.g), strain);
  return q;
}

// Largest part by which a strain can shorten a vector.
double shortening(const LpSolution &x, const StrainBasis &basis) {
  double e2 = 0.0;
  if (!x.strain.empty())
    for (const double e : strain_matrix(basis, x.strain, 1.0)) e2 += e * e;
  return std::sqrt(e2);
}

// Upper bound of how much nearer any two spheres come at fixed cell: the two longest displacements.
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
// (s, e, g) that obeys them is convex and holds 0, so alpha (s, e, g) is safe for every alpha in [0, 1].
// Unlisted pairs: |r| >= reach + sigma_ij. The step brings them nearer by at most the sum of the two longest
// displacements and widens their contact distance by at most the growth of the largest diameter, so they stay apart if
// these make no more than reach: |r'| - sigma'_ij >= reach - (s_1 + s_2) - growth >= 0. A strain shortens |r| by at
// most its norm times |r|. If that does not settle it, every pair and image is looked at and alpha halved until none
// overlaps: at low density, where reach follows the free spacing, no pair can meet unseen.
double take_step(Packing &p, PairList &pairs, double reach, const LpSolution &x, double unit,
                 const StrainBasis &basis) {
  const double widest = contact_distance_max(p), shorter = shortening(x, basis) * (reach + widest),
               growth = (std::sqrt(1.0 + std::max(x.g, 0.0)) - 1.0) * widest;
  PairList shifted = pairs;
  double alpha = x.strain.empty() ? 1.0 : strain_part(p.dim, strain_matrix(basis, x.strain, 1.0));
  Packing q = moved(p, shifted, x, alpha, unit, basis);
  if (closest_approach(x, p.dim, unit) + growth + shorter > reach) {
    while (closest_pair(q).gap < -1e-13) {
      alpha *= 0.5;
      if (alpha < 1e-6) return 0.0;
      shifted = pairs;
      q = moved(p, shifted, x, alpha, unit, basis);
    }
  }
  p.position.swap(q.position);
  p.diameter.swap(q.diameter);
  p.cell = q.cell;
  pairs.offset.swap(shifted.offset);
  return alpha;
}

}  // namespace jam
