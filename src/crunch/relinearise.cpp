#include "crunch/relinearise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "crunch/crunch.hpp"
#include "lp/packing_lp.hpp"

namespace jam {
namespace {

// The barrier problem at one mu: maximise log Gamma + mu * sum_k log c_k over positions and the common factor of the
// diameters, with the true gaps c_k = |r_k|^2 / (Gamma sigma_k^2) - 1 (a free volume in the sense of cell theory). Each mu
// is followed to its maximum before mu falls, and every step is the best along its line: that keeps the path from wandering
// along a network that buckles.

// A product y c may differ from mu by this factor either way before y is pulled back to the central path.
constexpr double centrality = 100.0;
constexpr double shrink = 0.2;
// Squared Newton decrement a row, in units of mu, below which the maximum counts as reached. Looser values leave the path.
constexpr double centred = 0.005;
// Newton steps at one mu after which it is warmed up by `reheat`: the point reached is a saddle. With a duality gap above
// `hot` it is a slow flow instead, and mu falls after `flow` of them.
constexpr int stuck = 40, flow = 15, most_reheats = 4;
constexpr double reheat = 100.0, hot = 1e-3;
// Longest step of one sphere, mean diameters: the linear model of the rows is good to (0.1)^2.
constexpr double trust = 0.1;
constexpr double longest_alpha = 4.0, to_wall = 0.995;
// Pairs nearer than this (mean diameters) are listed: enough for a rattler to feel its cage, else it runs.
constexpr double least_reach = 0.15;

class Path {
 public:
  Path(Packing &p, const RelineariseControl &control, NewtonSystem &system, Monitor &monitor)
      : p_(p), control_(control), system_(system), monitor_(monitor) {}

  RelineariseResult run() {
    RelineariseResult out;
    const int before = system_.factorisations;
    open();
    while (measure()) {
      out.gap = gap_;
      out.factorisations = system_.factorisations - before;
      if (control_.on_step) control_.on_step(gap_, pairs_.size());
      monitor_.log(JAM_LOG_DEBUG, "path %3d gap %.2e decrement %.1e balance %.1e phi %.12f pairs %zu steps %.2f %.2f moved %.1e",
                   out.factorisations, gap_, decrement_, balance_, packing_fraction(p_), pairs_.size(), alpha_p_, alpha_d_, last_step_);
      out.reached = balance_ < 1e-2 && gap_ <= control_.target * std::max(1.0, std::sqrt(static_cast<double>(p_.n()) / 1024.0));
      if (out.reached || reheats_ > most_reheats || out.factorisations >= control_.max_factorisations ||
          monitor_.seconds() > control_.wall_time || report(out.factorisations) || !newton())
        break;
    }
    return out;
  }

 private:
  struct Direction {
    std::vector<double> s, w, y;
    double g = 0.0;
  };

  // Slacks must be strictly positive: open the closest pair by a tenth of the median gap of the d n nearest pairs at least.
  void open() {
    unit_ = diameter_mean(p_);
    reach_ = unit_ * (least_reach + 1.5 * free_spacing(p_));
    std::vector<double> gaps = make_lp(p_, find_pairs(p_, reach_, 1.0), unit_).c;
    if (!gaps.empty()) {
      const size_t half = std::min(gaps.size() - 1, static_cast<size_t>(p_.dim) * p_.n() / 2);
      std::nth_element(gaps.begin(), gaps.begin() + half, gaps.end());
      const double smallest = *std::min_element(gaps.begin(), gaps.end());
      const double room = std::max(0.1 * std::max(gaps[half], 1e-12), control_.room);
      if (smallest < room)
        for (double &s : p_.diameter) s *= std::sqrt((1.0 + smallest) / (1.0 + room));
    }
    list_pairs(false);
  }

