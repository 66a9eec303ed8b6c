// The full spectrum: Householder reduction, divide and conquer, back transformation (LAPACK). Reduction and
// back transformation go panel by panel, as dsytrd and dormtr do inside, so that they can be cancelled; dstedc is one
// call.
#include <algorithm>
#include <limits>
#include "analysis/modes.hpp"
#include "core/error.hpp"
#include "linalg/blas.hpp"

extern "C" {
void dlatrd_(const char *uplo, const int *n, const int *nb, double *a, const int *lda, double *e, double *tau,
             double *w, const int *ldw);
void dsyr2k_(const char *uplo, const char *trans, const int *n, const int *k, const double *alpha, const double *a,
             const int *lda, const double *b, const int *ldb, const double *beta, double *c, const int *ldc);
void dsytd2_(const char *uplo, const int *n, double *a, const int *lda, double *d, double *e, double *tau, int *info);
void dstedc_(const char *compz, const int *n, double *d, double *e, double *z, const int *ldz, double *work,
             const int *lwork, int *iwork, const int *liwork, int *info);
void dormtr_(const char *side, const char *uplo, const char *trans, const int *m, const int *n, const double *a,
             const int *lda, const double *tau, double *c, const int *ldc, double *work, const int *lwork, int *info);
}

namespace jam::inside {
namespace {

// Lower triangle of a to tridiagonal form d, e; reflectors stay in a and tau. False when stopped.
bool tridiagonalise(int n, std::vector<double> &a, double *d, double *e, double *tau,
                    const std::function<bool(double)> &stop) {
  const int panel = DenseTuning::panel;
  const double one = 1.0, minus_one = -1.0;
  std::vector<double> w = lapack_array(static_cast<size_t>(n) * panel);
  const auto at = [&](int row, int column) { return &a[static_cast<size_t>(column) * n + row]; };
  int k = 0;
  for (; k + 2 * panel < n; k += panel) {
    const double left = 1.0 - static_cast<double>(k) / n;
    if (stop(DenseTuning::lapack_reduction * (1.0 - left * left * left))) return false;
    const int rest = n - k, below = rest - panel;
    dlatrd_("L", &rest, &panel, at(k, k), &n, e + k, tau + k, w.data(), &rest);
    dsyr2k_("L", "N", &below, &panel, &minus_one, at(k + panel, k), &n, &w[panel], &rest, &one,
            at(k + panel, k + panel), &n);
    for (int j = k; j < k + panel; ++j) d[j] = *at(j, j);
  }
  const int rest = n - k;
  int info = 0;
  dsytd2_("L", &rest, at(k, k), &n, d + k, e + k, tau + k, &info);
  return true;
}

}  // namespace

bool dense_eigen(int n, std::vector<double> &a, std::vector<double> &lambda, const std::function<bool(double)> &stop) {
  const double numbers = 1.0 + 4.0 * n + static_cast<double>(n) * n;  // that dstedc works with
  if (numbers > std::numeric_limits<int>::max()) return dense_eigen_builtin(n, a, lambda, true, stop);
  const BlasSingleThread single;
  lambda = lapack_array(static_cast<size_t>(n));
  if (n == 0) return true;
  const size_t less = static_cast<size_t>(std::max(1, n - 1));
  std::vector<double> e = lapack_array(less), tau = lapack_array(less);
  std::vector<double> work = lapack_array(static_cast<size_t>(n) * 64 + 16);
  int lwork = static_cast<int>(work.size()), info = 0;
  if (stop(0.0) || !tridiagonalise(n, a, lambda.data(), e.data(), tau.data(), stop) ||
      stop(DenseTuning::lapack_reduction))
    return false;
  std::vector<double> z = lapack_array(static_cast<size_t>(n) * n);
  {
    double size = 0.0;
    int isize = 0;
    const int query = -1;
    dstedc_("I", &n, lambda.data(), e.data(), z.data(), &n, &size, &query, &isize, &query, &info);
    const int lw = static_cast<int>(size), li = isize;
    std::vector<double> w = lapack_array(static_cast<size_t>(std::max(1, lw)));
    std::vector<int> iw(std::max(1, li));
    dstedc_("I", &n, lambda.data(), e.data(), z.data(), &n, w.data(), &lw, iw.data(), &li, &info);
  }
  if (info != 0) fail(JAM_E_SOLVER, "dstedc gave info %d: the spectrum did not converge", info);
  for (int first = 0; first < n; first += DenseTuning::back_columns) {
    if (stop(1.0 - DenseTuning::lapack_vectors * (n - first) / n)) return false;
    const int columns = std::min(DenseTuning::back_columns, n - first);
    dormtr_("L", "L", "N", &n, &columns, a.data(), &n, tau.data(), &z[static_cast<size_t>(first) * n], &n, work.data(),
            &lwork, &info);
    if (info != 0) fail(JAM_E_SOLVER, "dormtr gave info %d", info);
  }
  a.swap(z);
  return true;
}

}  // namespace jam::inside
