#include "network/self_stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "linalg/dot.hpp"
#include "network/rigidity_test.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

ContactWeights unit_weights(const RigidityMatrix &g) {
  ContactWeights w;
  w.stiffness.assign(g.contacts(), 1.0);
  return w;
}

// Gram-Schmidt, twice: x := component of x orthogonal to the vectors of q (count, size of x); returns its length over
// that of x.
double orthogonalise(const std::vector<double> &q, std::vector<double> &x) {
  const double before = norm(x);
  for (int twice = 0; twice < 2; ++twice)
    for (size_t v = 0; v < q.size(); v += x.size()) {
      const double along = dot(x, &q[v]);
      for (size_t k = 0; k < x.size(); ++k) x[k] -= along * q[v + k];
    }
  return before > 0.0 ? norm(x) / before : 0.0;
}

void scale_to_mean(std::vector<double> &f) {
  double mean = 0.0;
  for (double v : f) mean += v;
  mean /= static_cast<double>(f.size());
  if (mean != 0.0)
    for (double &v : f) v /= mean;
}

}  // namespace

NullSpace::NullSpace(const RigidityMatrix &g) : g_(g), solver_(g, unit_weights(g)) {}

int NullSpace::project(std::vector<double> &f, int refinements) const {
  std::vector<double> y(g_.unknowns()), s(g_.contacts()), best(f);
  double last = std::numeric_limits<double>::infinity();
  int solves = 0;
  for (int pass = 0; refinements < 0 || pass <= refinements; ++pass) {
    apply_equilibrium(g_, f.data(), y.data());
    const double residual = norm(y);
    if (!(residual < 0.5 * last)) {
      if (residual >= last) f = best;
      if (pass > 1) break;
    }
    last = residual;
    best = f;
    CallScope::report_share();
    solver_.apply(y.data(), 1);
    apply_compatibility(g_, y.data(), s.data());
    for (size_t k = 0; k < f.size(); ++k) f[k] -= s[k];
    ++solves;
  }
  return solves;
}

// The translations of every cluster are zero modes, and tied in the factorised matrix; what is left of its kernel is
// found by (shift / (H + shift))^4, which keeps it and divides a mode of eigenvalue lambda by (lambda / shift)^4. Block
// by block, until one brings a vector that is no new zero mode.
int64_t NullSpace::zero_modes() const {
  if (zeros_ >= 0) return zeros_;
  const size_t n = g_.unknowns();
  const double floor = undecided_eigenvalue * solver_.hessian().norm_bound();
  const ContactWeights w = unit_weights(g_);
  std::vector<double> kernel;
  size_t found = 0;
  Rng rng(2, Stream::analysis_start);
  for (bool more = true; more && found < most_zero_modes && found < n;) {
    const int block = static_cast<int>(std::min<size_t>(n - found, std::max<size_t>(2, found)));
    std::vector<double> x(n * block);
    for (double &v : x) v = rng.normal();
    for (int pass = 0; pass < 4; ++pass) {
      CallScope::report_share();
      solver_.apply(x.data(), block);
      for (double &v : x) v *= solver_.shift();
    }
    for (int b = 0; b < block; ++b) {
      std::vector<double> v(x.begin() + static_cast<std::ptrdiff_t>(n * b),
                            x.begin() + static_cast<std::ptrdiff_t>(n * (b + 1)));
      const double fresh = orthogonalise(kernel, v), length = norm(v);
      if (fresh < least_rest || length < least_rest) {
        more = false;
        continue;
      }
      for (double &q : v) q /= length;
      if (curvature(g_, w, v.data()) > floor) {
        more = false;
        continue;
      }
      kernel.insert(kernel.end(), v.begin(), v.end()), ++found;
    }
  }
  return zeros_ = static_cast<int64_t>(found) + solver_.springs();
}

int64_t NullSpace::dimension() const {
  return static_cast<int64_t>(g_.contacts()) - static_cast<int64_t>(g_.unknowns()) + zero_modes();
}

StressStates find_stress(const RigidityMatrix &g, bool with_basis) {
  return g.contacts() == 0 ? StressStates() : find_stress(g, NullSpace(g), with_basis);
}

