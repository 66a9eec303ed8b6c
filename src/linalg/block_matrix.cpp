#include "linalg/block_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace jam::inside {

void BlockMatrix::multiply(const double *x, double *y) const {
  const int d = dim, dd = d * d;
  for (int32_t i = 0; i < nodes; ++i)
    for (int r = 0; r < d; ++r) {
      double s = 0.0;
      for (int c = 0; c < d; ++c)
        s += diag[static_cast<size_t>(i) * dd + r * d + c] * x[static_cast<size_t>(i) * d + c];
      y[static_cast<size_t>(i) * d + r] = s;
    }
  for (size_t e = 0; e < ei.size(); ++e) {
    const double *b = &off[e * dd], *xi = x + static_cast<size_t>(ei[e]) * d, *xj = x + static_cast<size_t>(ej[e]) * d;
    double *yi = y + static_cast<size_t>(ei[e]) * d, *yj = y + static_cast<size_t>(ej[e]) * d;
    for (int r = 0; r < d; ++r)
      for (int c = 0; c < d; ++c) {
        yi[r] += b[r * d + c] * xj[c];
        yj[c] += b[r * d + c] * xi[r];
      }
  }
}

void BlockMatrix::add_to_diagonal(double shift) {
  for (size_t i = 0; i < static_cast<size_t>(nodes); ++i)
    for (int c = 0; c < dim; ++c) diag[i * dim * dim + c * dim + c] += shift;
}

double BlockMatrix::norm_bound() const {
  const int d = dim, dd = d * d;
  std::vector<double> row(rows(), 0.0);
  for (size_t q = 0; q < rows(); ++q)
    for (int c = 0; c < d; ++c) row[q] += std::fabs(diag[q * d + c]);
  for (size_t e = 0; e < ei.size(); ++e)
    for (int r = 0; r < d; ++r)
      for (int c = 0; c < d; ++c) {
        row[static_cast<size_t>(ei[e]) * d + r] += std::fabs(off[e * dd + r * d + c]);
        row[static_cast<size_t>(ej[e]) * d + c] += std::fabs(off[e * dd + r * d + c]);
      }
  return row.empty() ? 0.0 : *std::max_element(row.begin(), row.end());
}

size_t csr_entries(const BlockMatrix &m) {
  const size_t blocks = static_cast<size_t>(m.nodes) + 2 * m.ei.size(), entries = blocks * m.dim * m.dim;
  if (entries > 0x7fffffff)
    fail(JAM_E_ARGUMENT, "the matrix has %zu entries, more than int32 indices can count", entries);
  return entries;
}

CsrMatrix to_csr(const BlockMatrix &m) {
  const int d = m.dim, dd = d * d;
  const size_t n = m.nodes, entries = csr_entries(m);
  // Block rows: edges are sorted by (ei, ej), so lower neighbours come ascending first, then the diagonal.
  std::vector<std::vector<std::pair<int32_t, int64_t>>> row(n);
  for (size_t e = 0; e < m.ei.size(); ++e) row[m.ej[e]].push_back({m.ei[e], -static_cast<int64_t>(e) - 1});
  for (size_t i = 0; i < n; ++i) row[i].push_back({static_cast<int32_t>(i), INT64_MAX});
  for (size_t e = 0; e < m.ei.size(); ++e) row[m.ei[e]].push_back({m.ej[e], static_cast<int64_t>(e)});
  CsrMatrix csr;
  csr.column.reserve(entries), csr.value.reserve(entries);
  csr.start.push_back(0);
  for (size_t i = 0; i < n; ++i)
    for (int r = 0; r < d; ++r) {
      for (const auto &[j, e] : row[i])
        for (int c = 0; c < d; ++c) {
          csr.column.push_back(j * d + c);
          csr.value.push_back(e == INT64_MAX ? m.diag[i * dd + r * d + c]
                              : e >= 0       ? m.off[e * dd + r * d + c]
                                             : m.off[(-e - 1) * dd + c * d + r]);
        }
      csr.start.push_back(static_cast<int32_t>(csr.column.size()));
    }
  return csr;
}

void remove_translation(int dim, int32_t nodes, double *x, uint32_t axes) {
  if (nodes == 0) return;
  for (int c = 0; c < dim; ++c) {
    if (!(axes >> c & 1)) continue;
    double mean = 0.0;
    for (int32_t i = 0; i < nodes; ++i) mean += x[static_cast<size_t>(i) * dim + c];
    mean /= nodes;
    for (int32_t i = 0; i < nodes; ++i) x[static_cast<size_t>(i) * dim + c] -= mean;
  }
}

}  // namespace jam::inside
