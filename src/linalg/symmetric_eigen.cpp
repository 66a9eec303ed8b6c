#include "linalg/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace jam::inside {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace jam::inside
