// Exact sums and products of doubles, as sums of doubles that do not overlap (J. R. Shewchuk, Discrete Comput. Geom.
// 18, 305 (1997)). Exact while no product falls below 1e-290. Where a sum is not finite it fails: comparisons with
// what is not a number would let it pass for closed or open.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/double_double.hpp"
#include "core/error.hpp"

namespace jam::inside {

class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(double x) { add(x); }

  void add(double x) {
    size_t kept = 0;
    for (size_t k = 0; k < count_; ++k) {
      const DoubleDouble s = two_sum(x, part_[k]);
      if (s.low != 0.0) part_[kept++] = s.low;
      x = s.high;
    }
    if (!std::isfinite(x)) fail(JAM_E_INTERNAL, "an exact sum is not finite");
    if (x != 0.0) part_[kept++] = x;
    count_ = kept;
    if (count_ == part_.size()) compress();
  }
  void add(const Expansion &other) {
    for (size_t k = 0; k < other.count_; ++k) add(other.part_[k]);
  }
  void add_product(double a, double b) {
    const DoubleDouble p = two_product(a, b);
    add(p.low), add(p.high);
  }
  void add_product(const Expansion &a, const Expansion &b, double sign = 1.0) {
    for (size_t k = 0; k < a.count_; ++k)
      for (size_t q = 0; q < b.count_; ++q) add_product(sign * a.part_[k], b.part_[q]);
  }
  // The nearest double except for one rounding.
  double value() const {
    double s = 0.0;
    for (size_t k = 0; k < count_; ++k) s += part_[k];
    return s;
  }
  size_t count() const { return count_; }
  double part(size_t k) const { return part_[k]; }  // by growing size

 private:
  // The same sum in the fewest parts (section 2.8 there): each is at most half a unit in the last place of the next, so
  // 53 bits lie between them and 41 parts reach from the largest double to the least.
  void compress() {
    double high = part_[count_ - 1];
    size_t bottom = count_;
    for (size_t k = count_ - 1; k-- > 0;) {
      const DoubleDouble s = two_sum(high, part_[k]);
      high = s.high;
      if (s.low != 0.0) part_[--bottom] = s.high, high = s.low;
    }
    part_[--bottom] = high;
    size_t kept = 0;
    for (size_t k = bottom + 1; k < count_; ++k) {
      const DoubleDouble s = two_sum(part_[k], high);
      high = s.high;
      if (s.low != 0.0) part_[kept++] = s.low;
    }
    part_[kept++] = high;
    count_ = kept;
    if (count_ == part_.size()) fail(JAM_E_INTERNAL, "an exact sum has %zu parts", count_);
  }

  std::array<double, 48> part_{};
  size_t count_ = 0;
};

// Bounds that hold despite rounding: every operation here returns a number at or above (or below) the exact one.
// Rounding to nearest is assumed; the guard of the C boundary sets it.

constexpr double half_ulp = 0x1p-53;

inline double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
inline double down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }
inline double add_up(double a, double b) { return up(a + b); }
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
