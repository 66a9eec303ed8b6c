// The full spectrum: Householder reduction, divide and conquer, back transformation (LAPACK by OpenBLAS), in
// three calls instead of dsyevd so that cancelling works between them.
#include <algorithm>
#include <cmath>
#include "analysis/modes.hpp"
#include "core/error.hpp"

extern "C" {
void dsytrd_(const char *uplo, const int *n, double *a, const int *lda, double *d, double *e, double *tau, double *work,
             const int *lwork, int *info);
void dstedc_(const char *compz, const int *n, double *d, double *e, double *z, const int *ldz, double *work, const int *lwork,
             int *iwork, const int *liwork, int *info);
void dsterf_(const int *n, double *d, double *e, int *info);
void dormtr_(const char *side, const char *uplo, const char *trans, const int *m, const int *n, const double *a, const int *lda,
             const double *tau, double *c, const int *ldc, double *work, const int *lwork, int *info);
}

namespace jam {

bool dense_eigen(int n, std::vector<double> &a, std::vector<double> &lambda, bool vectors, const std::function<bool(double)> &stop) {
  lambda.assign(n, 0.0);
  if (n == 0) return true;
  std::vector<double> e(std::max(1, n - 1)), tau(std::max(1, n - 1));
  std::vector<double> work(static_cast<size_t>(n) * 64 + 16);
  int lwork = static_cast<int>(work.size()), info = 0;
  if (stop(0.0)) return false;
  dsytrd_("L", &n, a.data(), &n, lambda.data(), e.data(), tau.data(), work.data(), &lwork, &info);
  if (info != 0) fail(JAM_E_SOLVER, "dsytrd gave info %d", info);
  if (stop(0.5)) return false;
  if (!vectors) {
    dsterf_(&n, lambda.data(), e.data(), &info);
    if (info != 0) fail(JAM_E_SOLVER, "dsterf gave info %d: the spectrum did not converge", info);
    return true;
  }
  std::vector<double> z(static_cast<size_t>(n) * n);
  {
    double size = 0.0;
    int isize = 0;
    const int query = -1;
    dstedc_("I", &n, lambda.data(), e.data(), z.data(), &n, &size, &query, &isize, &query, &info);
    const int lw = static_cast<int>(size), li = isize;
    std::vector<double> w(static_cast<size_t>(std::max(1, lw)));
    std::vector<int> iw(std::max(1, li));
    dstedc_("I", &n, lambda.data(), e.data(), z.data(), &n, w.data(), &lw, iw.data(), &li, &info);
  }
  if (info != 0) fail(JAM_E_SOLVER, "dstedc gave info %d: the spectrum did not converge", info);
  if (stop(0.75)) return false;
  dormtr_("L", "L", "N", &n, &n, a.data(), &n, tau.data(), z.data(), &n, work.data(), &lwork, &info);
  if (info != 0) fail(JAM_E_SOLVER, "dormtr gave info %d", info);
  a.swap(z);
  return true;
}

double inverse_participation(int dim, int32_t nodes, const double *v) {
  double two = 0.0, four = 0.0;
  for (int32_t i = 0; i < nodes; ++i) {
    double s = 0.0;
    for (int c = 0; c < dim; ++c) s += v[static_cast<size_t>(i) * dim + c] * v[static_cast<size_t>(i) * dim + c];
    two += s;
    four += s * s;
  }
  return two > 0.0 ? four / (two * two) : 0.0;
}

}  // namespace jam
