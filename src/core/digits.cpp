#include "core/decimal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
using Tuning = DigitsTuning;
// Which numbers show that they are multiples of a step: at least `count` of them and more than the part `part`, each
// with an integer of at least `least` times a power of the base.
struct Rule {
  double least, part;
  size_t count, sample;
};
// nearly_all, of positions along a cell vector: more than the half that multiples of a length may reach, too many for
// chance.
constexpr Rule most_coordinates{0.0, Tuning::most_part, Tuning::most_count, Tuning::sample},
    nearly_all{0.0, 0x1.ep-1, 8, Tuning::sample},
    some_coordinates{Tuning::rounded, Tuning::some_part, Tuning::some_count, Tuning::large_sample},
    most_lengths{Tuning::rounded, Tuning::most_part, Tuning::most_count, Tuning::sample};
// Doubles above it are integers whatever they came from.
constexpr double most_digits = 0x1p53;

// How many of every stride-th number are multiples as the rule asks, and of how many; zeros, and numbers that may have
// been chosen, are left out.
struct Share {
  size_t fit = 0, all = 0;
};
Share multiples(const std::vector<double> &x, double scale, double noise, int base, const Rule &rule, size_t stride) {
  Share s;
  for (size_t k = 0; k < x.size(); k += stride) {
    if (x[k] == 0.0) continue;
    ++s.all;
    const double y = std::fabs(x[k] * scale);
    if (!(y < most_digits)) continue;
    double whole = std::nearbyint(y);
    if (std::fabs(y - whole) > noise) continue;
    while (rule.least > 0.0 && whole >= rule.least && whole / base == std::nearbyint(whole / base)) whole /= base;
    whole >= rule.least ? ++s.fit : --s.all;
  }
  return s;
}

// The coarsest power of the base, no wider than `widest`, of which x are multiples; 0 without one. A sample says no at
// once where the rule requires more than half.
double step_of(const std::vector<double> &x, double largest, double widest, int base, const Rule &rule) {
  if (!(largest > 0.0 && std::isfinite(widest))) return 0.0;
  const size_t stride = std::max<size_t>(1, x.size() / rule.sample) | 1;
  const auto noise = [&](double scale) { return 8.0 * epsilon * largest * scale; };
  const auto share = [&](double scale, size_t every) { return multiples(x, scale, noise(scale), base, rule, every); };
  const auto shows = [&](const Share &s) {
    return s.fit >= rule.count && static_cast<double>(s.fit) > rule.part * static_cast<double>(s.all);
  };
  for (double k = std::ceil(-math::log(widest) / math::log(static_cast<double>(base)));; ++k) {
    const double scale = math::pow(static_cast<double>(base), k), finer = scale * base;
    if (!(noise(scale) <= Tuning::most_noise)) return 0.0;  // NaN where the scale overflows
    const Share s = share(scale, stride);
    if (!shows(s) || (rule.sample == Tuning::sample && stride > 1 && !shows(share(scale, 1)))) continue;
    if (!(noise(finer) <= Tuning::most_noise) ||
        static_cast<double>(s.fit) > Tuning::kept * static_cast<double>(share(finer, stride).fit))
      return 1.0 / scale;
  }
}

void look_at(const std::vector<double> &x, double largest, double widest, double unit, const Rule &rule,
             GivenDigits &out) {
  for (const int base : {10, 2}) {
    const double step = unit * step_of(x, largest, widest, base, rule);
    out.take({step, base});
  }
}

}  // namespace

GivenDigits digits_of(int dim, const std::vector<double> &position, const std::vector<double> &diameter,
                      const std::vector<double> &rows) {
  const double smallest = *std::min_element(diameter.begin(), diameter.end());
  GivenDigits out = coordinate_digits(dim, position, smallest);
  double edge = 0.0;
  for (const double x : rows) edge = std::max(edge, std::fabs(x));
  look_at(diameter, *std::max_element(diameter.begin(), diameter.end()), smallest, 1.0, most_lengths, out);
  look_at(rows, edge, smallest, 1.0, most_lengths, out);
  return out;
}

GivenDigits coordinate_digits(int dim, const std::vector<double> &position, double smallest) {
  GivenDigits out;
  double largest = 0.0;
  for (const double x : position) largest = std::max(largest, std::fabs(x));
  for (const Rule &rule : {most_coordinates, some_coordinates})
    if (position.size() > static_cast<size_t>(dim)) look_at(position, largest, smallest, 1.0, rule, out);
  return out;
}

GivenDigits fraction_digits(const Packing &p, bool some) {
  GivenDigits out;
  const double smallest = *std::min_element(p.diameter.begin(), p.diameter.end()), side = p.cell.side();
  std::vector<double> s(p.position);
  for (size_t i = 0; i < p.n(); ++i) p.cell.fraction(&s[i * p.dim], &s[i * p.dim]);
  look_at(s, 1.0, smallest / side, side, nearly_all, out);
  if (some) look_at(s, 1.0, smallest / side, side, some_coordinates, out);
  return out;
}

}  // namespace jam::inside
