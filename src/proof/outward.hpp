// Bounds that hold despite rounding: every operation here returns a number at or above (or below) the exact one.
// Rounding to nearest is assumed; the guard of the C boundary sets it.
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace jam::inside {

constexpr double half_ulp = 0x1p-53;

inline double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
inline double down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }
inline double add_up(double a, double b) { return up(a + b); }
inline double sub_up(double a, double b) { return up(a - b); }
inline double sub_down(double a, double b) { return down(a - b); }
inline double mul_up(double a, double b) { return up(a * b); }
inline double mul_down(double a, double b) { return down(a * b); }
inline double div_up(double a, double b) { return up(a / b); }
inline double div_down(double a, double b) { return down(a / b); }
inline double sqrt_up(double x) { return up(std::sqrt(x)); }
inline double sqrt_down(double x) { return down(std::sqrt(x)); }

// gamma_k = k u / (1 - k u): the relative error of a sum or product of k roundings, in any order, with fused
// multiply-add or not (N. J. Higham, Accuracy and Stability of Numerical Algorithms, SIAM 2002, ch. 3).
inline double gamma_of(double k) { return div_up(mul_up(k, half_ulp), sub_down(1.0, mul_up(k, half_ulp))); }

// At or above the sum of numbers that are not negative.
inline double sum_up(const std::vector<double> &x) {
  double s = 0.0;
  for (const double v : x) s += v;
  return mul_up(s, add_up(1.0, gamma_of(static_cast<double>(x.size()))));
}
// At or above |x|.
inline double norm_up(const std::vector<double> &x) {
  double s = 0.0;
  for (const double v : x) s += v * v;
  return sqrt_up(mul_up(s, add_up(1.0, gamma_of(static_cast<double>(x.size()) + 1.0))));
}

}  // namespace jam::inside
