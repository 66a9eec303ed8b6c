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
}

// Name of the kernel in use: the bits of sums depend on it.
const char *blas_kernel();

// While at least one lives, OpenBLAS runs single-threaded whatever the host set: blocks are small, libjam brings its
// own threads, and the bits must not depend on the host. OpenBLAS keeps that number per process, so this is the one
// place where libjam touches process-wide state; the last one out puts the host's number back.
class BlasSingleThread {
 public:
  BlasSingleThread();
  ~BlasSingleThread();
  BlasSingleThread(const BlasSingleThread &) = delete;
  BlasSingleThread &operator=(const BlasSingleThread &) = delete;
};

}  // namespace jam
