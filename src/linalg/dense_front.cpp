#include "linalg/dense_front.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/call_scope.hpp"
#include "linalg/blas.hpp"
#include "linalg/two_threads.hpp"

namespace jam {
namespace {

constexpr double one = 1.0, minus_one = -1.0, zero = 0.0;
constexpr int inc = 1;
constexpr double huge_pivot = 1e64;  // the square root of what replaces it
constexpr int narrow = 48;           // columns that are factored without splitting them
// Fewer multiplications than this are done before a second thread has started; a product of a vector is as slow as
// memory.
constexpr double worth_a_thread = 1e7, worth_a_reader = 1e6;
// Longer products, in multiplications, take some 0.1 s: callbacks are told meanwhile.
constexpr double worth_telling = 2e9;

// Unblocked Cholesky of the leading columns of a small block; returns the number of replaced pivots.
int factor_small(double *a, int lda, int columns, const double *original, const PivotRule &rule) {
  int replaced = 0;
  for (int j = 0; j < columns; ++j) {
    double *cj = a + static_cast<size_t>(j) * lda;
    double pivot = cj[j];
    if (pivot > std::max(rule.relative * original[j], rule.floor)) {
      pivot = std::sqrt(pivot);
    } else if (std::isfinite(pivot)) {  // else it stays and factorise() finds it
      pivot = huge_pivot;
      ++replaced;
    }
    cj[j] = pivot;
    const double inverse = 1.0 / pivot;
    for (int i = j + 1; i < columns; ++i) cj[i] *= inverse;
    for (int k = j + 1; k < columns; ++k) {
      double *ck = a + static_cast<size_t>(k) * lda;
      const double f = cj[k];
      for (int i = k; i < columns; ++i) ck[i] -= f * cj[i];
    }
  }
  return replaced;
}

// C = beta C - B B_top^T on and below the diagonal of the first `columns` columns of C; B has as many rows as C.
void minus_trapezoid(double *c, int ldc, int rows, int columns, const double *b, int ldb, int k, const double &beta) {
  if (columns == 0) return;
  dsyrk_("L", "N", &columns, &k, &minus_one, b, &ldb, &beta, c, &ldc);
  const int rest = rows - columns;
  if (rest > 0) dgemm_("N", "T", &rest, &columns, &k, &minus_one, b + columns, &ldb, b, &ldb, &beta, c + columns, &ldc);
}

double area_of(int rows, int columns) { return columns * (rows - 0.5 * columns); }

// The same, on two threads when it is worth it: columns are split where the two areas are even.
void minus_trapezoid_on(int threads, double *c, int ldc, int rows, int columns, const double *b, int ldb, int k,
                        const double &beta) {
  const double area = area_of(rows, columns);
  if (threads < 2 || area * k < worth_a_thread) return minus_trapezoid(c, ldc, rows, columns, b, ldb, k, beta);
  const int cut = static_cast<int>(rows - std::sqrt(static_cast<double>(rows) * rows - area));
  on_two_threads([&](int part) {
    if (part == 0)
      minus_trapezoid(c, ldc, rows, cut, b, ldb, k, beta);
    else
      minus_trapezoid(c + static_cast<size_t>(cut) * ldc + cut, ldc, rows - cut, columns - cut, b + cut, ldb, k, beta);
  });
}

void minus_trapezoid(double *c, int ldc, int rows, int columns, const double *b, int ldb, int k, const double &beta,
                     int threads) {
  const auto work = [&] { minus_trapezoid_on(threads, c, ldc, rows, columns, b, ldb, k, beta); };
  if (area_of(rows, columns) * k < worth_telling) return work();
  while_telling(work);
}

// B := B L^-T.
void divide_by_top(const double *top, int ld, int rows, int columns, double *b, int threads) {
  if (rows == 0) return;
  if (threads < 2 || static_cast<double>(rows) * columns * columns < worth_a_thread) {
    dtrsm_("R", "L", "T", "N", &rows, &columns, &one, top, &ld, b, &ld);
    return;
  }
  const int half = rows / 2, rest = rows - half;
  on_two_threads([&](int part) {
    dtrsm_("R", "L", "T", "N", part ? &rest : &half, &columns, &one, top, &ld, part ? b + half : b, &ld);
  });
}

// The triangle on top of a panel, forward ("N") or backward ("T").
void solve_top(const double *panel, int ld, int columns, double *x, int ldx, int nrhs, const char *trans) {
  if (nrhs == 1)
    dtrsv_("L", trans, "N", &columns, panel, &ld, x, &inc);
  else
    dtrsm_("L", "L", trans, "N", &columns, &nrhs, &one, panel, &ld, x, &ldx);
}

}  // namespace

// Halves of columns, so that most of the work is products of wide blocks.
int factor_panel(double *panel, int ld, int rows, int columns, const double *original, const PivotRule &rule,
                 int threads) {
  if (columns <= narrow) {
    const int replaced = factor_small(panel, ld, columns, original, rule);
    divide_by_top(panel, ld, rows - columns, columns, panel + columns, threads);
    CallScope::tell();
    return replaced;
  }
  const int left = (columns / 2 + narrow - 1) / narrow * narrow;
  const int replaced = factor_panel(panel, ld, rows, left, original, rule, threads);
  double *trailing = panel + static_cast<size_t>(left) * ld + left;
  minus_trapezoid(trailing, ld, rows - left, columns - left, panel + left, ld, left, one, threads);
  return replaced + factor_panel(trailing, ld, rows - left, columns - left, original + left, rule, threads);
}

void minus_square(double *c, int n, const double *b, int ldb, int k, int threads) {
  if (n > 0 && k > 0) minus_trapezoid(c, n, n, n, b, ldb, k, zero, threads);
}

void panel_forward(const double *panel, int ld, int rows, int columns, double *top, int ldt, double *below, int ldb,
                   int nrhs, int threads) {
  solve_top(panel, ld, columns, top, ldt, nrhs, "N");
  const auto multiply = [&](int first, int count) {
    const double *l = panel + columns + first;
    if (count == 0) return;
    if (nrhs == 1)
      dgemv_("N", &count, &columns, &one, l, &ld, top, &inc, &zero, below + first, &inc);
    else
      dgemm_("N", "N", &count, &nrhs, &columns, &one, l, &ld, top, &ldt, &zero, below + first, &ldb);
  };
  if (threads < 2 || static_cast<double>(rows) * columns < worth_a_reader) return multiply(0, rows);
  on_two_threads([&](int part) { part ? multiply(rows / 2, rows - rows / 2) : multiply(0, rows / 2); });
}

void panel_backward(const double *panel, int ld, int rows, int columns, double *top, int ldt, const double *below,
                    int ldb, int nrhs, int threads) {
  const auto multiply = [&](int first, int count) {
    const double *l = panel + static_cast<size_t>(first) * ld + columns;
    if (rows == 0 || count == 0) return;
    if (nrhs == 1)
      dgemv_("T", &rows, &count, &minus_one, l, &ld, below, &inc, &one, top + first, &inc);
    else
      dgemm_("T", "N", &count, &nrhs, &rows, &minus_one, l, &ld, below, &ldb, &one, top + first, &ldt);
  };
  if (threads < 2 || static_cast<double>(rows) * columns < worth_a_reader)
    multiply(0, columns);
  else
    on_two_threads([&](int part) { part ? multiply(columns / 2, columns - columns / 2) : multiply(0, columns / 2); });
  solve_top(panel, ld, columns, top, ldt, nrhs, "T");
}

}  // namespace jam
