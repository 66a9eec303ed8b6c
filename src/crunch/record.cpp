#include "crunch/record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/archive.hpp"
#include "core/limits.hpp"
#include "core/pair_rule.hpp"
#include "crunch/approach/active_set.hpp"

namespace jam::inside {
namespace {

struct Spread {
  double largest = 0.0, mean_square = 0.0;
};

// Of the displacements x (n, d) without their mean: a translation of all spheres means nothing. With `coordination`
// only spheres that have a contact count.
Spread spread(const std::vector<double> &x, int dim, double unit, const std::vector<int32_t> *coordination = nullptr) {
  const size_t n = x.size() / static_cast<size_t>(dim);
  const auto counts = [&](size_t i) { return !coordination || (*coordination)[i] > 0; };
  std::array<double, JAM_MAX_DIM> mean{};
  double number = 0.0;
  for (size_t i = 0; i < n; ++i) number += counts(i);
  for (size_t k = 0; k < x.size(); ++k) mean[k % dim] += counts(k / dim) ? x[k] / number : 0.0;
  Spread out;
  double sum = 0.0;
  for (size_t i = 0; i < n; ++i) {
    if (!counts(i)) continue;
    double r2 = 0.0;
    for (int c = 0; c < dim; ++c) r2 += (x[i * dim + c] - mean[c]) * (x[i * dim + c] - mean[c]);
    sum += r2, out.largest = std::max(out.largest, r2);
  }
  out.largest = std::sqrt(out.largest) / unit;
  out.mean_square = sum / (number * unit * unit);  // not a number without a sphere
  return out;
}

}  // namespace

void History::begin(const Packing &start, bool details, int64_t keep) {
  details_ = details;
  rows_.clear();
  rows_.reserve(64);
  kept_.begin(start, keep);
  reached_ = start;
  total_.assign(start.position.size(), 0.0);
  last_ = total_;
  seconds_ = 0.0, factorisations_ = 0;
  step_ = CrunchStep();
}

HistoryRow &History::moved(const Packing &now, jam_step_phase phase, double seconds, int factorisations,
                           const double *displacement) {
  for (size_t k = 0; k < last_.size(); ++k)
    last_[k] = displacement ? displacement[k] : now.position[k] - reached_.position[k];
  for (size_t i = 0; !displacement && i < now.n(); ++i) now.cell.nearest(&last_[i * static_cast<size_t>(now.dim)]);
  for (size_t k = 0; k < last_.size(); ++k) total_[k] += last_[k];
  HistoryRow row;
  row.fill(std::numeric_limits<double>::quiet_NaN());
  const double unit = diameter_mean(now);
  const Spread step = spread(last_, now.dim, unit), total = spread(total_, now.dim, unit);
  row[JAM_HISTORY_STEP_MAX] = step.largest, row[JAM_HISTORY_STEP_MSD] = step.mean_square;
  row[JAM_HISTORY_TOTAL_MAX] = total.largest, row[JAM_HISTORY_TOTAL_MSD] = total.mean_square;
  row[JAM_HISTORY_PHASE] = phase;
  const double before = reached_.diameter.front();
  row[JAM_HISTORY_GAIN] = (now.diameter.front() - before) / before;
  row[JAM_HISTORY_PHI] = packing_fraction(now);
  row[JAM_HISTORY_SECONDS] = seconds - seconds_;
  row[JAM_HISTORY_FACTORISATIONS] = row[JAM_HISTORY_ITERATIONS] = factorisations - factorisations_;
  rows_.push_back(row);
  kept_.add(now, static_cast<int64_t>(rows_.size()));
  reached_ = now;
  seconds_ = seconds, factorisations_ = factorisations;
  if (details_) {
    step_.displacement = last_;
    if (phase != JAM_STEP_LP) step_.pair.clear(), step_.vector.clear(), step_.multiplier.clear();
  }
  return rows_.back();
}

void History::displaced(const Packing &now, const std::vector<int32_t> *coordination, double &largest,
                        double &rms) const {
  std::vector<double> x(total_), last(now.dim);
  for (size_t i = 0; i < now.n(); ++i) {  // and what has moved since the last row
    for (int c = 0; c < now.dim; ++c) last[c] = now.position[i * now.dim + c] - reached_.position[i * now.dim + c];
    now.cell.nearest(last.data());
    for (int c = 0; c < now.dim; ++c) x[i * now.dim + c] += last[c];
  }
  const Spread s = spread(x, now.dim, diameter_mean(now), coordination);
  largest = s.largest, rms = std::sqrt(s.mean_square);
}

void History::over_stable(const std::vector<int32_t> &coordination, int dim, double unit) {
  HistoryRow &row = rows_.back();
  row[JAM_HISTORY_STEP_MSD_STABLE] = spread(last_, dim, unit, &coordination).mean_square;
  row[JAM_HISTORY_TOTAL_MSD_STABLE] = spread(total_, dim, unit, &coordination).mean_square;
}

void History::take_network(const Packing &p, const PackingLp &lp, const LpSolution &answer) {
  const std::vector<char> on = force_carrying(lp, answer, 0.0);
  const PairList &pairs = *lp.pairs;
  double r[JAM_MAX_DIM];
  step_.pair.clear(), step_.vector.clear(), step_.multiplier.clear();
  for (size_t k = 0; k < on.size(); ++k) {
    if (!on[k] || !(answer.y[k] > 0.0))
      continue;  // a contact without force, which Clp's vertices may have, is not in the balance
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
    pair_vector(p, pairs, k, r);
    step_.pair.push_back(pairs.i[k]), step_.pair.push_back(pairs.j[k]);
    step_.vector.insert(step_.vector.end(), r, r + p.dim);
    step_.multiplier.push_back(answer.y[k] / (sigma * sigma));
  }
}

void KeptSteps::begin(const Packing &start, int64_t most) {
  const int64_t room = limits::kept_coordinates / static_cast<int64_t>(start.position.size());
  most_ = std::min(most, std::max<int64_t>(1, room));
  every_ = 1;
  kept_.clear();
  add(start, 0);
}

void KeptSteps::add(const Packing &now, int64_t step) {
  if (most_ == 0 || step % every_ != 0) return;
  kept_.push_back({step, now.diameter.front(), packing_fraction(now), now.cell,
                   std::vector<float>(now.position.begin(), now.position.end())});
  while (static_cast<int64_t>(kept_.size()) > most_) {
    every_ *= 2;
    kept_.erase(std::remove_if(kept_.begin(), kept_.end(), [&](const KeptStep &k) { return k.step % every_ != 0; }),
                kept_.end());
  }
}

static void archive(CrunchStage &s, Archive &a) {
  a(s.path.mu), a(s.path.first_mu), a(s.path_taken), a(s.cell_free);
  if (a.reading() ? a.more() : s.decompressions > 0) a(s.decompressions);  // files of 1.0.0 end before it
  Archive::check(s.path.mu >= 0.0 && s.path.mu <= s.path.first_mu && std::isfinite(s.path.first_mu));
}

std::string CrunchStage::bytes() const {
  CrunchStage copy = *this;
  Archive a;
  archive(copy, a);
  return a.bytes();
}

CrunchStage CrunchStage::of(const std::string &bytes) {
  CrunchStage stage;
  Archive a(bytes);
  archive(stage, a);
  a.end();
  return stage;
}

}  // namespace jam::inside
