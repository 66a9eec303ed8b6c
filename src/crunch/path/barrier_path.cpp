// One interior-point method for the true, curved problem instead of one for each LP. After every Newton step the
// spheres move, the diameters grow, and the rows are computed again at the true distances; the multipliers stay.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cell_change.hpp"
#include "core/pair_rule.hpp"
#include "crunch/phases.hpp"
#include "linalg/dot.hpp"
#include "lp/barrier_problem.hpp"

namespace jam::inside {
namespace {

// How mu changes along the path.
class BarrierSchedule {
 public:
  explicit BarrierSchedule(const Tuning &tuning) : t_(tuning) {}
  // Factor of mu before the next Newton step. part: of the last step that was taken; mu_ratio: the first mu over the
  // present one. A saddle shows by steps that stay short while the decrement no longer falls. The first two steps at a
  // new mu may be short in any case.
  double next_factor(double decrement, double part, double mu_ratio) {
    if (steps_ == 0) short_steps_ = 0, least_ = mark_ = std::numeric_limits<double>::infinity();
    const bool falls = decrement < InteriorPointTuning::progress * least_;
    if (steps_ > 0) {
      least_ = std::min(least_, decrement);
      if (decrement < t_.progress * mark_) short_steps_ = 0, mark_ = decrement;
    }
    if (steps_ > 2 && part < 0.5 && !falls) ++short_steps_;
    ++steps_;
    if (steps_ <= t_.max_steps_at_mu && short_steps_ < InteriorPointTuning::max_stalled) return 1.0;
    steps_ = 0;
    if (mu_ratio < t_.increase) return t_.reduction;
    ++increases;
    return t_.increase;
  }
  // True where the maximum at mu counts as reached.
  bool centred(double decrement, double rows) {
    if (!(decrement < t_.centred * rows)) return false;
    steps_ = 0;
    return true;
  }
  int increases = 0;

 private:
  const Tuning &t_;
  double least_ = 0.0, mark_ = 0.0;  // lowest decrement at this mu; the one at which short steps began to count
  int steps_ = 0, short_steps_ = 0;
};

class BarrierPath {
 public:
  BarrierPath(Packing &p, const BarrierPathControl &control, NewtonSystem &system, Monitor &monitor)
      : p_(p), control_(control), system_(system), monitor_(monitor) {
    b_.strain = control.strain;
  }

  BarrierPathResult run() {
    BarrierPathResult out;
    const int before = system_.factorisations;
    open();
    while (linearise()) {
      out.gap = gap_;
      out.factorisations = system_.factorisations - before;
      out.increases = schedule_.increases;
      if (control_.on_step) control_.on_step(gap_, b_.pairs.size(), {b_.mu, first_mu_});
      monitor_.log(JAM_LOG_DEBUG,
                   "path %3d gap %.2e decrement %.1e balance %.1e phi %.12f pairs %zu coupled %zu correctors %d steps "
                   "%.2f %.2f moved %.1e",
                   out.factorisations, gap_, decrement_, balance_, packing_fraction(p_), b_.pairs.size(),
                   matrix_.coupled(), correctors_, alpha_p_, alpha_d_, last_step_);
      out.reached = balance_ < InteriorPointTuning::rough_balance && gap_ <= end_;
      const bool crystal =
          out.increases > 0 && gap_ < t_.close_gap && hyperstatic(b_.y, static_cast<double>(p_.position.size()), t_);
      if (out.reached || crystal || out.factorisations >= t_.max_path_factorisations || monitor_.interrupted() ||
          report() || !newton())
        break;
    }
    out.multipliers = {std::move(b_.pairs), std::move(b_.y)};
    return out;
  }

 private:
  void open() {
    b_.unit = diameter_mean(p_);
    end_ = std::max(control_.least_gap, t_.path_end(p_));
    reach_ = b_.unit * (t_.least_reach + t_.reach_per_spacing * free_spacing(p_));
    const bool anew = !(control_.from.mu > 0.0);
    if (anew) open_gaps();
    list_pairs();
    b_.y.assign(b_.pairs.size(), 0.0);
    b_.mu = first_mu_ = centre_multipliers(b_.y, b_.lp.c, static_cast<double>(p_.position.size()));
    if (anew) return;
    b_.mu = control_.from.mu, first_mu_ = control_.from.first_mu;
    for (size_t k = 0; k < b_.y.size(); ++k) b_.y[k] = b_.mu / b_.lp.c[k];
  }

