#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/double_double.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "network/force_balance.hpp"
#include "network/stress_cone.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

using Tuning = CentralPathTuning;

double longest(const std::vector<double> &v, const std::vector<double> &dv) {
  double t = 1.0;
  for (size_t k = 0; k < v.size(); ++k)
    if (v[k] + t * dv[k] < 0.0) t = -v[k] / dv[k];
  return t;
}

}  // namespace

CentralPath::CentralPath(const ConstraintRows &rows)
    : rows_(rows), solver_(rows), x_(rows.columns(), 0.0), f_(rows.rows(), 1.0), w_(rows.rows(), 1.0) {}

bool CentralPath::step() {
  CallScope::report_share();
  const size_t m = f_.size();
  std::vector<double> weight(m);
  for (size_t k = 0; k < m; ++k) weight[k] = f_[k] / w_[k];
  solver_.factorise(weight, mu_);
  std::vector<double> df, dw, dx, correction(m, 0.0);
  direction(0.0, correction, df, dw, dx);
  const double reach = std::min(longest(f_, df), longest(w_, dw));
  const double target = mu_ * std::max(Tuning::least, math::pow(1.0 - reach, 2.0));
  for (size_t k = 0; k < m; ++k)
    correction[k] =
        std::max(-Tuning::most_down * target, std::min(Tuning::most_up * target, -reach * reach * df[k] * dw[k]));
  direction(target, correction, df, dw, dx);
  double length = std::min(1.0, Tuning::to_boundary * std::min(longest(f_, df), longest(w_, dw)));
  while (length > Tuning::least && worst_product(length, df, dw) < Tuning::least) length *= Tuning::shorter;
  for (size_t k = 0; k < m; ++k) f_[k] += length * df[k], w_[k] += length * dw[k];
  for (size_t k = 0; k < x_.size(); ++k) x_[k] += length * dx[k];
  const double before = mu_;
  mu_ += length * (target - mu_);
  ++steps_;
  return mu_ < (1.0 - Tuning::least) * before;
}

double CentralPath::worst_product(double t, const std::vector<double> &df, const std::vector<double> &dw) const {
  double least = std::numeric_limits<double>::infinity(), sum = 0.0;
  for (size_t k = 0; k < f_.size(); ++k) {
    const double product = (f_[k] + t * df[k]) * (w_[k] + t * dw[k]);
    least = std::min(least, product), sum += product;
  }
  return least * static_cast<double>(f_.size()) / sum;
}

// Newton towards mu: A^T (f + df) = mu x + mu_ dx, w + dw = A (x + dx) + mu, f w + w df + f dw = mu + correction.
void CentralPath::direction(double mu, const std::vector<double> &correction, std::vector<double> &df,
                            std::vector<double> &dw, std::vector<double> &dx) const {
  const size_t m = f_.size();
  std::vector<double> gap(m), g(m);
  rows_.multiply(x_.data(), gap.data());
  for (size_t k = 0; k < m; ++k) {
    gap[k] += mu - w_[k];
    g[k] = (mu + correction[k] - f_[k] * gap[k]) / w_[k];  // f + df without the part of A dx
  }
  dx.resize(x_.size());
  rows_.transpose(g.data(), dx.data());
  for (size_t k = 0; k < dx.size(); ++k) dx[k] -= mu * x_[k];
  solver_.solve(dx.data());
  dw.resize(m), df.resize(m);
  rows_.multiply(dx.data(), dw.data());
  for (size_t k = 0; k < m; ++k) {
    df[k] = g[k] - f_[k] / w_[k] * dw[k] - f_[k];
    dw[k] += gap[k];
  }
}

std::vector<double> relative_rows(const Packing &p, const ContactNetwork &net) {
  const double unit = diameter_mean(p);
  std::vector<double> a(net.vector);
  for (size_t k = 0; k < net.size(); ++k) {
    const double scale = unit / contact_distance(p, net.pairs.i[k], net.pairs.j[k]);
    for (int c = 0; c < p.dim; ++c) a[k * p.dim + c] *= scale;
  }
  return a;
}

void scale_to_mean(ContactNetwork &net) {
  double mean = 0.0;
  for (const double f : net.force) mean += std::fabs(f) / static_cast<double>(net.size());
  for (double &f : net.force) f /= mean;
  net.force_scale *= mean;
}

bool pushes_only(const ContactNetwork &net) {
  return std::all_of(net.force.begin(), net.force.end(), [](double f) { return f > 0.0; });
}

GapRows::GapRows(const ContactNetwork &net, int dim, const std::vector<double> &a, double ground, NewtonSystem &system)
    : system_(system), pairs_(net.pairs), d_(dim), a_(a), weight_(net.size(), 1.0), row_(net.size()) {
  for (const int32_t z : net.coordination) diagonal_.insert(diagonal_.end(), dim, z > 0 ? ground : 1.0);
  rhs_.resize(diagonal_.size());
}

Motion GapRows::towards(const std::vector<double> &wanted, std::vector<double> &rows) {
  Motion sum, step;
  sum.s.assign(rhs_.size(), 0.0), step.s.resize(rhs_.size());
  rows.assign(wanted.size(), 0.0);
  for (int round = 0; round < 2; ++round) {
    double h = 0.0;
    for (size_t k = 0; k < row_.size(); ++k) row_[k] = wanted[k] - rows[k], h -= row_[k];
    system_.transpose_times(a_.data(), row_.data(), rhs_.data());
    system_.solve(rhs_.data(), h, step.s.data(), &step.g, 0);
    for (size_t k = 0; k < sum.s.size(); ++k) sum.s[k] += step.s[k];
    sum.g += step.g;
    system_.rows_times(a_.data(), sum.s.data(), rows.data());
    for (double &v : rows) v -= sum.g;
  }
  return sum;
}

void GapRows::balance(std::vector<double> &y) {
  // In double the residuals of a converged packing are rounding of these sums alone.
  std::vector<DoubleDouble> z(y.begin(), y.end()), unbalanced(rhs_.size());
  for (int round = 0; round < 4; ++round) {
    std::fill(unbalanced.begin(), unbalanced.end(), 0.0);
    for (size_t k = 0; k < z.size(); ++k)
      for (int c = 0; c < d_; ++c) {
        const DoubleDouble v = z[k] * a_[k * d_ + c];
        DoubleDouble &on_i = unbalanced[static_cast<size_t>(pairs_.i[k]) * d_ + c];
        on_i = on_i + v;
        if (pairs_.wall(k)) continue;
        DoubleDouble &on_j = unbalanced[static_cast<size_t>(pairs_.j[k]) * d_ + c];
        on_j = on_j - v;
      }
    for (size_t k = 0; k < rhs_.size(); ++k) rhs_[k] = static_cast<double>(unbalanced[k]);
    system_.cholesky().solve(rhs_.data());
    system_.rows_times(a_.data(), rhs_.data(), row_.data());
    for (size_t k = 0; k < z.size(); ++k) z[k] = z[k] - two_product(weight_[k], row_[k]);
  }
  for (size_t k = 0; k < y.size(); ++k) y[k] = static_cast<double>(z[k]);
}

}  // namespace jam::inside
