// One step of the interior point: its normal equations, directions and lengths.
#include "lp/interior_point.hpp"

#include <algorithm>
#include <cmath>

namespace jam::inside {

using Rules = InteriorPointTuning;
using C = CorrectorTuning;

void InteriorPoint::Direction::resize(size_t rows, size_t unknowns) {
  for (auto *v : {&s, &zu, &zv}) v->resize(unknowns);
  for (auto *v : {&y, &w}) v->resize(rows);
}

void InteriorPoint::Direction::add(const Direction &o) {
  for (size_t k = 0; k < s.size(); ++k) s[k] += o.s[k], zu[k] += o.zu[k], zv[k] += o.zv[k];
  for (size_t k = 0; k < y.size(); ++k) y[k] += o.y[k], w[k] += o.w[k];
  g += o.g;
}

void InteriorPoint::weights() {
  double mean = 0.0;
  for (size_t k = 0; k < rows_; ++k) {
    weight_[k] = y_[k] / w_[k];
    mean += weight_[k];
  }
  // Translations (and spheres without rows) need a proximal diagonal where bounds are wide: it leaves the fixed point
  // alone.
  const double ridge = control_.ridge * mean / static_cast<double>(unknowns_);
  for (size_t k = 0; k < unknowns_; ++k) diagonal_[k] = ridge + (box_ ? zu_[k] / u_[k] + zv_[k] / v_[k] : 0.0);
}

bool InteriorPoint::direction(const std::vector<double> &rc, const std::vector<double> &rcu,
                              const std::vector<double> &rcv, bool full, int refine, Direction &out) {
  double h = full ? rg_ : 0.0;
  for (size_t k = 0; k < rows_; ++k) {
    row_[k] = rc[k] / w_[k] - (full ? weight_[k] * rp_[k] : 0.0);
    h -= row_[k];
  }
  system_.transpose_times(lp_->a.data(), row_.data(), rhs_.data());
  for (size_t k = 0; k < unknowns_; ++k) {
    if (full) rhs_[k] += rd_[k];
    if (box_) rhs_[k] += rcv[k] / v_[k] - rcu[k] / u_[k];
  }
  if (!factor_.solve(rhs_.data(), h, out.s.data(), &out.g, refine)) return false;
  system_.rows_times(lp_->a.data(), out.s.data(), out.w.data());
  for (size_t k = 0; k < rows_; ++k) {
    out.w[k] += (full ? rp_[k] : 0.0) - out.g;
    out.y[k] = rc[k] / w_[k] - weight_[k] * out.w[k];
  }
  if (box_)
    for (size_t k = 0; k < unknowns_; ++k) {
      out.zu[k] = (rcu[k] + zu_[k] * out.s[k]) / u_[k];
      out.zv[k] = (rcv[k] - zv_[k] * out.s[k]) / v_[k];
    }
  return true;
}

InteriorPoint::Steps InteriorPoint::longest(const Direction &d) const {
  Steps a{1e30, 1e30};
  const auto limit = [](double x, double dx, double &step) {
    if (dx < 0.0) step = std::min(step, -x / dx);
  };
  for (size_t k = 0; k < rows_; ++k) {
    limit(w_[k], d.w[k], a.primal);
    limit(y_[k], d.y[k], a.dual);
  }
  if (box_)
    for (size_t k = 0; k < unknowns_; ++k) {
      limit(u_[k], -d.s[k], a.primal);
      limit(v_[k], d.s[k], a.primal);
      limit(zu_[k], d.zu[k], a.dual);
      limit(zv_[k], d.zv[k], a.dual);
    }
  return {std::min(1.0, a.primal), std::min(1.0, a.dual)};
}

double InteriorPoint::mu_after(const Direction &d, const Steps &a) const {
  double sum = 0.0;
  for (size_t k = 0; k < rows_; ++k) sum += (w_[k] + a.primal * d.w[k]) * (y_[k] + a.dual * d.y[k]);
  if (box_)
    for (size_t k = 0; k < unknowns_; ++k)
      sum += (u_[k] - a.primal * d.s[k]) * (zu_[k] + a.dual * d.zu[k]) +
             (v_[k] + a.primal * d.s[k]) * (zv_[k] + a.dual * d.zv[k]);
  return sum / static_cast<double>(rows_ + (box_ ? 2 * unknowns_ : 0));
}

bool InteriorPoint::predictor_corrector(Direction &d) {
  for (size_t k = 0; k < rows_; ++k) targets_[k] = -y_[k] * w_[k];
  if (box_)
    for (size_t k = 0; k < unknowns_; ++k) targets_u_[k] = -u_[k] * zu_[k], targets_v_[k] = -v_[k] * zv_[k];
  if (!direction(targets_, targets_u_, targets_v_, true, 0, d)) return false;
  const double mu = complementarity() / static_cast<double>(rows_ + (box_ ? 2 * unknowns_ : 0));
  const double ratio = mu_after(d, longest(d)) / mu;
  // Far below the tolerance only rounding is left.
  const double target = std::max(std::max(ratio * ratio * ratio, Rules::least_ratio) * mu,
                                 Rules::of_tolerance * control_.tolerance / static_cast<double>(rows_));
  for (size_t k = 0; k < rows_; ++k) targets_[k] = target - y_[k] * w_[k] - d.w[k] * d.y[k];
  if (box_)
    for (size_t k = 0; k < unknowns_; ++k) {
      targets_u_[k] = target - u_[k] * zu_[k] + d.s[k] * d.zu[k];
      targets_v_[k] = target - v_[k] * zv_[k] - d.s[k] * d.zv[k];
    }
  if (!direction(targets_, targets_u_, targets_v_, true, 2, d)) return false;
  centrality_correctors(d, target);
  return true;
}

// Each corrector pulls products that a longer step would leave outside the band around mu back to it, and is kept
// only if it lengthens the step.
void InteriorPoint::centrality_correctors(Direction &d, double mu) {
  const auto pull = [mu](double product) {
    const double inside = std::min(std::max(product, 1.0 / C::band * mu), C::band * mu);
    return std::max(inside - product, -C::band * mu);
  };
  for (int round = 0; round < control_.correctors; ++round) {
    const Steps now = longest(d);
    if (std::min(now.primal, now.dual) > 1.0 - LineSearchTuning::nearly_whole) return;
    const Steps aim{std::min(1.0, now.primal + C::ahead), std::min(1.0, now.dual + C::ahead)};
    for (size_t k = 0; k < rows_; ++k) targets_[k] = pull((w_[k] + aim.primal * d.w[k]) * (y_[k] + aim.dual * d.y[k]));
    if (box_)
      for (size_t k = 0; k < unknowns_; ++k) {
        targets_u_[k] = pull((u_[k] - aim.primal * d.s[k]) * (zu_[k] + aim.dual * d.zu[k]));
        targets_v_[k] = pull((v_[k] + aim.primal * d.s[k]) * (zv_[k] + aim.dual * d.zv[k]));
      }
    if (!direction(targets_, targets_u_, targets_v_, false, 0, extra_)) return;
    trial_ = d;
    trial_.add(extra_);
    const Steps better = longest(trial_);
    if (better.primal + better.dual < now.primal + now.dual + Rules::least_win) return;
    std::swap(d, trial_);
  }
}

void InteriorPoint::move(const Direction &d, const Steps &a) {
  for (size_t k = 0; k < rows_; ++k) {
    w_[k] += a.primal * d.w[k];
    y_[k] += a.dual * d.y[k];
  }
  for (size_t k = 0; k < unknowns_; ++k) {
    s_[k] += a.primal * d.s[k];
    if (!box_) continue;
    u_[k] -= a.primal * d.s[k];
    v_[k] += a.primal * d.s[k];
    zu_[k] += a.dual * d.zu[k];
    zv_[k] += a.dual * d.zv[k];
  }
  g_ += a.primal * d.g;
}

}  // namespace jam::inside
