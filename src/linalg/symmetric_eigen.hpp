// Eigenvalues, ascending, and orthonormal eigenvectors of a small symmetric matrix. Eigen's solver is compiled here
// alone: a copy of it is 60 kB.
#pragma once
#include <Eigen/Core>

namespace jam::inside {

struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // a column each
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &a);

}  // namespace jam::inside
