// Linear systems with the Hessian of a network that is free to move as a whole.
#pragma once
#include <vector>
#include "linalg/shifted_factor.hpp"
#include "network/hessian.hpp"
#include "network/rigidity_matrix.hpp"

namespace jam::inside {

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
  int32_t clusters() const { return clusters_; }
  int64_t springs() const { return springs_; }  // translations of clusters that are zero modes

 private:
  const RigidityMatrix &g_;
  BlockMatrix h_, tied_;
  ShiftedFactor factor_;
  double scale_ = 1.0;  // a bound of the norm of H, where it is not 0: spheres that touch only their own images
  int32_t clusters_ = 0;
  int64_t springs_ = 0;
};

}  // namespace jam::inside
