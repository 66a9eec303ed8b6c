#include "network/stress_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/math.hpp"
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
  const double target = mu_ * std::max(Tuning::steepest, std::min(Tuning::flattest, math::pow(1.0 - reach, 2.0)));
  for (size_t k = 0; k < m; ++k)
    correction[k] =
        std::max(-Tuning::most_down * target, std::min(Tuning::most_up * target, -reach * reach * df[k] * dw[k]));
  direction(target, correction, df, dw, dx);
  double length = std::min(1.0, Tuning::to_boundary * std::min(longest(f_, df), longest(w_, dw)));
  while (length > Tuning::least_step && worst_product(length, df, dw) < Tuning::neighbourhood)
    length *= Tuning::shorter;
  for (size_t k = 0; k < m; ++k) f_[k] += length * df[k], w_[k] += length * dw[k];
  for (size_t k = 0; k < x_.size(); ++k) x_[k] += length * dx[k];
  mu_ += length * (target - mu_);
  ++steps_;
  return length > Tuning::least_step;
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

}  // namespace jam::inside
