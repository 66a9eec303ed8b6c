#include "analysis/factor.hpp"

#include <Eigen/SparseCholesky>
#include "core/error.hpp"

namespace jam {

struct ShiftedFactor::Impl {
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> llt;
  bool analysed = false;
};

ShiftedFactor::ShiftedFactor(const BlockMatrix &m) : m_(m), impl_(new Impl) {}

ShiftedFactor::~ShiftedFactor() = default;

bool ShiftedFactor::factorise(double shift) {
  shift_ = shift;
  const CsrMatrix csr = to_csr(m_);
  const auto n = static_cast<Eigen::Index>(m_.rows());
  const Eigen::SparseMatrix<double> a = Eigen::Map<const Eigen::SparseMatrix<double>>(
      n, n, static_cast<Eigen::Index>(csr.value.size()), csr.start.data(), csr.column.data(), csr.value.data());
  if (!impl_->analysed) impl_->llt.analyzePattern(a);
  impl_->analysed = true;
  impl_->llt.setShift(shift);
  impl_->llt.factorize(a);
  return impl_->llt.info() == Eigen::Success;
}

void ShiftedFactor::factorise_from(double start) {
  const double bound = 2.0 * m_.norm_bound() + start;
  for (double shift = start; shift < 10.0 * bound; shift *= 10.0)
    if (factorise(shift)) return;
  fail(JAM_E_SOLVER, "the matrix is not positive definite even with a shift of %g", bound);
}

void ShiftedFactor::solve_many(double *x, int count) const {
  Eigen::Map<Eigen::MatrixXd> b(x, static_cast<Eigen::Index>(m_.rows()), count);
  b = impl_->llt.solve(b).eval();
}

}  // namespace jam
