// The dense products and triangular solves of the factorisation, by one of two files that CMake's JAM_BLAS chooses:
// blas/builtin.cpp has loops of its own, the default, blas/fortran.cpp calls a BLAS library. Matrices are stored by
// columns; ld: the distance of two columns. L is lower triangular, and what is above its diagonal is never read.
#pragma once
#include <memory>

namespace jam::inside {

// Whether a result is written, or added to what is there.
enum class Result : bool { written, added };

template <class Real>
struct Blas {
  // C, m x n: - A B^T, with A m x k and B n x k; all sizes > 0.
  static void minus_product(int m, int n, int k, const Real *a, int lda, const Real *b, int ldb, Result result, Real *c,
                            int ldc);
  // The same with A = B, on and below the diagonal alone.
  static void minus_square(int n, int k, const Real *b, int ldb, Result result, Real *c, int ldc);
  // B := B L^-T, with B m x n.
  static void divide(int m, int n, const Real *l, int ldl, Real *b, int ldb);
  // X := L^-1 X and X := L^-T X, with X n x count.
  static void solve(int n, int count, const Real *l, int ldl, Real *x, int ldx);
  static void solve_transposed(int n, int count, const Real *l, int ldl, Real *x, int ldx);
  // Y := A X, with A m x n and X n x count.
  static void multiply(int m, int n, int count, const Real *a, int lda, const Real *x, int ldx, Real *y, int ldy);
  // X := X - A^T Y, of the same shapes.
  static void subtract_transposed(int m, int n, int count, const Real *a, int lda, const Real *y, int ldy, Real *x,
                                  int ldx);
};

// "builtin" for our own loops, whose bits are the same on all processors; else the kernel of the library, on which the
// bits of sums depend (blas/single_thread.cpp).
const char *blas_kernel();

// Of the threads that a call requests, those that may compute products side by side while this lives: all of them by
// our own loops, perhaps fewer by a library (blas/single_thread.cpp).
class BlasThreads {
 public:
  explicit BlasThreads(int wanted);
  int count() const { return count_; }

 private:
  int count_;
  std::shared_ptr<const void> guard_;
};

// What a library of BLAS or LAPACK needs around it. Builds that call none do not compile this.

// Name of the kernel that OpenBLAS chose for this processor; the file of the library where it is not OpenBLAS.
const char *library_kernel();

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
  // How many of the threads that were requested may compute: fewer where other calls of the process compute too.
  int threads() const { return threads_; }

 private:
  int threads_;
  int more_;  // than guards around this one have counted
};

}  // namespace jam::inside
