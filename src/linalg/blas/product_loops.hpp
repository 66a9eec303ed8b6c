// Products of two matrices, and of a matrix with an inverse triangle: see loops.hpp.
#pragma once
#include <algorithm>
#include <cstddef>

#include "linalg/blas.hpp"
#include "linalg/blas/vector.hpp"

namespace jam::inside {
namespace JAM_SIMD_NAMESPACE {

// A tile of a product stays in registers. Factors are copied so that a tile reads them one after the other: `depth`
// columns at a time, of `wide` rows of B, which stay in the second cache.
template <class Real>
struct Tile {
  static constexpr int width = JAM_SIMD_BYTES / static_cast<int>(sizeof(Real)), vectors = 3, rows = vectors * width,
                       columns = JAM_SIMD_COLUMNS, depth = 2048 / static_cast<int>(sizeof(Real)), wide = 512;
};

// Copies rows x k numbers to columns `height` apart, which are filled up with zeros.
template <class Real>
JAM_SIMD_INLINE void pack(const Real *from, int ld, int rows, int k, int height, Real *to) {
  using Half = Vector<Real, 16>;
  constexpr int half = 16 / sizeof(Real);
  for (; k > 0; --k, from += ld, to += height) {
    int i = 0;
    for (; i + half <= rows; i += half) store(to + i, load<Half>(from + i));
    for (; i < rows; ++i) to[i] = from[i];
    for (; i < height; ++i) to[i] = 0;
  }
}

// C (V vectors x N columns) with the products of packed A and B subtracted.
template <int V, int N, class Real>
JAM_SIMD_INLINE void tile(int k, const Real *a, const Real *b, Result result, Real *c, ptrdiff_t ldc) {
  using T = Tile<Real>;
  Vector<Real> sum[N][V];
#pragma GCC unroll 16
  for (int j = 0; j < N; ++j)
#pragma GCC unroll 4
    for (int v = 0; v < V; ++v)
      sum[j][v] = result == Result::added ? load<Vector<Real>>(c + j * ldc + v * T::width) : Vector<Real>{};
  for (; k > 0; --k, a += T::rows, b += T::columns) {
    Vector<Real> x[V];
#pragma GCC unroll 4
    for (int v = 0; v < V; ++v) x[v] = load<Vector<Real>>(a + v * T::width);
#pragma GCC unroll 16
    for (int j = 0; j < N; ++j)
#pragma GCC unroll 4
      for (int v = 0; v < V; ++v) sum[j][v] -= x[v] * b[j];
  }
#pragma GCC unroll 16
  for (int j = 0; j < N; ++j)
#pragma GCC unroll 4
    for (int v = 0; v < V; ++v) store(c + j * ldc + v * T::width, sum[j][v]);
}

template <class Real>
using TileFunction = void (*)(int k, const Real *a, const Real *b, Result result, Real *c, ptrdiff_t ldc);
template <int V, int N, class Real>
JAM_SIMD_TARGET void tile_of(int k, const Real *a, const Real *b, Result result, Real *c, ptrdiff_t ldc) {
  tile<V, N>(k, a, b, result, c, ldc);
}

// A tile of rows x columns numbers; where `below` is not null, only its numbers with row >= column + *below are
// changed.
template <class Real>
JAM_SIMD_TARGET void tile_at(int rows, int columns, int k, const Real *a, const Real *b, Result result, Real *c,
                             int ldc, const int *below) {
  using T = Tile<Real>;
  constexpr int half = T::columns / 2;
  static constexpr TileFunction<Real> function[2][3] = {
      {tile_of<1, half, Real>, tile_of<2, half, Real>, tile_of<3, half, Real>},
      {tile_of<1, T::columns, Real>, tile_of<2, T::columns, Real>, tile_of<3, T::columns, Real>}};
  const int vectors = (rows + T::width - 1) / T::width;
  const bool full = columns > half;
  const auto compute = function[full][vectors - 1];
  if (!below && rows == vectors * T::width && columns == (full ? T::columns : half))
    return compute(k, a, b, result, c, ldc);
  alignas(64) Real copy[T::rows * T::columns] = {};
  const auto at = [=](int j) { return c + static_cast<ptrdiff_t>(j) * ldc; };
  const auto first = [=](int j) { return below ? std::min(rows, std::max(0, j + *below)) : 0; };
  if (result == Result::added)
    for (int j = 0; j < columns; ++j) std::copy(at(j) + first(j), at(j) + rows, copy + j * T::rows + first(j));
  compute(k, a, b, result, copy, T::rows);
  for (int j = 0; j < columns; ++j)
    std::copy(copy + j * T::rows + first(j), copy + j * T::rows + rows, at(j) + first(j));
}

// C := -A B^T; lower: on and below the diagonal alone.
template <class Real>
JAM_SIMD_TARGET void product(bool lower, int m, int n, int k, const Real *a, int lda, const Real *b, int ldb,
                             Result result, Real *c, int ldc) {
  using T = Tile<Real>;
  const int deepest = std::min(k, T::depth), widest = (std::min(n, T::wide) + T::columns - 1) / T::columns * T::columns;
  const std::unique_ptr<Real[]> room(new Real[static_cast<size_t>(deepest) * (T::rows + widest)]);
  Real *const packed_b = room.get(), *const packed_a = packed_b + static_cast<size_t>(deepest) * widest;
  for (int k0 = 0; k0 < k; k0 += T::depth, result = Result::added) {
    const int depth = std::min(T::depth, k - k0);
    for (int j0 = 0; j0 < n; j0 += T::wide) {
      const int end = std::min(n, j0 + T::wide);
      for (int j = j0; j < end; j += T::columns)
        pack(b + static_cast<size_t>(k0) * ldb + j, ldb, std::min(T::columns, end - j), depth, T::columns,
             packed_b + static_cast<size_t>(j - j0) * depth);
      for (int i = lower ? j0 : 0; i < m; i += T::rows) {
        const int rows = std::min(T::rows, m - i);
        pack(a + static_cast<size_t>(k0) * lda + i, lda, rows, depth, T::rows, packed_a);
        for (int j = j0; j < end && !(lower && i + rows <= j); j += T::columns) {
          const int columns = std::min(T::columns, end - j), diagonal = j - i;
          tile_at(rows, columns, depth, packed_a, packed_b + static_cast<size_t>(j - j0) * depth, result,
                  c + static_cast<size_t>(j) * ldc + i, ldc, lower && i < j + columns - 1 ? &diagonal : nullptr);
        }
      }
    }
  }
}

template <class Real>
JAM_SIMD_TARGET void minus_product(int m, int n, int k, const Real *a, int lda, const Real *b, int ldb, Result result,
                                   Real *c, int ldc) {
  product(false, m, n, k, a, lda, b, ldb, result, c, ldc);
}
template <class Real>
JAM_SIMD_TARGET void minus_square(int n, int k, const Real *b, int ldb, Result result, Real *c, int ldc) {
  product(true, n, n, k, b, ldb, b, ldb, result, c, ldc);
}

// The last step of a tile of B L^-T: its own columns, with 1 / L_jj in place of L_jj.
template <class Real>
JAM_SIMD_INLINE void divide_tile(int vectors, int columns, const Real *l, Real *b) {
  using T = Tile<Real>;
  for (int v = 0; v < vectors; ++v) {
    Real *const at = b + v * T::width;
    for (int j = 0; j < columns; ++j) {
      Vector<Real> x = load<Vector<Real>>(at + j * T::rows);
      for (int k = 0; k < j; ++k) x -= load<Vector<Real>>(at + k * T::rows) * l[k * T::columns + j];
      store(at + j * T::rows, x * l[j * T::columns + j]);
    }
  }
}

template <class Real>
JAM_SIMD_TARGET void divide(int m, int n, const Real *l, int ldl, Real *b, int ldb) {
  using T = Tile<Real>;
  const size_t tiles = (n + T::columns - 1) / T::columns, strip = static_cast<size_t>(n) * T::columns;
  const std::unique_ptr<Real[]> room(new Real[tiles * strip + tiles * T::columns * T::rows]);
  Real *const packed_l = room.get(), *const packed_b = packed_l + tiles * strip;
  for (int j = 0; j < n; j += T::columns) {
    const int columns = std::min(T::columns, n - j);
    Real *const to = packed_l + j / T::columns * strip;
    pack(l + j, ldl, columns, j + columns, T::columns, to);
    for (int k = j; k < j + columns; ++k) to[k * T::columns + k - j] = 1 / to[k * T::columns + k - j];
  }
  for (int i = 0; i < m; i += T::rows) {
    const int rows = std::min(T::rows, m - i), vectors = (rows + T::width - 1) / T::width;
    pack(b + i, ldb, rows, n, T::rows, packed_b);
    for (int j = 0; j < n; j += T::columns) {
      const int columns = std::min(T::columns, n - j);
      const Real *const from = packed_l + j / T::columns * strip;
      Real *const to = packed_b + static_cast<size_t>(j) * T::rows;
      if (j > 0) tile_at(vectors * T::width, columns, j, packed_b, from, Result::added, to, T::rows, nullptr);
      divide_tile(vectors, columns, from + static_cast<size_t>(j) * T::columns, to);
    }
    for (int j = 0; j < n; ++j)
      std::copy(packed_b + static_cast<size_t>(j) * T::rows, packed_b + static_cast<size_t>(j) * T::rows + rows,
                b + static_cast<size_t>(j) * ldb + i);
  }
}

}  // namespace JAM_SIMD_NAMESPACE
}  // namespace jam::inside
