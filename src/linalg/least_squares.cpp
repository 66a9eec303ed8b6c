#include "linalg/least_squares.hpp"

#include <Eigen/Dense>

namespace jam {

std::vector<double> least_squares(int d, const std::vector<double> &a, const std::vector<double> &b) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto m = static_cast<Eigen::Index>(b.size());
  std::vector<double> u(static_cast<size_t>(d), 0.0);
  if (m > 0)
    Eigen::Map<Eigen::VectorXd>(u.data(), d) = Eigen::Map<const Rows>(a.data(), m, d)
                                                   .completeOrthogonalDecomposition()
                                                   .solve(Eigen::Map<const Eigen::VectorXd>(b.data(), m));
  return u;
}

}  // namespace jam
