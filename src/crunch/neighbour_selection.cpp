#include "crunch/neighbour_selection.hpp"

#include <algorithm>
#include <cmath>

namespace jam {
namespace {

// A side is direction_covered when the line to some neighbour has at least this component along it, times 1/sqrt(d): of
// 2 d neighbours along the axes, turned as badly as can be, the best has 1/sqrt(d).
constexpr double direction_covered = 0.9;
// Longest reach, mean diameters: of spheres a tenth as large as the others few are free still.
constexpr double farthest = 2.4;
// The first longer one is at least this, however short the common one.
constexpr double first = 0.1;

// Spheres without a wall on one of the 2 d sides along the axes.
std::vector<size_t> uncovered_spheres(const Packing &p, const PairList &pairs) {
  const size_t d = p.dim, sides = 2 * d;
  std::vector<double> wall(p.n() * sides, 0.0);
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs.i[k] == pairs.j[k]) continue;  // its own image moves with it
    const double length = std::sqrt(pair_vector(p, pairs, k, r));
    for (size_t c = 0; c < d; ++c) {
      const double along = std::fabs(r[c]) / length;
      for (const bool of_i : {true, false}) {
        double &w = wall[(of_i ? pairs.i[k] : pairs.j[k]) * sides + 2 * c + ((r[c] > 0.0) == of_i)];
        w = std::max(w, along);
      }
    }
  }
  std::vector<size_t> free;
  for (size_t i = 0; i < p.n(); ++i)
    if (*std::min_element(&wall[i * sides], &wall[i * sides] + sides) <
        direction_covered / std::sqrt(static_cast<double>(d)))
      free.push_back(i);
  return free;
}

}  // namespace

PairList select_neighbours(const Packing &p, double reach, double slope) {
  std::vector<double> own(p.n(), reach);
  PairList pairs = find_pairs(p, reach, slope);
  const double unit = diameter_mean(p), limit = farthest * unit;
  while (reach < limit) {
    const std::vector<size_t> free = uncovered_spheres(p, pairs);
    if (free.empty()) break;
    reach = std::min(std::max(2.0 * reach, first * unit), limit);
    for (const size_t i : free) own[i] = reach;
    pairs = find_pairs(p, own, slope);
  }
  return pairs;
}

}  // namespace jam
