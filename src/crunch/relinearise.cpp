#include "crunch/relinearise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "crunch/crunch.hpp"
#include "lp/packing_lp.hpp"

namespace jam {
namespace {

// A product y w may differ from the mean by this factor either way before y is pulled back to the central path.
constexpr double centrality = 100.0;
// Part of the way to the nearest wall that one step may go.
constexpr double keep = 0.95;
// Longest step of one sphere, mean diameters: the linear model of the rows is good to (0.1)^2.
constexpr double trust = 0.1;
constexpr int correctors = 3;
constexpr int probes = 3;
constexpr double widest_room = 1e-3;
// Short steps or forces far from balance say that the barrier sank faster than the network could follow: warm it up by
// this factor instead. That is what keeps the path from wandering along a buckling network. Not while dilute.
constexpr double reheat = 1.5, short_step = 0.1, unbalanced_forces = 0.2, warm_below = 0.02;
// Newton steps without progress before the path gives up. Progress is a lower duality gap, or growth by a fair part of
// the gap: along a buckling network the gap stays and the density rises.
constexpr int patience = 60;

class Path {
 public:
  Path(Packing &p, const RelineariseControl &control, NewtonSystem &system, Monitor &monitor)
      : p_(p), control_(control), system_(system), monitor_(monitor) {}

