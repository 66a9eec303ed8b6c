// Sparse Cholesky on d x d particle blocks. For now carried by Eigen's simplicial factorisation.
#pragma once
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <cstdint>
#include <vector>

namespace jam {

class BlockCholesky {
 public:
  // n nodes with d x d blocks, undirected edges (ei[k], ej[k]).
  void analyse(int dim, int32_t n, const int32_t *ei, const int32_t *ej, size_t edges, int /*threads*/ = 1) {
    dim_ = dim, n_ = n, ei_.assign(ei, ei + edges), ej_.assign(ej, ej + edges), analysed_ = false;
  }
  // diag: n blocks, off: one block an edge (rows of ei, columns of ej), row-major. Negative: not finite or indefinite.
  int factorise(const double *diag, const double *off) {
    std::vector<Eigen::Triplet<double>> t;
    const size_t b = static_cast<size_t>(dim_) * dim_;
    for (int i = 0; i < n_; ++i)
      for (int p = 0; p < dim_; ++p)
        for (int q = 0; q <= p; ++q) t.emplace_back(i * dim_ + p, i * dim_ + q, diag[i * b + p * dim_ + q]);
    for (size_t k = 0; k < ei_.size(); ++k)
      for (int p = 0; p < dim_; ++p)
        for (int q = 0; q < dim_; ++q) {
          const int r = ei_[k] * dim_ + p, c = ej_[k] * dim_ + q;
          t.emplace_back(std::max(r, c), std::min(r, c), off[k * b + p * dim_ + q]);
        }
    Eigen::SparseMatrix<double> m(n_ * dim_, n_ * dim_);
    m.setFromTriplets(t.begin(), t.end());
    if (!analysed_) factor_.analyzePattern(m), analysed_ = true;
    factor_.factorize(m);
    return factor_.info() == Eigen::Success ? 0 : -1;
  }
  void solve(double *x) const {
    Eigen::Map<Eigen::VectorXd> v(x, static_cast<Eigen::Index>(n_) * dim_);
    const Eigen::VectorXd r = factor_.solve(v);
    v = r;
  }
  void solve_many(double *x, int nrhs) const {
    for (int k = 0; k < nrhs; ++k) solve(x + static_cast<size_t>(k) * n_ * dim_);
  }

 private:
  int dim_ = 0, n_ = 0;
  std::vector<int32_t> ei_, ej_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  bool analysed_ = false;
};

}  // namespace jam
