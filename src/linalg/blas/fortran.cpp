// The routines of blas.hpp by a BLAS library with Fortran's interface: OpenBLAS, or any other (JAM_BLAS).
#include "linalg/blas.hpp"

extern "C" {
void dtrsm_(const char *side, const char *uplo, const char *trans, const char *diag, const int *m, const int *n,
            const double *alpha, const double *a, const int *lda, double *b, const int *ldb);
void dsyrk_(const char *uplo, const char *trans, const int *n, const int *k, const double *alpha, const double *a,
            const int *lda, const double *beta, double *c, const int *ldc);
void dgemm_(const char *ta, const char *tb, const int *m, const int *n, const int *k, const double *alpha,
            const double *a, const int *lda, const double *b, const int *ldb, const double *beta, double *c,
            const int *ldc);
void dgemv_(const char *trans, const int *m, const int *n, const double *alpha, const double *a, const int *lda,
            const double *x, const int *incx, const double *beta, double *y, const int *incy);
void dtrsv_(const char *uplo, const char *trans, const char *diag, const int *n, const double *a, const int *lda,
            double *x, const int *incx);
void strsm_(const char *side, const char *uplo, const char *trans, const char *diag, const int *m, const int *n,
            const float *alpha, const float *a, const int *lda, float *b, const int *ldb);
void ssyrk_(const char *uplo, const char *trans, const int *n, const int *k, const float *alpha, const float *a,
            const int *lda, const float *beta, float *c, const int *ldc);
void sgemm_(const char *ta, const char *tb, const int *m, const int *n, const int *k, const float *alpha,
            const float *a, const int *lda, const float *b, const int *ldb, const float *beta, float *c,
            const int *ldc);
void sgemv_(const char *trans, const int *m, const int *n, const float *alpha, const float *a, const int *lda,
            const float *x, const int *incx, const float *beta, float *y, const int *incy);
void strsv_(const char *uplo, const char *trans, const char *diag, const int *n, const float *a, const int *lda,
            float *x, const int *incx);
}

namespace jam::inside {
namespace {
template <class Real>
struct Fortran;
template <>
struct Fortran<double> {
  static constexpr auto trsm = dtrsm_;
  static constexpr auto syrk = dsyrk_;
  static constexpr auto gemm = dgemm_;
  static constexpr auto gemv = dgemv_;
  static constexpr auto trsv = dtrsv_;
};
template <>
struct Fortran<float> {
  static constexpr auto trsm = strsm_;
  static constexpr auto syrk = ssyrk_;
  static constexpr auto gemm = sgemm_;
  static constexpr auto gemv = sgemv_;
  static constexpr auto trsv = strsv_;
};
template <class Real>
constexpr Real one = 1;
template <class Real>
constexpr Real minus_one = -1;
template <class Real>
constexpr Real zero = 0;
constexpr int step = 1;
template <class Real>
const Real *factor_of(Result result) {
  return result == Result::added ? &one<Real> : &zero<Real>;
}
template <class Real>
void solve_any(const char *trans, int n, int count, const Real *l, int ldl, Real *x, int ldx) {
  if (count == 1)
    Fortran<Real>::trsv("L", trans, "N", &n, l, &ldl, x, &step);
  else
    Fortran<Real>::trsm("L", "L", trans, "N", &n, &count, &one<Real>, l, &ldl, x, &ldx);
}

}  // namespace

template <class Real>
void Blas<Real>::minus_product(int m, int n, int k, const Real *a, int lda, const Real *b, int ldb, Result result,
                               Real *c, int ldc) {
  Fortran<Real>::gemm("N", "T", &m, &n, &k, &minus_one<Real>, a, &lda, b, &ldb, factor_of<Real>(result), c, &ldc);
}
template <class Real>
void Blas<Real>::minus_square(int n, int k, const Real *b, int ldb, Result result, Real *c, int ldc) {
  Fortran<Real>::syrk("L", "N", &n, &k, &minus_one<Real>, b, &ldb, factor_of<Real>(result), c, &ldc);
}
template <class Real>
void Blas<Real>::divide(int m, int n, const Real *l, int ldl, Real *b, int ldb) {
  Fortran<Real>::trsm("R", "L", "T", "N", &m, &n, &one<Real>, l, &ldl, b, &ldb);
}
template <class Real>
void Blas<Real>::solve(int n, int count, const Real *l, int ldl, Real *x, int ldx) {
  solve_any("N", n, count, l, ldl, x, ldx);
}
template <class Real>
void Blas<Real>::solve_transposed(int n, int count, const Real *l, int ldl, Real *x, int ldx) {
  solve_any("T", n, count, l, ldl, x, ldx);
}
template <class Real>
void Blas<Real>::multiply(int m, int n, int count, const Real *a, int lda, const Real *x, int ldx, Real *y, int ldy) {
  if (count == 1)
    Fortran<Real>::gemv("N", &m, &n, &one<Real>, a, &lda, x, &step, &zero<Real>, y, &step);
  else
    Fortran<Real>::gemm("N", "N", &m, &count, &n, &one<Real>, a, &lda, x, &ldx, &zero<Real>, y, &ldy);
}
template <class Real>
void Blas<Real>::subtract_transposed(int m, int n, int count, const Real *a, int lda, const Real *y, int ldy, Real *x,
                                     int ldx) {
  if (count == 1)
    Fortran<Real>::gemv("T", &m, &n, &minus_one<Real>, a, &lda, y, &step, &one<Real>, x, &step);
  else
    Fortran<Real>::gemm("T", "N", &n, &count, &m, &minus_one<Real>, a, &lda, y, &ldy, &one<Real>, x, &ldx);
}
template struct Blas<double>;
template struct Blas<float>;

const char *blas_kernel() { return library_kernel(); }

BlasThreads::BlasThreads(int wanted) {
  const auto guard = std::make_shared<const BlasSingleThread>(wanted);
  count_ = guard->threads();
  guard_ = guard;
}

}  // namespace jam::inside
