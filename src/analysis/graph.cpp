#include "analysis/graph.hpp"

#include <algorithm>
#include <cmath>
#include "core/error.hpp"

namespace jam {

StableGraph make_graph(const Packing &p, const ContactNetwork &network) {
  StableGraph g;
  const int d = g.dim = p.dim;
  g.node.assign(p.n(), -1);
  for (size_t k = 0; k < network.size(); ++k) g.node[network.pairs.i[k]] = g.node[network.pairs.j[k]] = 0;
  for (size_t i = 0; i < p.n(); ++i)
    if (g.node[i] == 0) {
      g.node[i] = g.nodes++;
      g.sphere.push_back(static_cast<int32_t>(i));
    }
  std::vector<double> r(d);
  for (size_t k = 0; k < network.size(); ++k) {
    const int32_t i = network.pairs.i[k], j = network.pairs.j[k];
    g.a.push_back(g.node[i]);
    g.b.push_back(g.node[j]);
    g.distance.push_back(std::sqrt(pair_vector(p, network.pairs, k, r.data())));
    g.sigma.push_back(0.5 * (p.diameter[i] + p.diameter[j]));
    for (int c = 0; c < d; ++c) g.normal.push_back(r[c] / g.distance.back());
  }
  g.force = network.force;
  return g;
}

void stretch(const StableGraph &g, const double *x, double *y) {
  const int d = g.dim;
  for (size_t k = 0; k < g.contacts(); ++k) {
    const double *n = &g.normal[k * d], *u = x + static_cast<size_t>(g.a[k]) * d,
                 *v = x + static_cast<size_t>(g.b[k]) * d;
    double s = 0.0;
    for (int c = 0; c < d; ++c) s += n[c] * (u[c] - v[c]);
    y[k] = s;
  }
}

void balance(const StableGraph &g, const double *f, double *y) {
  const int d = g.dim;
  std::fill(y, y + g.unknowns(), 0.0);
  for (size_t k = 0; k < g.contacts(); ++k) {
    const double *n = &g.normal[k * d];
    double *u = y + static_cast<size_t>(g.a[k]) * d, *v = y + static_cast<size_t>(g.b[k]) * d;
    for (int c = 0; c < d; ++c) {
      u[c] += f[k] * n[c];
      v[c] -= f[k] * n[c];
    }
  }
}

double balance_residual(const StableGraph &g, const double *f) {
  std::vector<double> y(g.unknowns());
  balance(g, f, y.data());
  double worst = 0.0, mean = 0.0;
  for (int32_t i = 0; i < g.nodes; ++i) {
    double s = 0.0;
    for (int c = 0; c < g.dim; ++c) s += y[i * g.dim + c] * y[i * g.dim + c];
    worst = std::max(worst, s);
  }
  for (size_t k = 0; k < g.contacts(); ++k) mean += std::fabs(f[k]);
  mean /= static_cast<double>(g.contacts());
  return mean > 0.0 ? std::sqrt(worst) / mean : 0.0;
}

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

CsrMatrix to_csr(const BlockMatrix &m) {
  const int d = m.dim, dd = d * d;
  const size_t n = m.nodes, blocks = n + 2 * m.ei.size();
  if (blocks * dd > 0x7fffffff)
    fail(JAM_E_ARGUMENT, "the matrix has %zu entries, more than int32 indices can count", blocks * dd);
  // Block rows: edges are sorted by (ei, ej), so lower neighbours come ascending first, then the diagonal.
  std::vector<std::vector<std::pair<int32_t, int64_t>>> row(n);
  for (size_t e = 0; e < m.ei.size(); ++e) row[m.ej[e]].push_back({m.ei[e], -static_cast<int64_t>(e) - 1});
  for (size_t i = 0; i < n; ++i) row[i].push_back({static_cast<int32_t>(i), INT64_MAX});
  for (size_t e = 0; e < m.ei.size(); ++e) row[m.ei[e]].push_back({m.ej[e], static_cast<int64_t>(e)});
  CsrMatrix csr;
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

void remove_translation(int dim, int32_t nodes, double *x) {
  if (nodes == 0) return;
  for (int c = 0; c < dim; ++c) {
    double mean = 0.0;
    for (int32_t i = 0; i < nodes; ++i) mean += x[static_cast<size_t>(i) * dim + c];
    mean /= nodes;
    for (int32_t i = 0; i < nodes; ++i) x[static_cast<size_t>(i) * dim + c] -= mean;
  }
}

}  // namespace jam
