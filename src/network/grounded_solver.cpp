#include "network/grounded_solver.hpp"
#include "network/tuning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jam::inside {
namespace {
// Clusters of touching spheres by union-find; the representative is the smallest node.
std::vector<int32_t> cluster_roots(const RigidityMatrix &g) {
  std::vector<int32_t> root(g.nodes);
  for (int32_t i = 0; i < g.nodes; ++i) root[i] = i;
  auto find = [&](int32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (size_t k = 0; k < g.contacts(); ++k) {
    if (g.b[k] < 0) continue;
    const int32_t x = find(g.a[k]), y = find(g.b[k]);
    root[std::max(x, y)] = std::min(x, y);
  }
  for (int32_t i = 0; i < g.nodes; ++i) root[i] = find(i);
  return root;
}
}  // namespace

int32_t count_clusters(const RigidityMatrix &g) {
  const std::vector<int32_t> root = cluster_roots(g);
  int32_t count = 0;
  for (int32_t i = 0; i < g.nodes; ++i) count += root[i] == i;
  return count;
}

GroundedSolver::GroundedSolver(const RigidityMatrix &g, const ContactWeights &w)
    : g_(g), h_(make_hessian(g, w)), tied_(h_), factor_(tied_) {
  const std::vector<int32_t> root = cluster_roots(g);
  if (const double norm = h_.norm_bound(); norm > 0.0) scale_ = norm;
  const size_t d = static_cast<size_t>(g.dim);
  std::vector<uint32_t> held(g.nodes, 0);  // axes along which walls push a cluster
  for (size_t k = 0; k < g.contacts(); ++k)
    for (size_t c = 0; c < d && g.b[k] < 0; ++c)
      if (g.normal[k * d + c] != 0.0) held[root[g.a[k]]] |= 1u << c;
  for (int32_t i = 0; i < g.nodes; ++i)
    if (root[i] == i) {
      ++clusters_;
      for (size_t c = 0; c < d; ++c) {
        if (held[i] >> c & 1) continue;
        ++springs_;
        tied_.diag[static_cast<size_t>(i) * d * d + c * d + c] += GroundedTuning::spring * scale_;
      }
    }
  factor_.factorise_from(1e-13 * scale_);
}

void GroundedSolver::solve(double *x, int count) const {
  const size_t n = g_.unknowns();
  for (int k = 0; k < count; ++k) g_.remove_symmetries(x + k * n);
  std::vector<double> b(x, x + n * count), r(n * count), y(n);
  factor_.solve_many(x, count);
  double last = std::numeric_limits<double>::infinity(), last_change = 0.0;
  for (int pass = 0; pass < GroundedTuning::most_passes; ++pass) {
    double residual = 0.0;
    for (int k = 0; k < count; ++k) {
      h_.multiply(x + k * n, y.data());
      for (size_t q = 0; q < n; ++q) {
        r[k * n + q] = b[k * n + q] - y[q];
        residual = std::max(residual, std::fabs(r[k * n + q]));
      }
      g_.remove_symmetries(&r[k * n]);
    }
    if (residual == 0.0 || !(residual < GroundedTuning::slow * last)) break;
    last = residual;
    factor_.solve_many(r.data(), count);
    double change = 0.0, size = 0.0;
    for (size_t q = 0; q < r.size(); ++q) {
      change = std::max(change, std::fabs(r[q]));
      size = std::max(size, std::fabs(x[q] += r[q]));
    }
    // Changes fall by a constant ratio: the next one would be change * ratio.
    const double ratio = change / (pass == 0 ? size : last_change);
    last_change = change;
    if (!(change * ratio > 1e-14 * size)) break;
  }
  for (int k = 0; k < count; ++k) g_.remove_symmetries(x + k * n);
}

}  // namespace jam::inside
