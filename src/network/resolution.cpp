// See resolution.hpp.
#include "network/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "core/pairs.hpp"

namespace jam {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
// Rounding of a coordinate may be this part of a step: then fewer than 1 of 100 other numbers pass as multiples.
constexpr double most_noise = 0.005;
// A wider error says nothing about contacts at all.
constexpr double widest_reach = 0.5;
constexpr size_t sample = 64;

// Are more than half of the values, zeros left out, multiples of 1 / scale? A sample says no at once.
bool are_multiples(const std::vector<double> &x, double scale, double noise) {
  const auto share = [&](size_t stride) {
    size_t fit = 0, all = 0;
    for (size_t k = 0; k < x.size(); k += stride) {
      if (x[k] == 0.0) continue;
      const double y = x[k] * scale;
      ++all;
      fit += std::fabs(y - std::nearbyint(y)) <= noise;
    }
    return all > 0 && 2 * fit > all;
  };
  const size_t stride = std::max<size_t>(1, x.size() / sample) | 1;
  return share(stride) && (stride == 1 || share(1));
}

// The coarsest power of the base, no wider than `widest`, of which x are multiples; 0 without one.
double step_of(const std::vector<double> &x, double largest, double widest, int base) {
  const double first = std::ceil(-math::log(widest) / math::log(static_cast<double>(base)));
  for (double k = first;; ++k) {
    const double scale = math::pow(static_cast<double>(base), k), noise = 8.0 * epsilon * largest * scale;
    if (noise > most_noise) return 0.0;
    if (are_multiples(x, scale, noise)) return 1.0 / scale;
  }
}

void coarser_step(const std::vector<double> &x, double largest, double widest, double unit, GapResolution &out) {
  for (const int base : {10, 2}) {
    const double step = unit * step_of(x, largest, widest, base);
    if (step > out.step) out.step = step, out.base = base;
  }
}

bool has_exact_contacts(const Packing &p) {
  const PairList pairs = find_pairs(p, 0.0, 1.0 + contact_gap_limit);
  double r[JAM_MAX_DIM];
  size_t count = 0;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
    count += !pairs.own_image(k) && std::sqrt(pair_vector(p, pairs, k, r)) > sigma * (1.0 - contact_gap_limit);
  }
  return 2 * count >= p.n() * static_cast<size_t>(p.dim);
}

}  // namespace

double GapResolution::relative(const Packing &p) const {
  return std::max(rounding, error / *std::min_element(p.diameter.begin(), p.diameter.end()));
}

int32_t GapResolution::digits(const Packing &p) const {
  return step > 0.0 ? static_cast<int32_t>(std::lround(math::log(p.cell.side() / step) / math::log(10.0))) : 0;
}

void widen(GapResolution &resolution, const Packing &p, double error) {
  const double widest = widest_reach / 8.0 * *std::min_element(p.diameter.begin(), p.diameter.end());
  resolution.error = std::max(resolution.error, std::min(error, widest));
}

GapResolution gap_resolution(const Packing &p) {
  GapResolution out;
  const double smallest = *std::min_element(p.diameter.begin(), p.diameter.end()), side = p.cell.side();
  out.rounding = 8.0 * epsilon * side / smallest;  // of coordinates as large as the box
  if (p.n() < 2) return out;                       // one sphere touches only its own images, wherever it stands
  double largest = side;
  for (const double x : p.position) largest = std::max(largest, std::fabs(x));
  coarser_step(p.position, largest, smallest, 1.0, out);
  std::vector<double> s(p.position);
  for (size_t i = 0; i < p.n(); ++i) p.cell.fraction(&s[i * p.dim], &s[i * p.dim]);
  coarser_step(s, 1.0, smallest / side, side, out);
  widen(out, p, std::sqrt(static_cast<double>(p.dim)) * out.step);
  if (out.coarse(p) && has_exact_contacts(p)) out.step = out.error = 0.0, out.base = 0;
  return out;
}

}  // namespace jam
