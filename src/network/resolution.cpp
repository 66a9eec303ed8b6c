// See resolution.hpp.
#include "network/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decimal.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

// As many pairs touch to 1e-10 as hold half of the spheres, and they are three of four that nearly touch: in a lattice
// of few digits the pairs along an axis may touch exactly, and the others do not. Own images touch wherever the spheres
// are: they hold some only where contacts join all spheres.
bool has_exact_contacts(const Packing &p, double reach) {
  const double near = std::min(reach, nearly_touching * diameter_mean(p));
  const PairList pairs = find_pairs(p, near, 1.0 + contact_gap_limit);
  double r[JAM_MAX_DIM];
  size_t exact = 0, close = 0, own = 0;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]),
                 gap = std::sqrt(pair_vector(p, pairs, k, r)) - sigma;
    const bool touches = std::fabs(gap) < contact_gap_limit * sigma;
    if (pairs.own_image(k)) {
      own += touches;
      continue;
    }
    if (gap < near) ++close;
    exact += touches;
  }
  if (exact + 1 < p.n()) own = 0;
  return 2 * (exact + own) >= p.n() * static_cast<size_t>(p.dim) && 4 * exact >= 3 * close;
}

}  // namespace

double GapResolution::reach(double sigma) const {
  return std::min(8.0 * std::max(error, shrunk * sigma), widest_reach * sigma);
}

double GapResolution::relative(const Packing &p) const {
  const double smallest = *std::min_element(p.diameter.begin(), p.diameter.end());
  return std::max(rounding, reach(smallest) / (8.0 * smallest));
}

int32_t GapResolution::digits(const Packing &p) const {
  return step > 0.0 ? static_cast<int32_t>(std::lround(math::log(p.cell.side() / step) / math::log(10.0))) : 0;
}

// Where the error is wider than the reach of the smallest pair, no pair reaches farther than its part of sigma.
PairList GapResolution::pairs_in_reach(const Packing &p, double gap) const {
  const double smallest = *std::min_element(p.diameter.begin(), p.diameter.end());
  if (8.0 * error > widest_reach * smallest) return find_pairs(p, 0.0, 1.0 + std::max(gap, widest_reach));
  return find_pairs(p, 8.0 * error, 1.0 + std::max(gap, std::min(8.0 * shrunk, widest_reach)));
}

GapResolution gap_resolution(const Packing &p) {
  GapResolution out;
  const double smallest = *std::min_element(p.diameter.begin(), p.diameter.end()), side = p.cell.side();
  out.rounding = 8.0 * std::numeric_limits<double>::epsilon() * side / smallest;  // of coordinates as large as the box
  if (p.n() < 2) return out;  // one sphere touches only its own images, wherever it stands
  GivenDigits digits = coordinate_digits(p.dim, p.position, smallest);
  digits.take(fraction_digits(p, digits.step == 0.0));
  digits.take(p.given);
  out.step = digits.step, out.base = digits.base;
  out.error = std::sqrt(static_cast<double>(p.dim)) * out.step;
  if (out.coarse(p) && has_exact_contacts(p, 8.0 * out.error)) out.step = out.error = 0.0, out.base = 0;
  return out;
}

}  // namespace jam::inside
