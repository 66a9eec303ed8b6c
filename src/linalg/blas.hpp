// The few BLAS routines libjam calls, and the rule that they run on one thread inside it.
#pragma once

namespace jam {

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

// The same routines by the type of their numbers.
template <class Real>
struct Blas;
template <>
struct Blas<double> {
  static constexpr auto trsm = dtrsm_;
  static constexpr auto syrk = dsyrk_;
  static constexpr auto gemm = dgemm_;
  static constexpr auto gemv = dgemv_;
  static constexpr auto trsv = dtrsv_;
};
template <>
struct Blas<float> {
  static constexpr auto trsm = strsm_;
  static constexpr auto syrk = ssyrk_;
  static constexpr auto gemm = sgemm_;
  static constexpr auto gemv = sgemv_;
  static constexpr auto trsv = strsv_;
};

// Name of the kernel in use: the bits of sums depend on it. The file of the library where it is not OpenBLAS.
const char *blas_kernel();

// While at least one lives, OpenBLAS runs single-threaded whatever the host set: blocks are small, libjam brings its
// own threads, and the bits must not depend on the host. OpenBLAS keeps that number per process, so this is the one
// place where libjam touches process-wide state; the last one out puts the host's number back.
// threads: of libjam that call BLAS side by side. Throws std::bad_alloc where OpenBLAS would find no memory for them.
class BlasSingleThread {
 public:
  explicit BlasSingleThread(int threads = 1);
  ~BlasSingleThread();
  BlasSingleThread(const BlasSingleThread &) = delete;
  BlasSingleThread &operator=(const BlasSingleThread &) = delete;

 private:
  const int more_;  // than guards around this one have counted
};

}  // namespace jam