  // Slacks must be strictly positive: open the closest pair by a share of the median gap of the d n nearest pairs at
  // least.
  void open_gaps() {
    std::vector<double> gaps = make_lp(p_, find_pairs(p_, reach_, 1.0), b_.unit).c;
    if (!gaps.empty()) {
      const size_t half = std::min(gaps.size() - 1, static_cast<size_t>(p_.dim) * p_.n() / 2);
      std::nth_element(gaps.begin(), gaps.begin() + half, gaps.end());
      const double smallest = *std::min_element(gaps.begin(), gaps.end());
      // Between small spheres of a wide mixture gaps are many of their diameters: no more than the list reaches beyond
      // mean ones.
      const double reach = reach_ / b_.unit, widest = reach * (2.0 + reach);
      const double opening = std::max(std::min(t_.opening * gaps[half], widest), control_.opening);
      if (smallest < opening)
        for (double &s : p_.diameter) s *= std::sqrt((1.0 + smallest) / (1.0 + opening));
    }
  }

  // Multipliers of pairs that stay are kept, new ones start on the central path.
  void list_again() {
    const Multipliers old{std::move(b_.pairs), std::move(b_.y)};
    b_.unit = diameter_mean(p_);
    reach_ = std::max(t_.least_reach * b_.unit, std::min(reach_, t_.reach_per_move * recent_));
    list_pairs();
    b_.y = carry_over(old.pairs, old.y, b_.pairs);
    for (size_t k = 0; k < b_.y.size(); ++k)
      if (b_.y[k] == 0.0) b_.y[k] = b_.mu / b_.lp.c[k];
  }

  void list_pairs() {
    b_.pairs = select_neighbours(p_, reach_, 1.0, t_);
    b_.linearise(p_);
    const size_t rows = b_.pairs.size(), unknowns = b_.lp.unknowns();
    travelled_ = grown_ = 0.0;
    matrix_.reset(rows, unknowns);
    for (auto *v : {&target_, &row_}) v->resize(rows);
    for (auto *v : {&unbalanced_, &rhs_}) v->assign(unknowns, 0.0);
    for (auto *x : {&main_, &trial_}) x->s.resize(unknowns), x->w.resize(rows), x->y.resize(rows);
  }

  // Rows and residuals at the true distances. False when a gap is no longer positive: the caller stops.
  bool linearise() {
    if (!b_.linearise(p_)) return false;
    double sum = 0.0, scale = 0.0, worst = 0.0;
    for (size_t k = 0; k < b_.y.size(); ++k) {
      const double c = b_.lp.c[k], *a = &b_.lp.a[k * p_.dim];
      b_.y[k] = std::min(std::max(b_.y[k], b_.mu / (Tuning::centrality * c)), Tuning::centrality * b_.mu / c);
      sum += b_.y[k];
      scale += b_.y[k] * std::sqrt(squared(a, p_.dim));
    }
    gap_ = b_.duality_gap();
    rest_ = 1.0 - sum;
    transpose_times(b_.lp, b_.y.data(), unbalanced_.data());
    const size_t spheres = b_.lp.spheres();
    for (size_t k = 0; k < spheres; ++k) worst = std::max(worst, std::fabs(unbalanced_[k]));
    balance_ = worst * static_cast<double>(spheres) / scale;
    for (size_t k = spheres; k < unbalanced_.size(); ++k) balance_ = std::max(balance_, std::fabs(unbalanced_[k]));
    balance_ = std::max(balance_, std::fabs(rest_));
    return std::isfinite(gap_) && std::isfinite(balance_);
  }

  // Direction for changes target_ of the products y c that also takes the force balance and sum y = 1 up. False when
  // not found.
  bool solve(BarrierStep &out) {
    double h = rest_;
    for (size_t k = 0; k < b_.y.size(); ++k) {
      row_[k] = target_[k] / b_.lp.c[k];
      h -= row_[k];
    }
    transpose_times(b_.lp, row_.data(), rhs_.data());
    for (size_t k = 0; k < rhs_.size(); ++k) rhs_[k] += unbalanced_[k];
    if (!matrix_.solve(rhs_.data(), h, out.s.data(), &out.g)) return false;
    rows_times(b_.lp, out.s.data(), out.w.data());
    for (size_t k = 0; k < b_.y.size(); ++k) {
      out.w[k] -= out.g;
      out.y[k] = row_[k] - matrix_.weight()[k] * out.w[k];
    }
    return true;
  }

  // The direction at this mu, or where that is centred at the next. False when not found.
  bool aim() {
    const double rows = static_cast<double>(b_.y.size());
    for (bool at_next_mu = false;; at_next_mu = true) {
      for (size_t k = 0; k < b_.y.size(); ++k) target_[k] = b_.mu - b_.y[k] * b_.lp.c[k];
      if (!solve(main_)) return false;
      decrement_ = b_.decrement(main_);
      if (at_next_mu || !schedule_.centred(decrement_, rows)) break;
      b_.mu *= t_.reduction;
    }
    return std::isfinite(b_.longest_move(main_)) && std::isfinite(main_.g);
  }