  // New list; multipliers of pairs that stay are kept, new ones start on the central path.
  void list_pairs(bool warm) {
    const PairList old = std::move(pairs_);
    const std::vector<double> y_old = std::move(y_);
    unit_ = diameter_mean(p_);
    if (warm) reach_ = std::max(least_reach * unit_, std::min(reach_, 6.0 * recent_));
    pairs_ = find_pairs(p_, reach_, 1.0);
    lp_ = make_lp(p_, pairs_, unit_);
    const size_t rows = pairs_.size(), unknowns = p_.position.size();
    y_.assign(rows, 0.0);
    double inverse = 0.0;
    for (double c : lp_.c) inverse += 1.0 / c;
    const double mu = warm ? gap_ / static_cast<double>(std::max<size_t>(1, old.size())) : 1.0 / inverse;
    size_t at = 0;
    for (size_t k = 0; k < rows; ++k) {
      const auto key = std::make_pair(pairs_.i[k], pairs_.j[k]);
      while (warm && at < old.size() && std::make_pair(old.i[at], old.j[at]) < key) ++at;
      const bool known = warm && at < old.size() && std::make_pair(old.i[at], old.j[at]) == key;
      y_[k] = known ? y_old[at++] : mu / lp_.c[k];
    }
    system_.set_graph(p_.dim, static_cast<int32_t>(p_.n()), pairs_, control_.threads);
    travelled_ = grown_ = 0.0;
    for (auto *v : {&weight_, &target_, &row_, &curve_}) v->resize(rows);
    for (auto *v : {&unbalanced_, &rhs_, &diagonal_}) v->assign(unknowns, 0.0);
    main_.s.resize(unknowns), main_.w.resize(rows), main_.y.resize(rows);
  }

  // Rows and residuals at the true distances. False when a gap is no longer positive: the caller stops.
  bool measure() {
    lp_ = make_lp(p_, pairs_, unit_);
    double sum = 0.0, scale = 0.0, worst = 0.0;
    gap_ = 0.0;
    for (size_t k = 0; k < y_.size(); ++k) {
      const double c = lp_.c[k];
      if (!(c > 0.0)) return false;
      if (mu_ > 0.0) y_[k] = std::min(std::max(y_[k], mu_ / (centrality * c)), centrality * mu_ / c);
      gap_ += y_[k] * c;
      sum += y_[k];
      double a2 = 0.0;
      for (int q = 0; q < p_.dim; ++q) a2 += lp_.a[k * p_.dim + q] * lp_.a[k * p_.dim + q];
      scale += y_[k] * std::sqrt(a2);
    }
    rest_ = 1.0 - sum;
    system_.transpose_times(lp_.a.data(), y_.data(), unbalanced_.data());
    for (double v : unbalanced_) worst = std::max(worst, std::fabs(v));
    balance_ = worst * static_cast<double>(unbalanced_.size()) / scale;
    return std::isfinite(gap_) && std::isfinite(balance_);
  }

  // Direction for changes target_ of the products y c that also takes the force balance and sum y = 1 up.
  void solve(Direction &out) {
    double h = rest_;
    for (size_t k = 0; k < y_.size(); ++k) {
      row_[k] = target_[k] / lp_.c[k];
      h -= row_[k];
    }
    system_.transpose_times(lp_.a.data(), row_.data(), rhs_.data());
    for (size_t k = 0; k < rhs_.size(); ++k) rhs_[k] += unbalanced_[k];
    system_.solve(rhs_.data(), h, out.s.data(), &out.g, 1);
    system_.rows_times(lp_.a.data(), out.s.data(), out.w.data());
    for (size_t k = 0; k < y_.size(); ++k) {
      out.w[k] -= out.g;
      out.y[k] = row_[k] - weight_[k] * out.w[k];
    }
  }

