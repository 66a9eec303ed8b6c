// The product of two vectors, summed from front to back.
#pragma once
#include <numeric>
#include <vector>

namespace jam::inside {

inline double dot(const std::vector<double> &x, const std::vector<double> &y) {
  return std::inner_product(x.begin(), x.end(), y.begin(), 0.0);
}

}  // namespace jam::inside
