#include "crunch/relinearise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <cstdlib>

#include "lp/packing_lp.hpp"

namespace jam {
namespace {
double knob(const char *n, double d) { const char *e = std::getenv(n); return e ? std::atof(e) : d; }

class Path {
 public:
  Path(Packing &p, const RelineariseControl &control, NewtonSystem &system, Monitor &monitor)
      : p_(p), control_(control), system_(system), monitor_(monitor) {}

  RelineariseResult run() {
    RelineariseResult out;
    const int before = system_.factorisations;
    open_gaps();
    rebuild(true);
    int idle = 0;
    double best = std::numeric_limits<double>::infinity();
    for (;;) {
      measure();
      out.gap = gap_;
      out.factorisations = system_.factorisations - before;
      monitor_.log(JAM_LOG_DEBUG, "path %3d gap %.2e balance %.1e sum_y-1 %.1e phi %.12f pairs %zu ap %.2f ad %.2f step %.1e sigma %.2f", out.factorisations, gap_, balance_, -rg_,
                   packing_fraction(p_), pairs_.size(), alpha_p_, alpha_d_, last_step_, centring_);
      if (gap_ <= control_.target && balance_ < 1e-3) { out.reached = true; break; }
      idle = gap_ < 0.9 * best ? 0 : idle + 1;
      best = std::min(best, gap_);
      if (idle > 30 || out.factorisations >= control_.max_factorisations || monitor_.seconds() > control_.wall_time) break;
      if (report(out.factorisations)) break;
      if (!newton()) break;
    }
    return out;
  }

 private:
  // Slacks must be strictly positive: shrink until the closest pair is open by a tenth of the median gap of
  // neighbours.
  void open_gaps() {
    unit_ = diameter_mean(p_);
    reach_ = first_reach();
    pairs_ = find_pairs(p_, reach_, 1.0);
    PackingLp lp = make_lp(p_, pairs_, unit_);
    std::vector<double> sorted = lp.c;
    const size_t most = std::min(sorted.size() - 1, static_cast<size_t>(p_.dim) * p_.n());
    std::nth_element(sorted.begin(), sorted.begin() + most / 2, sorted.end());
    const double median = std::max(sorted[most / 2], 1e-12), smallest = *std::min_element(sorted.begin(), sorted.end());
    const double room = knob("ROOM", 0.1) * median;
    if (smallest < room)
      for (double &s : p_.diameter) s *= std::sqrt((1.0 + smallest) / (1.0 + room));
  }

  double first_reach() const {
    const double spacing = std::pow(packing_fraction(p_), -1.0 / p_.dim);
    const double jammed = std::pow(p_.dim == 2 ? 0.84 : p_.dim == 3 ? 0.64 : std::pow(2.0, 3.0 - p_.dim) * 0.9, -1.0 / p_.dim);
    return unit_ * std::max(knob("REACH", 0.3), 1.5 * (spacing - jammed) + 0.25);
  }

  // New list; multipliers of pairs that stay are kept, new ones start on the central path.
  void rebuild(bool first) {
    PairList old = std::move(pairs_);
    std::vector<double> y_old = std::move(y_);
    unit_ = diameter_mean(p_);
    if (!first) reach_ = std::max(unit_ * knob("REACH2", 0.15), std::min(reach_, 6.0 * recent_));
    pairs_ = find_pairs(p_, reach_, 1.0);
    lp_ = make_lp(p_, pairs_, unit_);
    y_.assign(pairs_.size(), 0.0);
    double inverse = 0.0;
    for (double c : lp_.c) inverse += 1.0 / c;
    if (first) {
      for (size_t k = 0; k < y_.size(); ++k) y_[k] = 1.0 / (inverse * lp_.c[k]);
    } else {
      const double mu = gap_ / static_cast<double>(old.size());
      size_t at = 0;
      for (size_t k = 0; k < pairs_.size(); ++k) {
        const auto key = std::make_pair(pairs_.i[k], pairs_.j[k]);
        while (at < old.size() && std::make_pair(old.i[at], old.j[at]) < key) ++at;
        if (at < old.size() && std::make_pair(old.i[at], old.j[at]) == key) y_[k] = y_old[at++];
        else y_[k] = mu / lp_.c[k];
      }
    }
    system_.set_graph(p_.dim, static_cast<int32_t>(p_.n()), pairs_, control_.threads);
    travelled_ = 0.0;
    const size_t m = pairs_.size(), u = p_.position.size();
    for (auto *v : {&weight_, &rc_, &row_, &dw_, &dy_, &curve_}) v->resize(m);
    for (auto *v : {&rd_, &rhs_, &diagonal_, &ds_}) v->resize(u);
  }

