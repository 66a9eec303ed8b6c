// States of self-stress from positions alone: the null space of S^T, without a dense matrix.
#pragma once
#include "linalg/block_cholesky.hpp"
#include "network/rigidity_matrix.hpp"

namespace jam::inside {

// Linear systems with the Hessian of a network that is free to move as a whole.

// Connected sets of touching spheres.
int32_t count_clusters(const RigidityMatrix &g);

// H x = b for b without components along the zero modes of H = S~^T S~, by one factorisation. One sphere of every
// cluster is tied to its place by a spring: for such b the spring carries no force, so the solution is exact, and only
// its translation is arbitrary. Along axes where a wall pushes its cluster there is no spring. A tiny shift stands for
// zero modes that are no translations; refinement takes its error out.
class GroundedSolver {
 public:
  GroundedSolver(const RigidityMatrix &g, const ContactWeights &w);
  // x := H^+ b for `count` vectors b; symmetries of the whole network are taken out of b and x.
  void solve(double *x, int count) const;
  // One plain solve with the factor, without refinement.
  void apply(double *x, int count) const { factor_.solve_many(x, count); }
  double shift() const { return factor_.shift(); }
  double scale() const { return scale_; }
  const BlockMatrix &hessian() const { return h_; }
  int64_t springs() const { return springs_; }  // translations of clusters that are zero modes

 private:
  const RigidityMatrix &g_;
  BlockMatrix h_, tied_;
  ShiftedFactor factor_;
  double scale_ = 1.0;  // a bound of the norm of H, where it is not 0: spheres that touch only their own images
  int64_t springs_ = 0;
};

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
