#include "network/constraint_rows.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "linalg/dot.hpp"
#include "network/tuning.hpp"

namespace jam::inside {

std::vector<double> traceless_basis(int d, uint32_t axes) {
  std::vector<double> b;
  std::vector<int> open;
  for (int c = 0; c < d; ++c)
    if (axes >> c & 1u) open.push_back(c);
  const int count = static_cast<int>(open.size());
  const auto next = [&] { return b.insert(b.end(), static_cast<size_t>(d) * d, 0.0); };
  for (int k = 1; k < count; ++k) {  // diag(1, ..., 1, -k, 0, ...): k ones
    const auto m = next();
    const double scale = 1.0 / std::sqrt(static_cast<double>(k) * (k + 1));
    for (int c = 0; c < k; ++c) m[open[c] * (d + 1)] = scale;
    m[open[k] * (d + 1)] = -k * scale;
  }
  for (int r = 0; r < count; ++r)
    for (int c = r + 1; c < count; ++c) {
      const auto m = next();
      m[open[r] * d + open[c]] = m[open[c] * d + open[r]] = std::sqrt(0.5);
    }
  return b;
}

ConstraintRows::ConstraintRows(const RigidityMatrix &matrix, bool with_strain) : g(matrix) {
  if (!with_strain || g.contacts() == 0) return;
  const int d = g.dim;
  length = 0.0;
  for (const double r : g.distance) length += r / static_cast<double>(g.contacts());
  const std::vector<double> basis = traceless_basis(d, g.open_axes);
  strains = traceless_strains(d, g.open_axes);
  e.reserve(g.contacts() * strains);
  for (size_t k = 0; k < g.contacts(); ++k) {
    const double *n = &g.normal[k * d];
    for (int q = 0; q < strains; ++q) {
      double sum = 0.0;
      for (int r = 0; r < d; ++r)
        for (int c = 0; c < d; ++c) sum += basis[(static_cast<size_t>(q) * d + r) * d + c] * n[r] * n[c];
      e.push_back(sum * g.distance[k] / length);
    }
  }
}

void ConstraintRows::multiply(const double *x, double *y) const {
  apply_compatibility(g, x, y);
  const double *strain = x + g.unknowns();
  for (size_t k = 0; k < rows() && strains > 0; ++k)
    for (int q = 0; q < strains; ++q) y[k] += e[k * strains + q] * strain[q];
}

void ConstraintRows::transpose(const double *f, double *y) const {
  apply_equilibrium(g, f, y);
  double *strain = y + g.unknowns();
  std::fill(strain, strain + strains, 0.0);
  for (size_t k = 0; k < rows() && strains > 0; ++k)
    for (int q = 0; q < strains; ++q) strain[q] += e[k * strains + q] * f[k];
}

std::vector<double> ConstraintRows::strain_of(const double *x) const {
  const size_t dd = static_cast<size_t>(g.dim) * g.dim;
  std::vector<double> out(dd, 0.0);
  const std::vector<double> basis = traceless_basis(g.dim, g.open_axes);
  for (int q = 0; q < strains; ++q)
    for (size_t r = 0; r < dd; ++r) out[r] += basis[q * dd + r] * x[g.unknowns() + q] / length;
  return out;
}

struct NormalSolver::Border {
  std::vector<double> coupling, response;  // W = S^T D E and H^-1 W, (strains, unknowns)
  Eigen::LDLT<Eigen::MatrixXd> schur;
};

NormalSolver::NormalSolver(const ConstraintRows &rows) : rows_(rows) {}
NormalSolver::~NormalSolver() = default;

void NormalSolver::factorise(const std::vector<double> &weight, double start) {
  const ContactWeights w{weight, {}};
  h_ = make_hessian(rows_.g, w);
  if (!factor_) factor_ = std::make_unique<ShiftedFactor>(h_);
  factor_->factorise_from(start);
  const int q = rows_.strains;
  if (q == 0) return;
  const size_t n = rows_.g.unknowns(), m = rows_.rows();
  border_ = std::make_unique<Border>();
  border_->coupling.resize(n * q);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(q, q);
  std::vector<double> column(m);
  for (int s = 0; s < q; ++s) {
    for (size_t k = 0; k < m; ++k) column[k] = weight[k] * rows_.e[k * q + s];
    apply_equilibrium(rows_.g, column.data(), &border_->coupling[n * s]);
    for (int t = 0; t <= s; ++t)
      for (size_t k = 0; k < m; ++k) c(s, t) += column[k] * rows_.e[k * q + t];
  }
  border_->response = border_->coupling;
  factor_->solve_many(border_->response.data(), q);
  for (int s = 0; s < q; ++s)
    for (int t = 0; t <= s; ++t) {
      for (size_t k = 0; k < n; ++k) c(s, t) -= border_->coupling[n * s + k] * border_->response[n * t + k];
      if (s == t) c(s, s) = std::max(c(s, s), 0.0) + factor_->shift();  // rounding must not make it negative
      c(t, s) = c(s, t);
    }
  border_->schur.compute(c);
}

void NormalSolver::solve(double *x, int count) const {
  const size_t n = rows_.g.unknowns();
  const int q = rows_.strains;
  if (q == 0) return factor_->solve_many(x, count);
  Eigen::VectorXd strain(q);
  for (int b = 0; b < count; ++b) {
    double *v = x + static_cast<size_t>(b) * (n + q);
    factor_->solve_many(v, 1);
    for (int s = 0; s < q; ++s) {
      strain[s] = v[n + s];
      for (size_t k = 0; k < n; ++k) strain[s] -= border_->coupling[n * s + k] * v[k];
    }
    strain = border_->schur.solve(strain).eval();
    for (int s = 0; s < q; ++s) {
      v[n + s] = strain[s];
      for (size_t k = 0; k < n; ++k) v[k] -= strain[s] * border_->response[n * s + k];
    }
  }
}

void project_on_balance(const ConstraintRows &rows, const NormalSolver &solver, std::vector<double> &f) {
  std::vector<double> y(rows.columns()), s(rows.rows()), best(f);
  double last = std::numeric_limits<double>::infinity();
  for (int pass = 0;; ++pass) {
    rows.transpose(f.data(), y.data());
    const double residual = norm(y);
    if (!(residual < last)) {
      f = best;
      return;
    }
    const bool slow = residual > 0.5 * last;
    last = residual, best = f;
    if (slow && pass > 1) return;
    CallScope::report_share();
    solver.solve(y.data());
    rows.multiply(y.data(), s.data());
    for (size_t k = 0; k < f.size(); ++k) f[k] -= s[k];
  }
}

std::vector<double> nearest_motion(const ConstraintRows &rows, const NormalSolver &solver,
                                   const std::vector<double> &y) {
  std::vector<double> x(rows.columns(), 0.0), g(rows.columns()), s(rows.rows()), r(y);
  double last = std::numeric_limits<double>::infinity();
  for (;;) {
    rows.transpose(r.data(), g.data());
    const double residual = norm(g);
    if (!(residual < 0.5 * last)) break;
    last = residual;
    CallScope::report_share();
    solver.solve(g.data());
    for (size_t k = 0; k < x.size(); ++k) x[k] += g[k];
    rows.multiply(x.data(), s.data());
    for (size_t k = 0; k < r.size(); ++k) r[k] = y[k] - s[k];
  }
  return x;
}

}  // namespace jam::inside
