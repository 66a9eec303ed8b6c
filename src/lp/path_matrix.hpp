// The matrix of a Newton step on the barrier path: which rows couple spheres in it, and its numbers.
#pragma once
#include <vector>

#include "core/packing.hpp"
#include "lp/barrier_problem.hpp"
#include "lp/mixed_factor.hpp"

namespace jam::inside {

class PathMatrix {
 public:
  PathMatrix(NewtonSystem &system, int threads, const SinglePrecision &single)
      : system_(system), factor_(system, single), threads_(threads) {}

  // Call this when the pair list changes.
  void reset(size_t rows, size_t unknowns);
  // The numbers of the matrix at the present rows, with `proximal` on its diagonal.
  void weigh(const Packing &p, const BarrierProblem &b, double proximal);
  // In single precision where that is faster and was good enough so far.
  bool factorise(double gap);
  // Changes ds, dg for the right-hand sides rhs, h. Where single precision does not do, the matrix is factorised again;
  // false when that fails.
  bool solve(const double *rhs, double h, double *ds, double *dg);

  // y / c of every row.
  const std::vector<double> &weight() const { return weight_; }
  size_t coupled() const { return coupled_.size(); }

 private:
  void choose_coupled(const Packing &p, const BarrierProblem &b);

  NewtonSystem &system_;
  MixedFactor factor_;
  const int threads_;
  size_t ordered_rows_ = 0;      // at the last elimination order; 0: none for this list
  std::vector<size_t> coupled_;  // rows in the matrix, ascending
  PairList pairs_;
  std::vector<double> a_, strain_, coupled_weight_, weight_, diagonal_;
};

}  // namespace jam::inside
