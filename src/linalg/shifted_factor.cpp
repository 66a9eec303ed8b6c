#include "linalg/shifted_factor.hpp"

#include <cmath>

#include "core/error.hpp"

namespace jam::inside {

struct ShiftedFactor::Impl {
  BlockCholesky cholesky;
  bool analysed = false;
};

ShiftedFactor::ShiftedFactor(const BlockMatrix &m) : m_(m), impl_(new Impl) {}

ShiftedFactor::~ShiftedFactor() = default;

bool ShiftedFactor::factorise(double shift) {
  shift_ = shift;
  if (!impl_->analysed) impl_->cholesky.analyse(m_.dim, m_.nodes, m_.ei.data(), m_.ej.data(), m_.ei.size());
  impl_->analysed = true;
  std::vector<double> diag(m_.diag);
  const size_t d = static_cast<size_t>(m_.dim);
  for (size_t i = 0; i < static_cast<size_t>(m_.nodes); ++i)
    for (size_t c = 0; c < d; ++c) diag[i * d * d + c * d + c] += shift;
  return impl_->cholesky.factorise(diag.data(), m_.off.data()) == 0;  // no pivot was replaced: positive definite
}

void ShiftedFactor::factorise_from(double start) {
  const double bound = 2.0 * m_.norm_bound() + start;
  if (!std::isfinite(bound)) fail(JAM_E_SOLVER, "the matrix has entries that are not finite");
  for (double shift = start; shift < 10.0 * bound; shift *= 10.0)
    if (factorise(shift)) return;
  fail(JAM_E_SOLVER, "the matrix is not positive definite even with a shift of %g", bound);
}

ShiftedFactor::Size ShiftedFactor::size() const { return impl_->cholesky.absolute_size(); }

void ShiftedFactor::solve_many(double *x, int count) const { impl_->cholesky.solve_many(x, count); }

}  // namespace jam::inside
