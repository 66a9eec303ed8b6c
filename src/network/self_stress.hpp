// States of self-stress from positions alone: the null space of S^T, without a dense matrix.
#pragma once
#include <vector>
#include "core/call_scope.hpp"
#include "network/grounded_solver.hpp"

namespace jam::inside {

// Projections on the null space of S^T.
class NullSpace {
 public:
  static constexpr int64_t most_zero_modes = 256;  // counted beyond the translations, no more
  explicit NullSpace(const RigidityMatrix &g);
  // f := f - S (S^T S)^+ S^T f by iterative refinement; refinements < 0: until the residual stops falling.
  // Returns the number of solves.
  int project(std::vector<double> &f, int refinements = -1) const;
  // Dimension of the null space of S^T, from that of S^T S (random probes of its kernel).
  int64_t dimension() const;
  int64_t zero_modes() const;  // of S^T S, translations among them
  const GroundedSolver &solver() const { return solver_; }

 private:
  const RigidityMatrix &g_;
  GroundedSolver solver_;
  mutable int64_t zeros_ = -1;
};

struct StressStates {
  int64_t dimension = 0;
  int64_t zero_modes = 0;
  std::vector<double> force;  // mean 1; the analytic centre of the non-negative ones when dimension > 1
  std::vector<double> basis;  // (dimension, contacts) orthonormal, when requested
  double residual = 0.0;      // largest |sum_j f_ij n_ij| over mean force
  double min_force = 0.0;     // over the mean
  bool positive = false;      // all forces > 0 (>= 0 when dimension > 1) and one is > 0
};

// The force of a network. Throws nothing for unjammed networks: dimension 0, or `positive` false.
StressStates find_stress(const RigidityMatrix &g, bool with_basis);
StressStates find_stress(const RigidityMatrix &g, const NullSpace &space, bool with_basis);

}  // namespace jam::inside