  // |s_i - s_j|^2 / sigma^2: by this much (times alpha^2) the true gap is wider than the linear one.
  void curvature(const Direction &x) {
    const int d = p_.dim;
    for (size_t k = 0; k < y_.size(); ++k) {
      const size_t i = static_cast<size_t>(pairs_.i[k]) * d, j = static_cast<size_t>(pairs_.j[k]) * d;
      double s2 = 0.0;
      for (int c = 0; c < d; ++c) s2 += (x.s[i + c] - x.s[j + c]) * (x.s[i + c] - x.s[j + c]);
      const double sigma = 0.5 * (p_.diameter[pairs_.i[k]] + p_.diameter[pairs_.j[k]]) / unit_;
      curve_[k] = s2 / (sigma * sigma);
    }
  }
  // Longest alpha at which every true gap c + alpha w + alpha^2 curve is still positive. Call curvature(x) first.
  double wall(const Direction &x) const {
    double alpha = longest_alpha;
    for (size_t k = 0; k < y_.size(); ++k) {
      const double c = lp_.c[k], b = x.w[k], disc = b * b - 4.0 * curve_[k] * c;
      if (b < 0.0 && disc > 0.0) alpha = std::min(alpha, 2.0 * c / (-b + std::sqrt(disc)));
    }
    return alpha;
  }
  double longest_dual(const Direction &x) const {
    double alpha = 1.0;
    for (size_t k = 0; k < y_.size(); ++k)
      if (x.y[k] < 0.0) alpha = std::min(alpha, -to_wall * y_[k] / x.y[k]);
    return alpha;
  }
  double longest_move(const Direction &x) const {
    double largest = 1e-300;
    for (size_t k = 0; k < x.s.size(); k += p_.dim) {
      double s2 = 0.0;
      for (int c = 0; c < p_.dim; ++c) s2 += x.s[k + c] * x.s[k + c];
      if (!(s2 <= largest)) largest = s2;  // lets a NaN through
    }
    return std::sqrt(largest);
  }

  // By how much a step alpha x makes the negative of the barrier function larger, from the true gaps.
  double merit(const Direction &x, double alpha) const {
    const double g = alpha * x.g;
    if (!(1.0 + g > 0.0)) return std::numeric_limits<double>::infinity();
    double sum = 0.0, product = 1.0;  // one logarithm for many factors
    for (size_t k = 0; k < y_.size(); ++k) {
      const double ratio = (lp_.c[k] + alpha * (x.w[k] + alpha * curve_[k])) / ((1.0 + g) * lp_.c[k]);
      if (!(ratio > 0.0)) return std::numeric_limits<double>::infinity();
      product *= ratio;
      if (!(product > 1e-100 && product < 1e100)) sum += std::log(product), product = 1.0;
    }
    return -std::log(1.0 + g) - mu_ * (sum + std::log(product));
  }

  // The best step along x by golden sections: a few passes over the rows, where a factorisation costs hundreds. The
  // whole Newton step if that is about as good.
  double search(const Direction &x) const {
    const double most = to_wall * std::min(wall(x), trust / longest_move(x));
    double low = 0.0, high = most;
    for (int k = 0; k < 14; ++k) {
      const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
      if (merit(x, a) <= merit(x, b)) high = b;
      else low = a;
    }
    const double alpha = 0.5 * (low + high);
    return std::fabs(alpha - 1.0) < 0.1 && most > 1.0 ? 1.0 : alpha;
  }

  // Minus the slope of the merit along x over mu: the squared Newton decrement.
  double decrement(const Direction &x) const {
    double slope = -x.g / mu_;
    for (size_t k = 0; k < y_.size(); ++k) slope -= x.w[k] / lp_.c[k] - x.g;
    return -slope;
  }

  // A start colder than its forces can balance at creeps along the walls: it is warmed up at once.
  void set_mu() {
    if (mu_ == 0.0) mu_ = gap_ / static_cast<double>(y_.size());
    creeping_ = balance_ > 0.5 && alpha_p_ < 0.1 && last_step_ < 0.5 * trust ? creeping_ + 1 : 0;
    if (creeping_ > 3 && warmed_ < 3 && !centred_once_) mu_ *= 10.0, at_mu_ = creeping_ = 0, ++warmed_;
    if (++at_mu_ <= (gap_ > hot ? flow : stuck)) return;
    at_mu_ = 0;
    if (gap_ > hot) mu_ *= shrink;
    else mu_ *= reheat, ++reheats_;
  }

