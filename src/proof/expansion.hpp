// Exact sums and products of doubles, as sums of doubles that do not overlap (J. R. Shewchuk, Discrete Comput. Geom.
// 18, 305 (1997)). Exact while nothing overflows and no product falls below 1e-290.
#pragma once
#include <array>
#include <cstddef>

#include "core/double_double.hpp"
#include "core/error.hpp"

namespace jam {

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
    if (x != 0.0) {
      if (kept == part_.size()) fail(JAM_E_INTERNAL, "an exact sum has more than %zu parts", part_.size());
      part_[kept++] = x;
    }
    count_ = kept;
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
  // The nearest double but for one rounding.
  double value() const {
    double s = 0.0;
    for (size_t k = 0; k < count_; ++k) s += part_[k];
    return s;
  }
  size_t count() const { return count_; }
  double part(size_t k) const { return part_[k]; }  // by growing size

 private:
  std::array<double, 40> part_{};
  size_t count_ = 0;
};

}  // namespace jam
