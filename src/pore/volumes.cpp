// Volumes of balls that planes, balls and cylinders cut.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/math.hpp"
#include "pore/profile.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {
namespace {

double clamped(double x) { return std::min(1.0, std::max(-1.0, x)); }

// Integral over [from, to] by tanh-sinh quadrature (Takahasi and Mori, Publ. RIMS 9, 721 (1974)): roots at the ends,
// where shapes begin to cut each other, cost nothing.
template <class F>
double integral(double from, double to, const F &f) {
  constexpr int steps = QuadratureTuning::steps;
  constexpr double step = QuadratureTuning::step;
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (int k = -steps; k <= steps; ++k) {
    const double e = math::exp(k * step), s = 0.25 * math::pi * (e - 1.0 / e), c = 0.25 * math::pi * (e + 1.0 / e);
    const double g = math::exp(2.0 * std::fabs(s));
    const double left = 2.0 / (g + 1.0);  // distance to the nearer end, of 2
    const double weight = 4.0 * g / ((g + 1.0) * (g + 1.0)) * c;
    sum += weight * f(s < 0.0 ? from + half * left : to - half * left);
  }
  return sum * step * half;
}

}  // namespace

double volume_below(int dim, double radius, double t) {
  const double u = clamped(t / radius);
  if (dim == 2) return radius * radius * (0.5 * math::pi + math::asin(u) + u * std::sqrt(1.0 - u * u));
  return math::pi * radius * radius * radius * (1.0 + u) * (1.0 + u) * (2.0 - u) / 3.0;
}

double shared_volume(int dim, double a, double b, double apart) {
  const double small = std::min(a, b), large = std::max(a, b);
  if (small <= 0.0 || apart >= a + b) return 0.0;
  if (apart <= large - small) return volume_below(dim, small, small);
  // The plane of the common circle is at these distances from the centres, on each one's far side when negative.
  const double to_large = 0.5 * (apart + (large - small) * (large + small) / apart), to_small = apart - to_large;
  return volume_below(dim, large, -to_large) + volume_below(dim, small, -to_small);
}

double shared_with_cylinder(double ball, double cylinder, double apart) {
  if (cylinder <= 0.0 || apart >= ball + cylinder) return 0.0;
  if (apart + ball <= cylinder) return volume_below(3, ball, ball);
  // At height z the ball is a disk; where its radius is one of these it begins to cut the circle, or to contain it.
  const auto height = [&](double r) { return std::sqrt(std::max(0.0, (ball - r) * (ball + r))); };
  const std::array<double, 4> ends{0.0, height(cylinder + apart), height(std::fabs(cylinder - apart)), ball};
  double sum = 0.0;
  for (size_t k = 0; k < 3; ++k)
    sum += integral(ends[k], ends[k + 1], [&](double z) {
      return shared_volume(2, std::sqrt(std::max(0.0, (ball - z) * (ball + z))), cylinder, apart);
    });
  return 2.0 * sum;
}

}  // namespace jam::inside