  void measure() {
    lp_ = make_lp(p_, pairs_, unit_);
    gap_ = 0.0;
    double sum = 0.0, scale = 0.0, worst = 0.0;
    const int d = p_.dim;
    for (size_t k = 0; k < y_.size(); ++k) {
      gap_ += y_[k] * lp_.c[k];
      sum += y_[k];
      double a2 = 0.0;
      for (int c = 0; c < d; ++c) a2 += lp_.a[k * d + c] * lp_.a[k * d + c];
      scale += y_[k] * std::sqrt(a2);
    }
    rg_ = 1.0 - sum;
    system_.transpose_times(lp_.a.data(), y_.data(), rd_.data());
    for (double v : rd_) worst = std::max(worst, std::fabs(v));
    balance_ = worst * static_cast<double>(rd_.size()) / scale;
  }

  // Direction for complementarity targets rc_ (row) and primal residual curve_.
  void direction(bool curved) {
    double h = rg_;
    for (size_t k = 0; k < y_.size(); ++k) {
      row_[k] = rc_[k] / lp_.c[k] - (curved ? weight_[k] * curve_[k] : 0.0);
      h -= row_[k];
    }
    system_.transpose_times(lp_.a.data(), row_.data(), rhs_.data());
    for (size_t k = 0; k < rhs_.size(); ++k) rhs_[k] += rd_[k];
    system_.solve(rhs_.data(), h, ds_.data(), &dg_);
    system_.rows_times(lp_.a.data(), ds_.data(), dw_.data());
    for (size_t k = 0; k < y_.size(); ++k) {
      dw_[k] -= dg_;
      dy_[k] = rc_[k] / lp_.c[k] - weight_[k] * (dw_[k] + (curved ? curve_[k] : 0.0));
    }
  }

  // |ds_i - ds_j|^2 / sigma^2 in the units of the rows, minus what the product of growth and gap adds.
  void curvature() {
    const int d = p_.dim;
    for (size_t k = 0; k < y_.size(); ++k) {
      const size_t i = static_cast<size_t>(pairs_.i[k]) * d, j = static_cast<size_t>(pairs_.j[k]) * d;
      double s2 = 0.0;
      for (int c = 0; c < d; ++c) s2 += (ds_[i + c] - ds_[j + c]) * (ds_[i + c] - ds_[j + c]);
      const double sigma = 0.5 * (p_.diameter[pairs_.i[k]] + p_.diameter[pairs_.j[k]]) / unit_;
      curve_[k] = s2 / (sigma * sigma);
    }
  }

  // Longest alpha for which every true gap c + alpha dw + alpha^2 curve stays above (1 - keep) c.
  double longest_primal(double keep) const {
    double alpha = 1.0;
    for (size_t k = 0; k < y_.size(); ++k) {
      const double c = keep * lp_.c[k], b = dw_[k], q = curve_[k];
      if (b >= 0.0) continue;
      const double disc = b * b - 4.0 * q * c;
      if (disc <= 0.0) continue;
      const double root = 2.0 * c / (-b + std::sqrt(disc));
      alpha = std::min(alpha, root);
    }
    return alpha;
  }
  double longest_dual(double keep) const {
    double alpha = 1.0;
    for (size_t k = 0; k < y_.size(); ++k)
      if (dy_[k] < 0.0) alpha = std::min(alpha, -keep * y_[k] / dy_[k]);
    return alpha;
  }

