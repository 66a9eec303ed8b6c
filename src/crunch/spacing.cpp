#include "crunch/spacing.hpp"

#include <algorithm>
#include <cmath>

#include "core/math.hpp"
#include "core/pair_rule.hpp"

namespace jam::inside {

double jammed_fraction(int dim) { return dim == 2 ? 0.84 : 0.64 * math::pow(0.7, dim - 3); }

double free_spacing(const Packing &p) {
  return std::max(0.0, math::pow(packing_fraction(p), -1.0 / p.dim) - math::pow(jammed_fraction(p.dim), -1.0 / p.dim));
}

std::vector<double> relative_gaps(const Packing &p, const PairList &pairs) {
  std::vector<double> gap(pairs.size());
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < gap.size(); ++k)
    gap[k] = std::sqrt(pair_vector(p, pairs, k, r)) / contact_distance(p, pairs.i[k], pairs.j[k]) - 1.0;
  return gap;
}

double contact_gap(const Packing &p) {
  const PairList pairs = find_pairs(p, 0.0, 1.5);
  const size_t wanted = static_cast<size_t>(p.dim) * p.n() / 2;
  if (pairs.size() <= wanted) return 0.5;
  std::vector<double> gap = relative_gaps(p, pairs);
  std::nth_element(gap.begin(), gap.begin() + wanted, gap.end());
  return gap[wanted];
}

}  // namespace jam::inside
