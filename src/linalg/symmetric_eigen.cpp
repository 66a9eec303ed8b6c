#include "linalg/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

#include "linalg/dot.hpp"

namespace jam::inside {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

// Conjugate gradients on A^T A u = A^T b from 0: the directions stay in the range of A^T, so that u is the shortest
// one. They end after d steps except for rounding; as many again take that out.
std::vector<double> least_squares(int d, const std::vector<double> &a, const std::vector<double> &b) {
  const size_t n = static_cast<size_t>(d), m = b.size();
  std::vector<double> u(n, 0.0), down(n, 0.0), slope(n), left(b), along(m);
  double before = 0.0;
  for (size_t step = 0; step < 2 * n; ++step) {
    slope.assign(n, 0.0);
    for (size_t k = 0; k < m; ++k)
      for (size_t c = 0; c < n; ++c) slope[c] += left[k] * a[k * n + c];
    const double now = dot(slope, slope);
    if (!(now > 0.0)) break;
    const double kept = step % n > 0 ? now / before : 0.0;
    for (size_t c = 0; c < n; ++c) down[c] = slope[c] + kept * down[c];
    for (size_t k = 0; k < m; ++k) {
      along[k] = 0.0;
      for (size_t c = 0; c < n; ++c) along[k] += a[k * n + c] * down[c];
    }
    const double length = dot(along, along);
    if (!(length > 0.0)) break;
    for (size_t c = 0; c < n; ++c) u[c] += now / length * down[c];
    for (size_t k = 0; k < m; ++k) left[k] -= now / length * along[k];
    before = now;
  }
  return u;
}

}  // namespace jam::inside
