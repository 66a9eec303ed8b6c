// States of self-stress from positions alone: the null space of S^T, without a dense matrix.
#pragma once
#include <functional>
#include <vector>
#include "analysis/factor.hpp"
#include "analysis/graph.hpp"
#include "analysis/hessian.hpp"
#include "core/monitor.hpp"

namespace jam {

// H x = b for b without components along the zero modes of H = S~^T S~, by one factorisation. One sphere of every cluster
// is tied to its place by a spring: for such b the spring carries no force, so the solution is exact, and only its
// translation is arbitrary. A tiny shift stands for zero modes that are no translations; refinement takes its error out.
class PinnedSolver {
 public:
  PinnedSolver(const StableGraph &g, const ContactWeights &w);
  // x := H^+ b for `count` vectors b; translations of the whole network are taken out of b and x.
  void solve(double *x, int count) const;
  // One plain solve with the factor, without refinement.
  void apply(double *x, int count) const { factor_.solve_many(x, count); }
  double shift() const { return factor_.shift(); }
  const BlockMatrix &hessian() const { return h_; }
  int32_t clusters() const { return clusters_; }

 private:
  const StableGraph &g_;
  BlockMatrix h_, tied_;
  ShiftedFactor factor_;
  int32_t clusters_ = 0;
};

// Projections on the null space of S^T.
class NullSpace {
 public:
  static constexpr int64_t most_zero_modes = 256;  // counted beyond the translations, no more
  explicit NullSpace(const StableGraph &g);
  // f := f - S (S^T S)^+ S^T f by iterative refinement; refinements < 0: until the residual stops falling.
  // Returns the number of solves.
  int project(std::vector<double> &f, int refinements = -1) const;
  // Dimension of the null space of S^T, from that of S^T S (random probes of its kernel).
  int64_t dimension() const;
  int64_t zero_modes() const;  // of S^T S, translations among them
  const PinnedSolver &solver() const { return solver_; }

 private:
  const StableGraph &g_;
  PinnedSolver solver_;
  mutable int64_t zeros_ = -1;
};

struct StressStates {
  int64_t dimension = 0;
  int64_t zero_modes = 0;
  std::vector<double> force;     // mean 1; of least norm and non-negative when dimension > 1
  std::vector<double> basis;     // (dimension, contacts) orthonormal, when asked for
  double residual = 0.0;         // largest |sum_j f_ij n_ij| over mean force
  double min_force = 0.0;        // over the mean
  bool positive = false;         // all forces > 0 (>= 0 when dimension > 1) and one is > 0
};

// The force of a network. Throws nothing for unjammed networks: dimension 0, or `positive` false.
StressStates find_stress(const StableGraph &g, bool with_basis, int refinements = -1);
// The least-norm f >= 0 with S^T f = 0 and mean 1, by projecting (1, 1, ...) on that cone; false when only f = 0 is in it.
bool least_force(const StableGraph &g, std::vector<double> &f);

}  // namespace jam
