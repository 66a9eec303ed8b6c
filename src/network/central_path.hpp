// The central path of a jamming test: forces and motions of the self-dual problem A^T f = mu x, w = A x + mu, f w = mu,
// f > 0, w > 0. As mu falls, f stays finite on contacts that carry force in some state of self-stress, and falls as mu
// on all others, where x opens them (Goldman and Tucker 1956; path following with Mehrotra's corrector as in S. J.
// Wright, Primal-Dual Interior-Point Methods, SIAM 1997).
#pragma once
#include <vector>

#include "network/constraint_rows.hpp"

namespace jam::inside {

class CentralPath {
 public:
  explicit CentralPath(const ConstraintRows &rows);
  // One step towards a smaller mu. False where steps have become too short to continue.
  bool step();

  double mu() const { return mu_; }
  int steps() const { return steps_; }
  const std::vector<double> &f() const { return f_; }
  const std::vector<double> &w() const { return w_; }
  const std::vector<double> &x() const { return x_; }

 private:
  double worst_product(double t, const std::vector<double> &df, const std::vector<double> &dw) const;
  void direction(double mu, const std::vector<double> &correction, std::vector<double> &df, std::vector<double> &dw,
                 std::vector<double> &dx) const;

  const ConstraintRows &rows_;
  NormalSolver solver_;
  std::vector<double> x_, f_, w_;
  double mu_ = 1.0;
  int steps_ = 0;
};

}  // namespace jam::inside