  bool newton() {
    const size_t rows = y_.size();
    set_mu();
    for (size_t k = 0; k < rows; ++k) weight_[k] = y_[k] / lp_.c[k];
    // Proximal term: fixes translations and lets no sphere run far for a gain below the gap.
    std::fill(diagonal_.begin(), diagonal_.end(), gap_ / static_cast<double>(p_.n()));
    if (!system_.factorise(lp_.a.data(), weight_.data(), diagonal_.data())) return false;
    for (bool colder = false;; colder = true) {
      for (size_t k = 0; k < rows; ++k) target_[k] = mu_ - y_[k] * lp_.c[k];
      solve(main_);
      decrement_ = decrement(main_);
      if (colder || !(decrement_ < centred * static_cast<double>(rows))) break;
      mu_ *= shrink, at_mu_ = 0, centred_once_ = true;
    }
    if (!std::isfinite(longest_move(main_)) || !std::isfinite(main_.g)) return false;
    curvature(main_);
    move(search(main_), longest_dual(main_));
    return alpha_p_ > 0.0;
  }

  // Unlisted pairs are farther apart than sigma_ij + reach when the list is made; while twice the distance travelled
  // plus the growth of the largest diameter stays below reach, none of them can overlap.
  void move(double alpha, double alpha_dual) {
    const double length = longest_move(main_) * unit_, growth = std::max(0.0, 0.5 * main_.g) * diameter_max(p_);
    alpha = std::min(alpha, 0.9 * (reach_ - 2.0 * travelled_ - grown_) / (2.0 * length + growth));
    alpha_p_ = alpha, alpha_d_ = alpha_dual;
    for (size_t k = 0; k < y_.size(); ++k) y_[k] += alpha_dual * main_.y[k];
    for (size_t k = 0; k < main_.s.size(); ++k) p_.position[k] += alpha * unit_ * main_.s[k];
    const double factor = std::sqrt(1.0 + alpha * main_.g);
    for (double &s : p_.diameter) s *= factor;
    wrap_positions(p_, pairs_);
    const double step = alpha * length;
    last_step_ = step / unit_;
    travelled_ += step;
    grown_ += alpha * growth;
    recent_ = std::max(step, 0.5 * recent_);
    if (2.0 * (travelled_ + 2.0 * step) + grown_ + 2.0 * alpha * growth > reach_) {
      if (measure()) list_pairs(true);
    }
  }

  bool report(int factorisations) {
    jam_progress progress{};
    progress.phase = JAM_PHASE_CRUNCH;
    progress.packing_fraction = packing_fraction(p_);
    progress.pressure = progress.fraction = std::numeric_limits<double>::quiet_NaN();
    progress.gain = gap_;
    progress.max_step = last_step_;
    progress.factorisations = factorisations;
    return monitor_.report(progress);
  }

  Packing &p_;
  const RelineariseControl control_;
  NewtonSystem &system_;
  Monitor &monitor_;
  PairList pairs_;
  PackingLp lp_;
  Direction main_;
  std::vector<double> y_, weight_, target_, row_, curve_, unbalanced_, rhs_, diagonal_;
  double unit_ = 1.0, reach_ = 0.0, travelled_ = 0.0, grown_ = 0.0, recent_ = 0.0;
  double gap_ = 0.0, mu_ = 0.0, balance_ = 0.0, rest_ = 0.0;
  double alpha_p_ = 0.0, alpha_d_ = 0.0, last_step_ = 0.0, decrement_ = 0.0;
  int at_mu_ = 0, reheats_ = 0, creeping_ = 0, warmed_ = 0;
  bool centred_once_ = false;
};

}  // namespace

RelineariseResult relinearise(Packing &p, const RelineariseControl &control, NewtonSystem &system, Monitor &monitor) {
  return Path(p, control, system, monitor).run();
}

}  // namespace jam
