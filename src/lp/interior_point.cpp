#include "lp/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linalg/dot.hpp"

namespace jam::inside {
namespace {

// Spheres with at most d working-set rows get their rows_per_dim * d tightest rows: else they would run until they meet
// a screened one.
void add_rows_of_loose_spheres(const PackingLp &lp, std::vector<char> &taken) {
  std::vector<int32_t> degree(lp.n, 0);
  std::vector<std::vector<size_t>> rows(lp.n);
  for (size_t k = 0; k < taken.size(); ++k)
    if (taken[k]) for_spheres(lp.pairs->i[k], lp.pairs->j[k], [&](int32_t v) { ++degree[v]; });
  for (size_t k = 0; k < taken.size(); ++k)
    for_spheres(lp.pairs->i[k], lp.pairs->j[k], [&](int32_t v) {
      if (degree[v] <= lp.dim) rows[v].push_back(k);
    });
  const auto tighter = [&](size_t a, size_t b) { return lp.c[a] != lp.c[b] ? lp.c[a] < lp.c[b] : a < b; };
  for (auto &of : rows) {
    const size_t most = std::min(of.size(), WorkingSetTuning::rows_per_dim * static_cast<size_t>(lp.dim));
    std::partial_sort(of.begin(), of.begin() + most, of.end(), tighter);
    for (size_t q = 0; q < most; ++q) taken[of[q]] = 1;
  }
}

}  // namespace

using Rules = InteriorPointTuning;
using W = WorkingSetTuning;

// Nothing moved yet: s = 0 and g below the smallest gap, so that all slacks are positive. Cold, y is on the central
// path of that point; warm, sum y c with the multipliers of the LP before bounds the gain, and that is how near the end
// of the path the start is. Returns the mean product.
double InteriorPoint::first_point() {
  const PackingLp &lp = *lp_;
  const double smallest = *std::min_element(lp.c.begin(), lp.c.end());
  std::vector<double> sorted = lp.c;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  double slack = std::max(Rules::first_slack * (sorted[sorted.size() / 2] - smallest),
                          Rules::slack_per_bound * (box_ ? std::min(1.0, lp.bound) : 1.0));
  double sum = 0.0, gain = 0.0;
  if (control_.multipliers)
    for (size_t q = 0; q < rows_; ++q) {
      y_[q] = (*control_.multipliers)[split_.index[q]];
      sum += y_[q], gain += y_[q] * (lp.c[q] - smallest);
    }
  if (sum > 0.0) slack = std::min(slack, std::max(Rules::ahead * gain / sum, Rules::least_slack));
  g_ = smallest - slack;
  for (size_t q = 0; q < rows_; ++q) w_[q] = lp.c[q] - g_;
  return centre_multipliers(y_, w_, static_cast<double>(rows_));
}

// The bounds share the mean product.
void InteriorPoint::start() {
  split_.choose(*whole_);
  lp_ = &split_.lp;
  const PackingLp &lp = *lp_;
  system_.set_graph(lp.dim, lp.n, split_.pairs, control_.threads);
  system_.set_strain(lp.strain.data(), lp.strains);
  box_ = std::isfinite(lp.bound);
  rows_ = lp.rows();
  unknowns_ = lp.unknowns();
  for (auto *v : {&s_, &rd_, &diagonal_, &rhs_, &targets_u_, &targets_v_}) v->assign(unknowns_, 0.0);
  for (auto *v : {&y_, &w_, &rp_, &weight_, &row_, &targets_}) v->assign(rows_, 0.0);
  for (auto *d : {&main_, &extra_, &trial_}) d->resize(rows_, unknowns_);
  const double mu = first_point();
  const double z = box_ ? mu / lp.bound : 0.0;
  gap_scale_ = mu * static_cast<double>(rows_);
  u_.assign(unknowns_, lp.bound);
  v_.assign(unknowns_, lp.bound);
  zu_.assign(unknowns_, z);
  zv_.assign(unknowns_, z);
  update_screened();
}

// a . (s_i - s_j) + b . e of a row outside the normal equations.
double InteriorPoint::screened_row(size_t k, const std::vector<double> &s) const {
  return whole_->change(k, s.data(), s.data() + s.size() - static_cast<size_t>(whole_->strains));
}

void InteriorPoint::update_screened() {
  screened_w_.resize(split_.screened.size());
  for (size_t q = 0; q < screened_w_.size(); ++q)
    screened_w_[q] = whole_->c[split_.screened[q]] - g_ + screened_row(split_.screened[q], s_);
}

double InteriorPoint::longest_screened(const Direction &x, double wanted) {
  double step = wanted;
  crossed_.clear();
  for (size_t q = 0; q < screened_w_.size(); ++q) {
    const double dw = screened_row(split_.screened[q], x.s) - x.g;
    if (!(wanted * dw < -W::of_screened * screened_w_[q])) continue;
    step = std::min(step, -W::of_screened * screened_w_[q] / dw);
    crossed_.push_back(q);
  }
  if (step > W::blocks * wanted) crossed_.clear();
  return step;
}

// Screened rows that come near join on the central path, and those that the step would have crossed if they blocked it.
bool InteriorPoint::admit_screened() {
  update_screened();
  const bool close =
      !screened_w_.empty() && *std::min_element(screened_w_.begin(), screened_w_.end()) <= W::joins * split_.threshold;
  if (!close && crossed_.empty()) return false;
  std::vector<char> take(whole_->rows(), 0);
  std::vector<double> w(whole_->rows(), 0.0), y(whole_->rows(), 0.0);
  const double mu = complementarity() / static_cast<double>(rows_ + (box_ ? 2 * unknowns_ : 0));
  std::vector<char> joins(screened_w_.size(), 0);
  for (const size_t q : crossed_) joins[q] = 1;
  for (size_t q = 0; q < screened_w_.size(); ++q) {
    if (!joins[q] && !(close && screened_w_[q] <= W::joins_too * split_.threshold)) continue;
    const size_t k = split_.screened[q];
    take[k] = 1, w[k] = screened_w_[q], y[k] = mu / screened_w_[q];
  }
  for (size_t q = 0; q < rows_; ++q) w[split_.index[q]] = w_[q], y[split_.index[q]] = y_[q];
  split_.join(*whole_, take);
  rows_ = lp_->rows();
  for (auto *v : {&rp_, &weight_, &row_, &targets_}) v->assign(rows_, 0.0);
  for (auto *d : {&main_, &extra_, &trial_}) d->resize(rows_, unknowns_);
  w_.resize(rows_), y_.resize(rows_);
  for (size_t q = 0; q < rows_; ++q) w_[q] = w[split_.index[q]], y_[q] = y[split_.index[q]];
  system_.set_graph(lp_->dim, lp_->n, split_.pairs, control_.threads, true);
  system_.set_strain(lp_->strain.data(), lp_->strains);
  update_screened();
  return true;
}

void InteriorPoint::residuals() {
  system_.transpose_times(lp_->a.data(), y_.data(), rd_.data());
  double scale = 0.0, worst = 0.0, sum = 0.0;
  for (size_t k = 0; k < unknowns_; ++k) {
    rd_[k] += zv_[k] - zu_[k];
    worst = std::max(worst, std::fabs(rd_[k]));
  }
  for (size_t k = 0; k < rows_; ++k) {
    scale += y_[k] * std::sqrt(squared(&lp_->a[k * lp_->dim], lp_->dim));
    sum += y_[k];
  }
  dual_norm_ = scale > 0.0 ? worst * static_cast<double>(unknowns_) / scale : worst;
  rg_ = 1.0 - sum;
  system_.rows_times(lp_->a.data(), s_.data(), row_.data());
  for (size_t k = 0; k < rows_; ++k) {
    rp_[k] = lp_->c[k] + row_[k] - g_ - w_[k];
    // Rounding of this sum is no residual: times a weight of 1e13 it would spoil the force balance.
    if (std::fabs(rp_[k]) < 1e-15 * (std::fabs(lp_->c[k]) + std::fabs(row_[k]) + std::fabs(g_))) rp_[k] = 0.0;
  }
}

double InteriorPoint::complementarity() const {
  double sum = 0.0;
  for (size_t k = 0; k < rows_; ++k) sum += y_[k] * w_[k];
  if (box_)
    for (size_t k = 0; k < unknowns_; ++k) sum += u_[k] * zu_[k] + v_[k] * zv_[k];
  return sum;
}

bool InteriorPoint::converged() const {
  const double gap = complementarity();
  if (dual_norm_ > (gap > control_.tolerance ? Rules::rough_balance : Rules::balance) || std::fabs(rg_) > lp_rounding)
    return false;
  return gap <= control_.tolerance || (control_.early_fraction > 0 && g_ > 0 && gap <= control_.early_fraction * g_);
}

LpSolution InteriorPoint::answer() const {
  LpSolution out;
  out.s = s_, out.g = g_;
  out.strain.assign(s_.end() - whole_->strains, s_.end());
  out.s.resize(s_.size() - out.strain.size());
  out.y.assign(whole_->rows(), 0.0), out.w.assign(whole_->rows(), 0.0);
  for (size_t q = 0; q < rows_; ++q) out.y[split_.index[q]] = y_[q], out.w[split_.index[q]] = w_[q];
  for (size_t q = 0; q < screened_w_.size(); ++q) out.w[split_.screened[q]] = screened_w_[q];
  return out;
}

LpSolution InteriorPoint::solve(const PackingLp &lp, const IpmControl &control, Monitor *monitor) {
  whole_ = &lp;
  control_ = control;
  start();
  LpSolution out;
  const int before = system_.factorisations;
  double best_merit = std::numeric_limits<double>::infinity(), best_balance = best_merit;
  int stalled_iterations = 0;
  // A cold start is at hand where a warm one stalls.
  const int max_stalled = control.multipliers ? Rules::max_stalled_warm : Rules::max_stalled;
  for (;; ++out.iterations) {
    residuals();
    const double gap = complementarity();
    if (monitor)
      monitor->log(JAM_LOG_DEBUG, "ipm %2d gap %.2e balance %.1e sum_y %.1e g %.15f", out.iterations, gap, dual_norm_,
                   rg_, g_);
    if (converged()) {
      out.solved = true;
      break;
    }
    // Rounding prevents further progress. Good enough if the gap is near the tolerance.
    const double merit = gap + std::min(1.0, gap_scale_ * dual_norm_);
    stalled_iterations = merit < Rules::progress * best_merit || dual_norm_ < Rules::progress * best_balance
                             ? 0
                             : stalled_iterations + 1;
    best_merit = std::min(best_merit, merit), best_balance = std::min(best_balance, dual_norm_);
    if (monitor && monitor->interrupted()) break;
    if (stalled_iterations >= max_stalled) {
      out.solved = gap <= Rules::near_gap * control.tolerance && dual_norm_ <= Rules::rough_balance;
      break;
    }
    if (monitor) monitor->expect_factorisations(system_.factorisations);
    weights();
    // Directions from floats leave some imbalance: doubles take it out over the second half of the digits.
    const double least = std::sqrt(control.tolerance);
    if (!factor_.factorise(lp_->a.data(), weight_.data(), diagonal_.data(), gap, least)) break;
    if (!predictor_corrector(main_)) break;
    Steps a = longest(main_);
    if (!std::isfinite(main_.g) || !(a.primal > 0.0) || !(a.dual > 0.0)) break;
    const double keep = 1.0 - std::min(Rules::max_cut, std::max(Rules::least_cut, Rules::cut_per_gap * gap));
    move(main_, {longest_screened(main_, a.primal < 1.0 ? keep * a.primal : 1.0), a.dual < 1.0 ? keep * a.dual : 1.0});
    if (admit_screened() && monitor)
      monitor->log(JAM_LOG_DEBUG, "ipm: %zu of %zu rows in the working set", rows_, lp.rows());
  }
  LpSolution last = answer();
  last.iterations = out.iterations, last.solved = out.solved;
  last.factorisations = system_.factorisations - before;
  return last;
}

double carrying_slack(const std::vector<double> &c, int dim, int32_t n) {
  const size_t rank = static_cast<size_t>(WorkingSetTuning::carrying_rows * dim * n);
  if (rank >= c.size()) return std::numeric_limits<double>::infinity();
  std::vector<double> sorted = c;
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  return sorted[rank];
}

void WorkingSet::choose(const PackingLp &whole) {
  using T = WorkingSetTuning;
  const size_t rows = whole.rows();
  const double slack = carrying_slack(whole.c, whole.dim, whole.n);
  threshold = std::numeric_limits<double>::infinity();
  std::vector<char> taken(rows, 1);
  if (std::isfinite(slack)) {
    const double smallest = *std::min_element(whole.c.begin(), whole.c.end());
    threshold = T::far_slack * (slack - smallest);
    if (std::isfinite(whole.bound)) threshold = std::max(threshold, T::per_bound * whole.bound);
    for (size_t k = 0; k < rows; ++k) taken[k] = whole.c[k] - smallest <= threshold;
    add_rows_of_loose_spheres(whole, taken);
    // Screening only a few saves nothing.
    if (std::count(taken.begin(), taken.end(), 1) > T::nearly_all * static_cast<double>(rows)) taken.assign(rows, 1);
  }
  gather(whole, taken);
}

void WorkingSet::join(const PackingLp &whole, const std::vector<char> &take) {
  std::vector<char> taken = take;
  for (const size_t k : index) taken[k] = 1;
  gather(whole, taken);
}

void WorkingSet::gather(const PackingLp &whole, const std::vector<char> &taken) {
  const size_t d = whole.dim, strains = static_cast<size_t>(whole.strains);
  index.clear(), screened.clear();
  for (size_t k = 0; k < taken.size(); ++k) (taken[k] ? index : screened).push_back(k);
  pairs = PairList();
  lp.dim = whole.dim, lp.n = whole.n, lp.bound = whole.bound;
  lp.pairs = &pairs;
  lp.strains = whole.strains;
  lp.strain.resize(index.size() * strains);
  lp.a.resize(index.size() * d);
  lp.c.resize(index.size());
  for (size_t q = 0; q < index.size(); ++q) {
    const size_t k = index[q];
    pairs.i.push_back(whole.pairs->i[k]);
    pairs.j.push_back(whole.pairs->j[k]);
    lp.c[q] = whole.c[k];
    std::copy(&whole.a[k * d], &whole.a[k * d] + d, &lp.a[q * d]);
    std::copy_n(whole.strain.begin() + k * strains, strains, lp.strain.begin() + q * strains);
  }
}

}  // namespace jam::inside
