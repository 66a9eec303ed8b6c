#include "linalg/dense_front.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/blas.hpp"
#include "linalg/tuning.hpp"

namespace jam::inside {
namespace {

template <class Real>
constexpr Real huge_pivot = Real(sizeof(Real) == sizeof(double) ? 1e64 : 1e15);  // the square root of what replaces it
constexpr int narrow = SupernodeTuning::narrow;

// Unblocked Cholesky of the leading columns of a small block; returns the number of replaced pivots.
template <class Real>
int factor_small(Real *a, int lda, int columns, const Real *original, const PivotRule &rule) {
  int replaced = 0;
  for (int j = 0; j < columns; ++j) {
    Real *cj = a + static_cast<size_t>(j) * lda;
    const auto bound = static_cast<Real>(std::max(rule.relative * original[j], rule.floor));
    Real pivot = cj[j];
    if (pivot > bound) {
      pivot = std::sqrt(pivot);
    } else if (std::isfinite(pivot)) {  // else it stays and factorise() finds it
      pivot = rule.raise && bound > 0 ? std::sqrt(bound) : huge_pivot<Real>;
      ++replaced;
    }
    cj[j] = pivot;
    const Real inverse = 1 / pivot;
    for (int i = j + 1; i < columns; ++i) cj[i] *= inverse;
    for (int k = j + 1; k < columns; ++k) {
      Real *ck = a + static_cast<size_t>(k) * lda;
      const Real f = cj[k];
      for (int i = k; i < columns; ++i) ck[i] -= f * cj[i];
    }
  }
  return replaced;
}

// C: -B B_top^T on and below the diagonal of the first `columns` columns of C; B has as many rows as C.
template <class Real>
void minus_trapezoid(Real *c, int ldc, int rows, int columns, const Real *b, int ldb, int k, Result result) {
  if (columns == 0) return;
  Blas<Real>::minus_square(columns, k, b, ldb, result, c, ldc);
  const int rest = rows - columns;
  if (rest > 0) Blas<Real>::minus_product(rest, columns, k, b + columns, ldb, b, ldb, result, c + columns, ldc);
}

double area_of(int rows, int columns) { return columns * (rows - 0.5 * columns); }

// The same in parts of equal area.
template <class Real>
void minus_trapezoid_by(Workers &workers, Real *c, int ldc, int rows, int columns, const Real *b, int ldb, int k,
                        Result result) {
  const double area = area_of(rows, columns), square = static_cast<double>(rows) * rows;
  const int parts = workers.parts(area * k, ThreadTuning::product);
  const auto cut = [&](int part) {
    return part == parts ? columns : static_cast<int>(rows - std::sqrt(square - 2.0 * area * part / parts));
  };
  workers.run(parts, [&](int part, int) {
    const int first = cut(part), last = cut(part + 1);
    minus_trapezoid(c + static_cast<size_t>(first) * ldc + first, ldc, rows - first, last - first, b + first, ldb, k,
                    result);
  });
}

template <class Real>
void minus_trapezoid(Real *c, int ldc, int rows, int columns, const Real *b, int ldb, int k, Result result,
                     Workers &workers) {
  const auto work = [&] { minus_trapezoid_by(workers, c, ldc, rows, columns, b, ldb, k, result); };
  if (area_of(rows, columns) * k < ThreadTuning::long_product) return work();
  report_while(work);
}

// work(first, count) for the parts of 0 .. size.
template <class Work>
void in_parts(Workers &workers, int parts, int size, const Work &work) {
  const auto cut = [&](int part) { return static_cast<int>(static_cast<int64_t>(size) * part / parts); };
  workers.run(parts, [&](int part, int) {
    const int first = cut(part), count = cut(part + 1) - first;
    if (count > 0) work(first, count);
  });
}

// B := B L^-T.
template <class Real>
void divide_by_top(const Real *top, int ld, int rows, int columns, Real *b, Workers &workers) {
  const int parts = workers.parts(static_cast<double>(rows) * columns * columns, ThreadTuning::product);
  in_parts(workers, parts, rows,
           [&](int first, int count) { Blas<Real>::divide(count, columns, top, ld, b + first, ld); });
}

}  // namespace

// Halves of columns, so that most of the work is products of wide blocks.
template <class Real>
int factor_panel(Real *panel, int ld, int rows, int columns, const Real *original, const PivotRule &rule,
                 Workers &workers) {
  if (columns <= narrow) {
    const int replaced = factor_small(panel, ld, columns, original, rule);
    divide_by_top(panel, ld, rows - columns, columns, panel + columns, workers);
    CallScope::look();
    return replaced;
  }
  const int left = (columns / 2 + narrow - 1) / narrow * narrow;
  const int replaced = factor_panel(panel, ld, rows, left, original, rule, workers);
  Real *trailing = panel + static_cast<size_t>(left) * ld + left;
  minus_trapezoid(trailing, ld, rows - left, columns - left, panel + left, ld, left, Result::added, workers);
  return replaced + factor_panel(trailing, ld, rows - left, columns - left, original + left, rule, workers);
}

template <class Real>
void minus_square(Real *c, int n, const Real *b, int ldb, int k, Workers &workers) {
  if (n > 0 && k > 0) minus_trapezoid(c, n, n, n, b, ldb, k, Result::written, workers);
}

template <class Real>
void panel_forward(const Real *panel, int ld, int rows, int columns, Real *top, int ldt, Real *below, int ldb, int nrhs,
                   Workers &workers) {
  Blas<Real>::solve(columns, nrhs, panel, ld, top, ldt);
  const int parts = workers.parts(static_cast<double>(rows) * columns, ThreadTuning::vector);
  in_parts(workers, parts, rows, [&](int first, int count) {
    Blas<Real>::multiply(count, columns, nrhs, panel + columns + first, ld, top, ldt, below + first, ldb);
  });
}

template <class Real>
void panel_backward(const Real *panel, int ld, int rows, int columns, Real *top, int ldt, const Real *below, int ldb,
                    int nrhs, Workers &workers) {
  const int parts = workers.parts(static_cast<double>(rows) * columns, ThreadTuning::vector);
  in_parts(workers, rows > 0 ? parts : 0, columns, [&](int first, int count) {
    Blas<Real>::subtract_transposed(rows, count, nrhs, panel + static_cast<size_t>(first) * ld + columns, ld, below,
                                    ldb, top + first, ldt);
  });
  Blas<Real>::solve_transposed(columns, nrhs, panel, ld, top, ldt);
}

template int factor_panel(double *, int, int, int, const double *, const PivotRule &, Workers &);
template int factor_panel(float *, int, int, int, const float *, const PivotRule &, Workers &);
template void minus_square(double *, int, const double *, int, int, Workers &);
template void minus_square(float *, int, const float *, int, int, Workers &);
template void panel_forward(const double *, int, int, int, double *, int, double *, int, int, Workers &);
template void panel_forward(const float *, int, int, int, float *, int, float *, int, int, Workers &);
template void panel_backward(const double *, int, int, int, double *, int, const double *, int, int, Workers &);
template void panel_backward(const float *, int, int, int, float *, int, const float *, int, int, Workers &);

}  // namespace jam::inside