StressStates find_stress(const RigidityMatrix &g, const NullSpace &space, bool with_basis) {
  StressStates out;
  const size_t m = g.contacts();
  const auto fresh = [&](uint64_t stream) {
    std::vector<double> w(m);
    Rng rng(3, Stream::analysis_start, stream << 32);
    for (double &v : w) v = rng.normal();
    return w;
  };
  out.force.assign(m, 1.0);
  space.project(out.force);
  // Fast way out, true for almost every packing: as many contacts as one state of self-stress has, and a random vector
  // projects on the same line as (1, 1, ...).
  const auto one = static_cast<int64_t>(g.unknowns()) - g.symmetries() + 1;
  if (static_cast<int64_t>(m) == one && norm(out.force) > least_rest * std::sqrt(static_cast<double>(m))) {
    std::vector<double> second = fresh(1), line = out.force;
    const double length = norm(second);
    space.project(second);
    const double scale = norm(line);
    for (double &v : line) v /= scale;
    orthogonalise(line, second);
    if (norm(second) < least_rest * length) {
      out.dimension = 1;
      out.zero_modes = g.symmetries();
    }
  }
  if (out.dimension != 1) {
    out.zero_modes = space.zero_modes();
    out.dimension = space.dimension();
    // Counting stopped: there are more zero modes, so more states than this.
    if (out.zero_modes >= NullSpace::most_zero_modes) out.dimension = std::max<int64_t>(out.dimension, 2);
  }
  if (out.dimension <= 0) {
    out.dimension = 0;
    out.force.assign(m, 0.0);
    return out;
  }
  if (out.dimension > 1) {
    // The middle of the non-negative states; without one what (1, 1, ...) projects on, whatever its signs.
    const RigidityResult test = test_rigidity(g, Jamming::collective);
    out.positive = test.stressed == Verdict::yes;
    if (out.positive) out.force = test.force;
  } else if (norm(out.force) <=
             RoundingTuning::sure * std::sqrt(static_cast<double>(m))) {  // orthogonal to (1, 1, ...): not of one sign
    out.force = fresh(2);
    space.project(out.force);
  }
  scale_to_mean(out.force);
  out.residual = balance_residual(g, out.force.data());
  out.min_force = *std::min_element(out.force.begin(), out.force.end());
  if (out.dimension == 1) out.positive = out.min_force > 0.0;
  if (with_basis) {
    const auto states = static_cast<uint64_t>(out.dimension);
    const std::string what = "a basis of " + std::to_string(states) + " states of self-stress would";
    CallScope::need_memory(8.0 * static_cast<double>(states) * static_cast<double>(m), what.c_str());
    out.basis.reserve(states * m);
    for (uint64_t k = 0; out.basis.size() < states * m && k < 4 * states + 8; ++k) {
      std::vector<double> v = k == 0 && out.positive ? out.force : fresh(10 + k);
      space.project(v);
      if (orthogonalise(out.basis, v) < least_rest) continue;
      const double length = norm(v);
      for (const double x : v) out.basis.push_back(x / length);
    }
  }
  return out;
}

int32_t count_clusters(const RigidityMatrix &g) {
  const std::vector<int32_t> root = parts_of(g);
  int32_t count = 0;
  for (int32_t i = 0; i < g.nodes; ++i) count += root[i] == i;
  return count;
}

GroundedSolver::GroundedSolver(const RigidityMatrix &g, const ContactWeights &w)
    : g_(g), h_(make_hessian(g, w)), tied_(h_), factor_(tied_) {
  const std::vector<int32_t> root = parts_of(g);
  if (const double norm = h_.norm_bound(); norm > 0.0) scale_ = norm;
  const size_t d = static_cast<size_t>(g.dim);
  std::vector<uint32_t> held(g.nodes, 0);  // axes along which walls push a cluster
  for (size_t k = 0; k < g.contacts(); ++k)
    for (size_t c = 0; c < d && g.b[k] < 0; ++c)
      if (g.normal[k * d + c] != 0.0) held[root[g.a[k]]] |= 1u << c;
  for (int32_t i = 0; i < g.nodes; ++i)
    if (root[i] == i)
      for (size_t c = 0; c < d; ++c) {
        if (held[i] >> c & 1) continue;
        ++springs_;
        tied_.diag[static_cast<size_t>(i) * d * d + c * d + c] += scale_;
      }
  factor_.factorise_from(1e-13 * scale_);
}

void GroundedSolver::solve(double *x, int count) const {
  const size_t n = g_.unknowns();
  for (int k = 0; k < count; ++k) g_.remove_symmetries(x + k * n);
  std::vector<double> b(x, x + n * count), r(n * count), y(n);
  factor_.solve_many(x, count);
  double last = std::numeric_limits<double>::infinity(), last_change = 0.0;
  for (int pass = 0;; ++pass) {
    double residual = 0.0;
    for (int k = 0; k < count; ++k) {
      h_.multiply(x + k * n, y.data());
      for (size_t q = 0; q < n; ++q) {
        r[k * n + q] = b[k * n + q] - y[q];
        residual = std::max(residual, std::fabs(r[k * n + q]));
      }
      g_.remove_symmetries(&r[k * n]);
    }
    if (residual == 0.0 || !(residual < 0.5 * last)) break;
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
