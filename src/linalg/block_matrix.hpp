// Symmetric sparse matrices of d x d blocks on the graph of the spheres.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace jam::inside {

// Symmetric, d x d blocks: diag (nodes), off (edges) with rows of ei and columns of ej, ei < ej, sorted, no
// edge twice (two contacts of the same pair of spheres are summed).
struct BlockMatrix {
  int dim = 3;
  int32_t nodes = 0;
  std::vector<int32_t> ei, ej;
  std::vector<double> diag, off;
  size_t rows() const { return static_cast<size_t>(nodes) * dim; }
  // y = A x
  void multiply(const double *x, double *y) const;
  void add_to_diagonal(double shift);
  // A bound on the largest |eigenvalue| (Gershgorin).
  double norm_bound() const;
};

struct CsrMatrix {
  std::vector<int32_t> start, column;  // rows + 1, entries; columns ascending in a row
  std::vector<double> value;
};
// Entries that are exactly zero inside a block are kept, so that the pattern does not depend on the values.
CsrMatrix to_csr(const BlockMatrix &m);
size_t csr_entries(const BlockMatrix &m);  // JAM_E_ARGUMENT above the largest int32

// Takes the mean of x (nodes, dim) along these axes (bits) away: the exact projection on no net translation.
void remove_translation(int dim, int32_t nodes, double *x, uint32_t axes = ~0u);

// Products with the sparse matrix whose row k has a_k on sphere i[k] and -a_k on sphere j[k]; j < 0: a wall, no column.

// out[k] = a_k . (s_i - s_j); a (rows, dim), s (n, dim), out (rows)
inline void rows_times(int dim, const std::vector<int32_t> &i, const std::vector<int32_t> &j, const double *a,
                       const double *s, double *out) {
  for (size_t k = 0; k < i.size(); ++k) {
    const double *si = s + static_cast<size_t>(i[k]) * dim, *row = a + k * dim;
    double sum = 0.0;
    if (j[k] < 0) {
      for (int c = 0; c < dim; ++c) sum += row[c] * si[c];
    } else {
      const double *sj = s + static_cast<size_t>(j[k]) * dim;
      for (int c = 0; c < dim; ++c) sum += row[c] * (si[c] - sj[c]);
    }
    out[k] = sum;
  }
}

// out = sum_k y_k a_k on i, minus on j; y (rows), out (n, dim)
inline void transpose_times(int dim, int32_t n, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                            const double *a, const double *y, double *out) {
  std::fill(out, out + static_cast<size_t>(n) * dim, 0.0);
  for (size_t k = 0; k < i.size(); ++k) {
    double *oi = out + static_cast<size_t>(i[k]) * dim;
    const double *row = a + k * dim;
    if (j[k] < 0) {
      for (int c = 0; c < dim; ++c) oi[c] += y[k] * row[c];
      continue;
    }
    double *oj = out + static_cast<size_t>(j[k]) * dim;
    for (int c = 0; c < dim; ++c) {
      const double v = y[k] * row[c];
      oi[c] += v;
      oj[c] -= v;
    }
  }
}

// Columns b (rows, count) of further unknowns e: out[k] += b_k . e
inline void add_columns_times(const double *b, size_t count, size_t rows, const double *e, double *out) {
  for (size_t k = 0; count > 0 && k < rows; ++k)
    for (size_t c = 0; c < count; ++c) out[k] += b[k * count + c] * e[c];
}

// out = sum_k y_k b_k; out (count)
inline void columns_transpose_times(const double *b, size_t count, size_t rows, const double *y, double *out) {
  std::fill(out, out + count, 0.0);
  for (size_t k = 0; count > 0 && k < rows; ++k)
    for (size_t c = 0; c < count; ++c) out[c] += b[k * count + c] * y[k];
}

}  // namespace jam::inside