  bool newton() {
    b_.mu *= schedule_.next_factor(decrement_, alpha_p_, first_mu_ / b_.mu);
    // The proximal term fixes translations and lets no sphere run far for a gain below the gap.
    matrix_.weigh(p_, b_, gap_ / static_cast<double>(p_.n()));
    if (!matrix_.factorise(gap_) || !aim()) return false;
    move(correct());
    return alpha_p_ > 0.0;
  }

  // Gondzio's correctors with the true gaps in place of the linear ones: one triangular solve pulls products y c of
  // rows that cut a step short back into a band around mu. Returns the length of the best step.
  double correct() {
    BarrierProblem::Best best = b_.search(main_);
    const double band = CorrectorTuning::band, ahead = CorrectorTuning::ahead;
    for (correctors_ = 0; correctors_ < t_.max_correctors && best.alpha < t_.whole_step; ++correctors_) {
      const double aim = std::min(1.0, best.alpha + ahead), aim_dual = std::min(1.0, b_.longest_dual(main_) + ahead);
      for (size_t k = 0; k < b_.y.size(); ++k) {
        const double product = b_.gap_after(main_, k, aim) * (b_.y[k] + aim_dual * main_.y[k]);
        const double inside = std::min(std::max(product, b_.mu / band), band * b_.mu);
        target_[k] += std::min(band * b_.mu, std::max(inside - product, -band * b_.mu));
      }
      solve(trial_);
      const BarrierProblem::Best other = b_.search(trial_);
      if (!(other.merit < best.merit)) break;
      best = other;
      std::swap(main_, trial_);
    }
    return best.alpha;
  }

  // Unlisted pairs are farther apart than sigma_ij + reach when the list is made; while twice the distance travelled
  // plus the growth of the largest diameter, and what strains take off the distance, stays below reach, none of them
  // can overlap.
  void move(double alpha) {
    const double length = b_.longest_move(main_) * b_.unit, widest = contact_distance_max(p_),
                 growth = std::max(0.0, 0.5 * main_.g) * widest + b_.strain_norm(main_) * (reach_ + widest);
    alpha_p_ =
        std::min(alpha, WorkingSetTuning::of_screened * (reach_ - 2.0 * travelled_ - grown_) / (2.0 * length + growth));
    if (b_.lp.strains > 0) alpha_p_ *= strain_part(p_.dim, b_.strain_of(main_, alpha_p_));
    alpha_d_ = b_.longest_dual(main_);
    for (size_t k = 0; k < b_.y.size(); ++k) b_.y[k] += alpha_d_ * main_.y[k];
    move_packing(p_, b_.pairs, main_.s.data(), alpha_p_ * b_.unit, std::sqrt(1.0 + alpha_p_ * main_.g),
                 b_.strain_of(main_, alpha_p_));
    const double step = alpha_p_ * length;
    last_step_ = step / b_.unit;
    travelled_ += step;
    grown_ += alpha_p_ * growth;
    recent_ = std::max(step, 0.5 * recent_);
    if (2.0 * (travelled_ + 2.0 * step) + grown_ + 2.0 * alpha_p_ * growth > reach_) {
      if (linearise()) list_again();
    }
  }

  bool report() {
    jam_progress progress = progress_of(JAM_PHASE_CRUNCH);
    progress.packing_fraction = packing_fraction(p_);
    if (control_.done)
      progress.fraction = control_.done(log_share(first_mu_, b_.mu, b_.mu * std::min(1.0, end_ / gap_)));
    progress.gain = gap_;
    progress.max_step = last_step_;
    progress.steps = control_.lps;
    progress.factorisations = system_.factorisations;
    return monitor_.report(progress);
  }

  Packing &p_;
  const BarrierPathControl control_;
  NewtonSystem &system_;
  Monitor &monitor_;
  const Tuning &t_ = control_.tuning;
  BarrierProblem b_;
  BarrierStep main_, trial_;
  BarrierSchedule schedule_{t_};
  PathMatrix matrix_{system_, control_.threads, t_.single};
  std::vector<double> target_, row_, unbalanced_, rhs_;
  double reach_ = 0.0, travelled_ = 0.0, grown_ = 0.0, recent_ = 0.0;
  double first_mu_ = 0.0, end_ = 0.0, gap_ = 0.0, balance_ = 0.0, rest_ = 0.0;
  double alpha_p_ = 0.0, alpha_d_ = 0.0, last_step_ = 0.0, decrement_ = 0.0;
  int correctors_ = 0;
};

}  // namespace

BarrierPathResult follow_barrier_path(Packing &p, const BarrierPathControl &control, NewtonSystem &system,
                                      Monitor &monitor) {
  return BarrierPath(p, control, system, monitor).run();
}

}  // namespace jam::inside
