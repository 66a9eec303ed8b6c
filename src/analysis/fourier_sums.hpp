// Sums of exp(2 pi i m . s) over points s, for all whole m up to a bound: spread on a grid, and transformed there.
#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <vector>

namespace jam::inside {

// For m[0] in 0..most[0], other m[c] in -most[c]..most[c]; the sum at -m is the conjugate one. Of unused axes `most` is
// 0. The kernel is that of A. H. Barnett, J. Magland and L. af Klinteberg, SIAM J. Sci. Comput. 41, C479 (2019).
class FourierSums {
 public:
  using Bounds = std::array<int, 3>;
  // s: (points, axes), in cell vectors. Relative to the number of points, sums are exact to 1e-12.
  FourierSums(const std::vector<double> &s, size_t axes, const Bounds &most);
  std::complex<double> at(const int *m) const { return sum_[index(m)]; }
  // Of the grid and the sums, and about the seconds that they take.
  static double bytes(const Bounds &most);
  static double seconds(size_t points, const Bounds &most);

 private:
  size_t index(const int *m) const {
    size_t at = static_cast<size_t>(m[0]);
    for (size_t c = 1; c < axes_; ++c) at = at * width(c) + static_cast<size_t>(m[c] + most_[c]);
    return at;
  }
  size_t width(size_t c) const { return (c == 0 ? 1 : 2) * static_cast<size_t>(most_[c]) + 1; }
  std::vector<double> spread(const std::vector<double> &s) const;
  void transform(const std::vector<double> &grid);

  size_t axes_;
  Bounds most_;
  std::array<size_t, 3> side_{1, 1, 1};  // of the grid
  std::vector<std::complex<double>> sum_;
};

}  // namespace jam::inside