  RelineariseResult run() {
    RelineariseResult out;
    const int before = system_.factorisations;
    open_enough(before);
    int idle = 0;
    double best = std::numeric_limits<double>::infinity(), reference = unit_now();
    while (measure()) {
      out.gap = gap_;
      out.factorisations = system_.factorisations - before;
      if (control_.on_step) control_.on_step(gap_, pairs_.size());
      monitor_.log(JAM_LOG_DEBUG, "path %3d gap %.2e balance %.1e phi %.12f pairs %zu steps %.2f %.2f moved %.1e centring %.2f",
                   out.factorisations, gap_, balance_, packing_fraction(p_), pairs_.size(), alpha_p_, alpha_d_, last_step_, centring_);
      out.reached = gap_ <= control_.target && balance_ < 1e-3;
      const double grown = std::log(unit_now() / reference);
      const bool progress = gap_ < 0.9 * best || grown > 0.1 * gap_;
      idle = progress ? 0 : idle + 1;
      if (progress) best = std::min(best, gap_), reference = unit_now();
      if (out.reached || idle > patience || out.factorisations >= control_.max_factorisations ||
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

  // Slacks must be strictly positive, and wide enough for the force balance to be reached before they shut: a barrier
  // that starts too low creeps for hundreds of steps. Open the closest pair by a tenth of the median gap of the d n
  // nearest pairs, probe with a few Newton steps, and open ten times wider while these are short.
  void open_enough(int before) {
    const Packing start = p_;
    unit_ = diameter_mean(p_);
    reach_ = unit_ * first_reach();
    std::vector<double> gaps = make_lp(p_, find_pairs(p_, reach_, 1.0), unit_).c;
    if (gaps.empty()) return list_pairs(false);
    const size_t half = std::min(gaps.size() - 1, static_cast<size_t>(p_.dim) * p_.n() / 2);
    std::nth_element(gaps.begin(), gaps.begin() + half, gaps.end());
    const double smallest = *std::min_element(gaps.begin(), gaps.end());
    for (double room = 0.1 * std::max(gaps[half], 1e-12); ; room *= 10.0) {
      if (smallest < room)
        for (double &s : p_.diameter) s *= std::sqrt((1.0 + smallest) / (1.0 + room));
      mu_ = recent_ = 0.0;
      list_pairs(false);
      double longest = 0.0;
      for (int k = 0; k < probes && measure(); ++k) {
        if (system_.factorisations - before >= control_.max_factorisations || report(system_.factorisations - before) || !newton()) break;
        longest = std::max(longest, std::min(alpha_p_, alpha_d_));
      }
      if (longest >= short_step || room > widest_room || monitor_.cancelled()) return;
      p_ = start;
      unit_ = diameter_mean(p_);
      reach_ = unit_ * first_reach();
    }
  }

  double first_reach() const { return 0.15 + 1.5 * free_spacing(p_); }

  double unit_now() const { return p_.diameter.front(); }  // diameters grow in a common factor

  // New list; multipliers of pairs that stay are kept, new ones start on the central path.
  void list_pairs(bool warm) {
    const PairList old = std::move(pairs_);
    const std::vector<double> y_old = std::move(y_);
    unit_ = diameter_mean(p_);
    if (warm) reach_ = std::max(0.15 * unit_, std::min(reach_, 6.0 * recent_));
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
    for (auto *v : {&unbalanced_, &none_, &rhs_, &diagonal_}) v->assign(unknowns, 0.0);
    for (auto *d : {&main_, &extra_, &trial_}) d->s.resize(unknowns), d->w.resize(rows), d->y.resize(rows);
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

  // Direction for changes target_ of the products y c; `full`: also takes the force balance and sum y = 1 up.
  void solve(bool full, int refine, Direction &out) {
    double h = full ? rest_ : 0.0;
    for (size_t k = 0; k < y_.size(); ++k) {
      row_[k] = target_[k] / lp_.c[k];
      h -= row_[k];
    }
    system_.transpose_times(lp_.a.data(), row_.data(), rhs_.data());
    const std::vector<double> &force = full ? unbalanced_ : none_;
    for (size_t k = 0; k < rhs_.size(); ++k) rhs_[k] += force[k];
    system_.solve(rhs_.data(), h, out.s.data(), &out.g, refine);
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
  // Longest alpha <= 1 at which every true gap c + alpha w + alpha^2 curve keeps (1 - part) c, within the trust region.
  // Call curvature(x) first.
  double longest_primal(const Direction &x, double part) const {
    double alpha = std::min(1.0, trust / longest_move(x));
    for (size_t k = 0; k < y_.size(); ++k) {
      const double c = part * lp_.c[k], b = x.w[k], disc = b * b - 4.0 * curve_[k] * c;
      if (b < 0.0 && disc > 0.0) alpha = std::min(alpha, 2.0 * c / (-b + std::sqrt(disc)));
    }
    return alpha;
  }
  double longest_dual(const Direction &x, double part) const {
    double alpha = 1.0;
    for (size_t k = 0; k < y_.size(); ++k)
      if (x.y[k] < 0.0) alpha = std::min(alpha, -part * y_[k] / x.y[k]);
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

  // Mehrotra's predictor sets the centring; the second-order term is scaled by the steps that the predictor could make.
  bool newton() {
    const size_t rows = y_.size();
    const double mu = gap_ / static_cast<double>(rows);
    for (size_t k = 0; k < rows; ++k) weight_[k] = y_[k] / lp_.c[k];
    // Proximal term: fixes translations and lets no sphere run far for a gain below the gap.
    std::fill(diagonal_.begin(), diagonal_.end(), gap_ / static_cast<double>(p_.n()));
    if (!system_.factorise(lp_.a.data(), weight_.data(), diagonal_.data())) return false;
    for (size_t k = 0; k < rows; ++k) target_[k] = -y_[k] * lp_.c[k];
    solve(true, 0, main_);
    curvature(main_);
    const double ap = longest_primal(main_, 1.0), ad = longest_dual(main_, 1.0);
    double after = 0.0;
    for (size_t k = 0; k < rows; ++k) after += (y_[k] + ad * main_.y[k]) * (lp_.c[k] + ap * main_.w[k]);
    centring_ = std::min(std::max(std::pow(after / gap_, 3), 1e-6), 0.9);
    balanced_once_ = balanced_once_ || balance_ < unbalanced_forces;
    if (alpha_p_ > 0.0 && gap_ < warm_below && (std::min(alpha_p_, alpha_d_) < short_step || (balanced_once_ && balance_ > unbalanced_forces))) centring_ = reheat;
    for (size_t k = 0; k < rows; ++k) target_[k] = centring_ * mu - y_[k] * lp_.c[k] - ap * ad * main_.w[k] * main_.y[k];
    solve(true, 1, main_);
    centre(centring_ * mu);
    curvature(main_);
    if (!std::isfinite(longest_move(main_)) || !std::isfinite(main_.g)) return false;
    move(longest_primal(main_, keep), longest_dual(main_, keep));
    return alpha_p_ > 0.0;
  }

  // Gondzio's correctors on the true gaps: products outside [0.1, 10] mu at a longer step are pulled back.
  void centre(double mu) {
    for (int round = 0; round < correctors; ++round) {
      curvature(main_);
      const double ap = longest_primal(main_, 1.0), ad = longest_dual(main_, 1.0);
      if (ap > 0.9 && ad > 0.9) return;
      const double tp = std::min(1.0, ap + 0.3), td = std::min(1.0, ad + 0.3);
      for (size_t k = 0; k < y_.size(); ++k) {
        const double product = (lp_.c[k] + tp * main_.w[k] + tp * tp * curve_[k]) * (y_[k] + td * main_.y[k]);
        target_[k] = std::max(std::min(std::max(product, 0.1 * mu), 10.0 * mu) - product, -10.0 * mu);
      }
      solve(false, 0, extra_);
      trial_ = main_;
      for (size_t k = 0; k < trial_.s.size(); ++k) trial_.s[k] += extra_.s[k];
      for (size_t k = 0; k < y_.size(); ++k) trial_.w[k] += extra_.w[k], trial_.y[k] += extra_.y[k];
      trial_.g += extra_.g;
      curvature(trial_);
      if (longest_primal(trial_, 1.0) + longest_dual(trial_, 1.0) < ap + ad + 0.02) return;
      std::swap(main_, trial_);
    }
  }

  // Unlisted pairs are farther apart than sigma_ij + reach when the list is made; while twice the distance travelled
  // plus the growth of the largest diameter stays below reach, none of them can overlap.
  void move(double alpha, double alpha_dual) {
    const double length = longest_move(main_) * unit_, growth = std::max(0.0, 0.5 * main_.g) * diameter_max(p_);
    alpha = std::min(alpha, 0.9 * (reach_ - 2.0 * travelled_ - grown_) / (2.0 * length + growth));
    alpha_p_ = alpha, alpha_d_ = alpha_dual;
    mu_ = 0.0;
    for (size_t k = 0; k < y_.size(); ++k) {
      mu_ += (y_[k] + alpha_dual * main_.y[k]) * (lp_.c[k] + alpha * main_.w[k]);
      y_[k] += alpha_dual * main_.y[k];
    }
    mu_ /= static_cast<double>(y_.size());
    for (size_t k = 0; k < main_.s.size(); ++k) p_.position[k] += alpha * unit_ * main_.s[k];
    const double factor = std::sqrt(1.0 + alpha * main_.g);
    for (double &s : p_.diameter) s *= factor;
    wrap_positions(p_, pairs_);
    const double step = alpha * length;
    last_step_ = step / unit_;
    travelled_ += step;
    grown_ += alpha * growth;
    recent_ = std::max(step, 0.5 * recent_);
    if (2.0 * (travelled_ + 2.0 * step) + grown_ + 2.0 * alpha * growth > reach_ && measure()) list_pairs(true);
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
  Direction main_, extra_, trial_;
  std::vector<double> y_, weight_, target_, row_, curve_, unbalanced_, none_, rhs_, diagonal_;
  double unit_ = 1.0, reach_ = 0.0, travelled_ = 0.0, grown_ = 0.0, recent_ = 0.0;
  double gap_ = 0.0, mu_ = 0.0, balance_ = 0.0, rest_ = 0.0;
  double alpha_p_ = 0.0, alpha_d_ = 0.0, last_step_ = 0.0, centring_ = 0.0;
  bool balanced_once_ = false;
};

}  // namespace

RelineariseResult relinearise(Packing &p, const RelineariseControl &control, NewtonSystem &system, Monitor &monitor) {
  return Path(p, control, system, monitor).run();
}

}  // namespace jam