  bool newton() {
    const double m = static_cast<double>(y_.size()), mu = gap_ / m;
    for (size_t k = 0; k < y_.size(); ++k) weight_[k] = y_[k] / lp_.c[k];
    const double ridge = knob("RHO", 1.0) * gap_ / static_cast<double>(p_.n());
    std::fill(diagonal_.begin(), diagonal_.end(), ridge);
    if (!system_.factorise(lp_.a.data(), weight_.data(), diagonal_.data())) return false;
    for (size_t k = 0; k < y_.size(); ++k) rc_[k] = -y_[k] * lp_.c[k];
    direction(false);
    curvature();
    const double ap = longest_primal(1.0), ad = longest_dual(1.0);
    double after = 0.0;
    for (size_t k = 0; k < y_.size(); ++k) after += (y_[k] + ad * dy_[k]) * (lp_.c[k] + ap * dw_[k]);
    const double ratio = after / gap_;
    centring_ = std::min(std::max(std::pow(ratio, knob("POW", 3)), 1e-6), 0.9);
    const bool second = gap_ < knob("SECOND", 1e30);
    const double soc = knob("SOC", 1.0) * ap * ap;
    for (size_t k = 0; k < y_.size(); ++k) {
      rc_[k] = centring_ * mu - y_[k] * lp_.c[k] - (second ? ap * ad * dw_[k] * dy_[k] : 0.0);
      curve_[k] *= soc;
    }
    direction(true);
    curvature();
    const double keep = knob("KEEP", 0.95);
    alpha_p_ = longest_primal(keep);
    alpha_d_ = longest_dual(keep);
    double largest = 0.0;
    const int d = p_.dim;
    for (size_t k = 0; k < ds_.size(); k += d) {
      double s2 = 0.0;
      for (int c = 0; c < d; ++c) s2 += ds_[k + c] * ds_[k + c];
      largest = std::max(largest, s2);
    }
    largest = std::sqrt(largest) * unit_;
    if (!std::isfinite(largest)) return false;
    // Trust region, and the reach of the list: 2 (travelled + step) + growth must stay inside it.
    alpha_p_ = std::min(alpha_p_, std::min(knob("TRUST", 0.1) * unit_, 0.45 * reach_) / std::max(largest, 1e-300));
    move(alpha_p_, largest);
    return true;
  }

  void move(double alpha, double largest) {
    const double step = alpha * largest, growth = std::max(0.0, std::sqrt(1.0 + alpha * dg_) - 1.0) * diameter_max(p_);
    last_step_ = step / unit_;
    if (2.0 * (travelled_ + step) + growth_ + growth > reach_) {
      rebuild_list_then(alpha);
      return;
    }
    apply(alpha);
    travelled_ += step;
    growth_ += growth;
    recent_ = std::max(step, 0.5 * recent_);
    if (2.0 * (travelled_ + 2.0 * step) + growth_ > reach_) {
      measure();
      rebuild(false);
      growth_ = 0.0;
    }
  }
  void rebuild_list_then(double alpha) {
    // Shorten to what the list allows, then make a new one.
    const double left = std::max(0.0, reach_ - 2.0 * travelled_ - growth_);
    (void)left;
    apply(std::min(alpha, 0.25 * alpha));
    measure();
    recent_ = std::max(recent_, last_step_ * unit_);
    rebuild(false);
    growth_ = 0.0;
  }
  void apply(double alpha) {
    for (size_t k = 0; k < ds_.size(); ++k) p_.position[k] += alpha * unit_ * ds_[k];
    const double factor = std::sqrt(1.0 + alpha * dg_);
    for (double &s : p_.diameter) s *= factor;
    wrap_positions(p_, pairs_);
    for (size_t k = 0; k < y_.size(); ++k) y_[k] += alpha_d_ * dy_[k];
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
  std::vector<double> y_, weight_, rc_, row_, dw_, dy_, curve_, rd_, rhs_, diagonal_, ds_;
  double unit_ = 1.0, reach_ = 0.0, travelled_ = 0.0, growth_ = 0.0, recent_ = 0.0;
  double gap_ = 0.0, balance_ = 0.0, rg_ = 0.0, dg_ = 0.0;
  double alpha_p_ = 0.0, alpha_d_ = 0.0, last_step_ = 0.0, centring_ = 0.0;
};

}  // namespace

RelineariseResult relinearise(Packing &p, const RelineariseControl &control, NewtonSystem &system, Monitor &monitor) {
  return Path(p, control, system, monitor).run();
}

}  // namespace jam
