#include "crunch/path/neighbours.hpp"

#include <algorithm>
#include <cmath>

namespace jam::inside {
namespace {

// Spheres that lack a neighbour in one of the 2 d directions along the axes. A direction is covered when the line to
// some neighbour has at least the component `covered` / sqrt(d) along it: of 2 d neighbours along axes turned as badly
// as can be, the best has 1 / sqrt(d).
std::vector<size_t> uncovered_spheres(const Packing &p, const PairList &pairs, double covered) {
  const size_t d = p.dim, sides = 2 * d;
  std::vector<double> cover(p.n() * sides, 0.0);
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs.i[k] == pairs.j[k]) continue;  // its own image moves with it
    const double length = std::sqrt(pair_vector(p, pairs, k, r));
    for (size_t c = 0; c < d; ++c) {
      const double along = std::fabs(r[c]) / length;
      for (const bool of_i : {true, false}) {
        if (!of_i && pairs.wall(k)) continue;
        double &w = cover[(of_i ? pairs.i[k] : pairs.j[k]) * sides + 2 * c + ((r[c] > 0.0) == of_i)];
        w = std::max(w, along);
      }
    }
  }
  std::vector<size_t> free;
  for (size_t i = 0; i < p.n(); ++i)
    if (*std::min_element(&cover[i * sides], &cover[i * sides] + sides) < covered / std::sqrt(static_cast<double>(d)))
      free.push_back(i);
  return free;
}

}  // namespace

PairList select_neighbours(const Packing &p, double reach, double slope, const Tuning &tuning) {
  std::vector<double> own(p.n(), reach);
  PairList pairs = find_pairs(p, reach, slope);
  const double unit = diameter_mean(p), limit = tuning.farthest_reach * unit;
  while (reach < limit) {
    const std::vector<size_t> free = uncovered_spheres(p, pairs, tuning.covered);
    if (free.empty()) break;
    reach = std::min(2.0 * std::max(reach, tuning.least_reach * unit), limit);
    std::vector<char> again(p.n(), 0);
    for (const size_t i : free) own[i] = reach, again[i] = 1;
    pairs = replace_pairs(pairs, again, find_pairs_of(p, again, own, slope));
  }
  return pairs;
}

}  // namespace jam::inside
