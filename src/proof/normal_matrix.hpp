// M = R^T R of the rows of a proof, with the pinned sphere held, its factor, and a proved lower bound of the smallest
// singular value of R.
#pragma once
#include <memory>
#include <vector>

#include "linalg/shifted_factor.hpp"
#include "proof/scene.hpp"

namespace jam::inside {

class NormalMatrix {
 public:
  NormalMatrix(const ProofScene &scene, const ProofEquations &equations);
  NormalMatrix(const NormalMatrix &) = delete;
  NormalMatrix &operator=(const NormalMatrix &) = delete;
  // False where R^T R is singular to rounding. The other functions need true.
  bool factorise();
  // v (nodes, dim) with R v nearest to y, refined to double precision; 0 at the pinned node.
  std::vector<double> nearest(const std::vector<double> &y) const;
  // f := the nearest to it with R^T f = 0, strict with R^T f = the gradient of log V.
  void project_on_balance(std::vector<double> &f) const;

  // The smallest eigenvalue of M is at least `singular`^2. A factorisation L L^T of M - mu without a lost pivot has
  // |M - mu - L L^T| <= gamma_(k + 4) |L| |L^T|, k the longest row of L (Higham, ch. 10), so that
  // eigenvalue >= mu - that error. 0 where no mu can be shown.
  struct Bound {
    double singular = 0.0;    // at or below the smallest singular value of the exact R
    double eigenvalue = 0.0;  // estimate of the smallest eigenvalue of M
    double rounding = 0.0;    // what the error bounds take off mu
  };
  Bound bound();

 private:
  double smallest_eigenvalue() const;
  void pin(std::vector<double> &v) const;
  double forming_error() const;
  const ProofScene &scene_;
  const ProofEquations &equations_;
  BlockMatrix m_;
  std::unique_ptr<ShiftedFactor> factor_;
};

}  // namespace jam::inside
