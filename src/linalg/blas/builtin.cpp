// The routines of blas.hpp by our own loops, in the best instruction set of the processor.
#include "linalg/blas/routines.hpp"

namespace jam::inside {
namespace {
template <class Real>
const BlasRoutines<Real> &best() {
  static const BlasRoutines<Real> routines = blas_routines<Real>(InstructionSet::best);
  return routines;
}
}  // namespace

template <class Real>
void Blas<Real>::minus_product(int m, int n, int k, const Real *a, int lda, const Real *b, int ldb, Result result,
                               Real *c, int ldc) {
  best<Real>().minus_product(m, n, k, a, lda, b, ldb, result, c, ldc);
}
template <class Real>
void Blas<Real>::minus_square(int n, int k, const Real *b, int ldb, Result result, Real *c, int ldc) {
  best<Real>().minus_square(n, k, b, ldb, result, c, ldc);
}
template <class Real>
void Blas<Real>::divide(int m, int n, const Real *l, int ldl, Real *b, int ldb) {
  best<Real>().divide(m, n, l, ldl, b, ldb);
}
template <class Real>
void Blas<Real>::solve(int n, int count, const Real *l, int ldl, Real *x, int ldx) {
  best<Real>().solve(n, count, l, ldl, x, ldx);
}
template <class Real>
void Blas<Real>::solve_transposed(int n, int count, const Real *l, int ldl, Real *x, int ldx) {
  best<Real>().solve_transposed(n, count, l, ldl, x, ldx);
}
template <class Real>
void Blas<Real>::multiply(int m, int n, int count, const Real *a, int lda, const Real *x, int ldx, Real *y, int ldy) {
  best<Real>().multiply(m, n, count, a, lda, x, ldx, y, ldy);
}
template <class Real>
void Blas<Real>::subtract_transposed(int m, int n, int count, const Real *a, int lda, const Real *y, int ldy, Real *x,
                                     int ldx) {
  best<Real>().subtract_transposed(m, n, count, a, lda, y, ldy, x, ldx);
}
template struct Blas<double>;
template struct Blas<float>;

const char *blas_kernel() { return "builtin"; }

BlasThreads::BlasThreads(int wanted) : count_(wanted) {}

}  // namespace jam::inside
