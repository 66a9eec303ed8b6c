// Sparse Cholesky of a block matrix plus a multiple of the unit matrix.
#pragma once
#include <memory>
#include "linalg/block_cholesky.hpp"
#include "linalg/block_matrix.hpp"

namespace jam::inside {

class ShiftedFactor {
 public:
  explicit ShiftedFactor(const BlockMatrix &m);  // keeps a reference to m; its pattern is ordered once, its
                                                 // values are read again by every factorise
  ~ShiftedFactor();
  // Factorises m + shift; false when that is not positive definite.
  bool factorise(double shift);
  // The smallest shift of start * 10^k that gives a positive definite matrix; JAM_E_SOLVER past the norm of m.
  void factorise_from(double start);
  double shift() const { return shift_; }
  void solve(double *x) const { solve_many(x, 1); }  // x := (m + shift)^-1 x
  void solve_many(double *x, int count) const;       // count vectors one after the other
  size_t rows() const { return m_.rows(); }
  using Size = BlockCholesky::AbsoluteSize;
  Size size() const;

 private:
  struct Impl;
  const BlockMatrix &m_;
  std::unique_ptr<Impl> impl_;
  double shift_ = 0.0;
};

}  // namespace jam::inside
