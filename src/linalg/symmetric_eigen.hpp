// Eigenvalues, ascending, and orthonormal eigenvectors of a small symmetric matrix. Eigen's solver is compiled here
// alone: a copy of it is 60 kB.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace jam::inside {

struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // a column each
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &a);

// Small systems of more or fewer equations than unknowns.

// The shortest u (d) of those with the least |A u - b|; A (rows, d).
std::vector<double> least_squares(int d, const std::vector<double> &a, const std::vector<double> &b);

// Cholesky of a dense symmetric matrix of a few rows.

class SmallCholesky {
 public:
  // a: (n, n), of which the lower triangle counts. Pivots that rounding lost are raised to `least` of their entry.
  // Returns whether there were none.
  bool factorise(size_t n, const std::vector<double> &a, double least = 1e-14) {
    n_ = n, l_ = a;
    bool positive = true;
    for (size_t c = 0; c < n; ++c) {
      double pivot = at(c, c);
      for (size_t k = 0; k < c; ++k) pivot -= at(c, k) * at(c, k);
      if (!(pivot > least * std::fabs(a[c * n + c]))) positive = false, pivot = least * std::fabs(a[c * n + c]);
      at(c, c) = std::sqrt(pivot);
      for (size_t r = c + 1; r < n; ++r) {
        for (size_t k = 0; k < c; ++k) at(r, c) -= at(r, k) * at(c, k);
        at(r, c) /= at(c, c);
      }
    }
    return positive;
  }
  void solve(std::vector<double> &x) const {
    for (size_t r = 0; r < n_; ++r) {
      for (size_t k = 0; k < r; ++k) x[r] -= l_[r * n_ + k] * x[k];
      x[r] /= l_[r * n_ + r];
    }
    for (size_t r = n_; r-- > 0;) {
      for (size_t k = r + 1; k < n_; ++k) x[r] -= l_[k * n_ + r] * x[k];
      x[r] /= l_[r * n_ + r];
    }
  }

 private:
  double &at(size_t r, size_t c) { return l_[r * n_ + c]; }
  size_t n_ = 0;
  std::vector<double> l_;
};

}  // namespace jam::inside
