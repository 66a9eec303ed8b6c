// Products and lengths of vectors, summed from front to back.
#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace jam::inside {

inline double dot(const std::vector<double> &x, const double *y) {
  return std::inner_product(x.begin(), x.end(), y, 0.0);
}
inline double dot(const std::vector<double> &x, const std::vector<double> &y) { return dot(x, y.data()); }
inline double norm(const std::vector<double> &x) { return std::sqrt(dot(x, x)); }
// Largest |x_k|.
inline double largest_entry(const std::vector<double> &x) {
  double most = 0.0;
  for (const double v : x) most = std::max(most, std::fabs(v));
  return most;
}
// |x|^2 of d components.
inline double squared(const double *x, int d) { return std::inner_product(x, x + d, x, 0.0); }
// Largest |x|^2 of the first n vectors of d components.
inline double largest_squared(const std::vector<double> &x, size_t n, int d) {
  double largest = 0.0;
  for (size_t i = 0; i < n; ++i) largest = std::max(largest, squared(&x[i * static_cast<size_t>(d)], d));
  return largest;
}

}  // namespace jam::inside
