// Products of a matrix with few vectors, and triangular solves: see loops.hpp.
#pragma once
#include <algorithm>
#include <cstddef>

#include "linalg/blas/vector.hpp"

namespace jam::inside {
namespace JAM_SIMD_NAMESPACE {

// Columns that a pass over vectors takes at once.
constexpr int together = 8;

// y -= (or +=) A x for `columns` <= 8 columns, m rows; from zero where the result is written.
template <int Bytes, int Columns, bool Minus, class Real>
JAM_SIMD_INLINE int add_columns(int i, int m, const Real *const *a, const Real *x, bool fresh, Real *y) {
  using V = Vector<Real, Bytes>;
  constexpr int width = Bytes / sizeof(Real);
  for (; i + width <= m; i += width) {
    V sum = fresh ? V{} : load<V>(y + i);
#pragma GCC unroll 8
    for (int k = 0; k < Columns; ++k) {
      const V product = load<V>(a[k] + i) * x[k];
      sum = Minus ? sum - product : sum + product;
    }
    store(y + i, sum);
  }
  return i;
}
template <int Columns, bool Minus, class Real>
JAM_SIMD_INLINE void add_columns(int m, const Real *a, int lda, const Real *x, bool fresh, Real *y) {
  const Real *column[Columns];
  for (int k = 0; k < Columns; ++k) column[k] = a + static_cast<size_t>(k) * lda;
  int i = add_columns<JAM_SIMD_BYTES, Columns, Minus>(0, m, column, x, fresh, y);
  i = add_columns<16, Columns, Minus>(i, m, column, x, fresh, y);
  for (; i < m; ++i) {
    Real sum = fresh ? 0 : y[i];
    for (int k = 0; k < Columns; ++k) sum = Minus ? sum - column[k][i] * x[k] : sum + column[k][i] * x[k];
    y[i] = sum;
  }
}
template <bool Minus, class Real>
JAM_SIMD_INLINE void add_columns(int columns, int m, const Real *a, int lda, const Real *x, bool fresh, Real *y) {
  if (columns == together) return add_columns<together, Minus>(m, a, lda, x, fresh, y);
  int k = 0;
  if (columns & 4) add_columns<4, Minus>(m, a, lda, x, fresh, y), k += 4, fresh = false;
  if (columns & 2)
    add_columns<2, Minus>(m, a + static_cast<size_t>(k) * lda, lda, x + k, fresh, y), k += 2, fresh = false;
  if (columns & 1) add_columns<1, Minus>(m, a + static_cast<size_t>(k) * lda, lda, x + k, fresh, y);
}

template <class Real>
JAM_SIMD_TARGET void multiply(int m, int n, int count, const Real *a, int lda, const Real *x, int ldx, Real *y,
                              int ldy) {
  for (int k = 0; k < n; k += together)
    for (int r = 0; r < count; ++r)
      add_columns<false>(std::min(together, n - k), m, a + static_cast<size_t>(k) * lda, lda,
                         x + static_cast<size_t>(r) * ldx + k, k == 0, y + static_cast<size_t>(r) * ldy);
}

// x_k -= a_k . y for Columns columns. The sum has as many parts as 32 bytes hold numbers; part p holds the rows p, p +
// parts, ... The parts are added by halves.
template <int Columns, class Real>
JAM_SIMD_INLINE void subtract_dots(int m, const Real *a, int lda, const Real *y, Real *x) {
  constexpr int bytes = JAM_SIMD_BYTES < 32 ? JAM_SIMD_BYTES : 32, pieces = 32 / bytes, width = bytes / sizeof(Real),
                parts = 32 / sizeof(Real);
  using V = Vector<Real, bytes>;
  V sum[Columns][pieces] = {};
  int i = 0;
  for (; i + parts <= m; i += parts)
#pragma GCC unroll 4
    for (int p = 0; p < pieces; ++p) {
      const V factor = load<V>(y + i + p * width);
#pragma GCC unroll 4
      for (int k = 0; k < Columns; ++k) sum[k][p] += load<V>(a + static_cast<size_t>(k) * lda + i + p * width) * factor;
    }
  for (int k = 0; k < Columns; ++k) {
    Real part[parts];
    for (int p = 0; p < pieces; ++p) store(part + p * width, sum[k][p]);
    const Real *const column = a + static_cast<size_t>(k) * lda + i;
    for (int p = 0; p < m - i; ++p) part[p] += column[p] * y[i + p];
#pragma GCC unroll 4
    for (int half = parts / 2; half > 0; half /= 2)
#pragma GCC unroll 4
      for (int p = 0; p < half; ++p) part[p] += part[p + half];
    x[k] -= part[0];
  }
}
template <class Real>
JAM_SIMD_INLINE void subtract_dots(int columns, int m, const Real *a, int lda, const Real *y, Real *x) {
  int k = 0;
  for (; k + 4 <= columns; k += 4) subtract_dots<4>(m, a + static_cast<size_t>(k) * lda, lda, y, x + k);
  for (; k < columns; ++k) subtract_dots<1>(m, a + static_cast<size_t>(k) * lda, lda, y, x + k);
}

template <class Real>
JAM_SIMD_TARGET void subtract_transposed(int m, int n, int count, const Real *a, int lda, const Real *y, int ldy,
                                         Real *x, int ldx) {
  for (int k = 0; k < n; k += together)
    for (int r = 0; r < count; ++r)
      subtract_dots(std::min(together, n - k), m, a + static_cast<size_t>(k) * lda, lda,
                    y + static_cast<size_t>(r) * ldy, x + static_cast<size_t>(r) * ldx + k);
}

template <class Real>
JAM_SIMD_TARGET void solve(int n, int count, const Real *l, int ldl, Real *x, int ldx) {
  for (int k = 0; k < n; k += together) {
    const int columns = std::min(together, n - k);
    const Real *const top = l + static_cast<size_t>(k) * ldl + k;
    for (int r = 0; r < count; ++r) {
      Real *const y = x + static_cast<size_t>(r) * ldx + k;
      for (int j = 0; j < columns; ++j) {
        const Real *const column = top + static_cast<size_t>(j) * ldl;
        y[j] /= column[j];
        for (int i = j + 1; i < columns; ++i) y[i] -= column[i] * y[j];
      }
      add_columns<true>(columns, n - k - columns, top + columns, ldl, y, false, y + columns);
    }
  }
}

template <class Real>
JAM_SIMD_TARGET void solve_transposed(int n, int count, const Real *l, int ldl, Real *x, int ldx) {
  for (int k = (n - 1) / together * together; k >= 0; k -= together) {
    const int columns = std::min(together, n - k);
    const Real *const top = l + static_cast<size_t>(k) * ldl + k;
    for (int r = 0; r < count; ++r) {
      Real *const y = x + static_cast<size_t>(r) * ldx + k;
      subtract_dots(columns, n - k - columns, top + columns, ldl, y + columns, y);
      for (int j = columns - 1; j >= 0; --j) {
        y[j] /= top[static_cast<size_t>(j) * ldl + j];
        for (int i = 0; i < j; ++i) y[i] -= top[static_cast<size_t>(i) * ldl + j] * y[j];
      }
    }
  }
}

}  // namespace JAM_SIMD_NAMESPACE
}  // namespace jam::inside
