#include "radii/vertex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cell_change.hpp"
#include "core/math.hpp"
#include "linalg/dot.hpp"
#include "radii/tuning.hpp"

namespace jam::inside {

double radii_unit(const Packing &p) {
  return math::pow(scene_volume(p) / static_cast<double>(p.n()), 1.0 / static_cast<double>(p.dim));
}

std::vector<double> strain_of(const RadiiBounds &bounds, const std::vector<double> &x, double part) {
  if (bounds.strains() == 0) return {};
  return strain_matrix(bounds.strain, {x.end() - bounds.strain.count(), x.end()}, part);
}

void move_radii(const Packing &from, const std::vector<double> &x, double part, const RadiiBounds &bounds,
                Packing &to) {
  const size_t d = static_cast<size_t>(from.dim);
  const bool strained = bounds.strains() > 0;
  if (strained) {
    PairList none;
    to.position = from.position, to.cell = from.cell, to.container = from.container;
    strain_at_fixed_volume(to, none, strain_of(bounds, x, part), bounds.volume);
  }
  const std::vector<double> &begin = strained ? to.position : from.position;
  for (size_t i = 0; i < from.n(); ++i) {
    for (size_t c = 0; c < d; ++c) to.position[i * d + c] = begin[i * d + c] + part * x[i * (d + 1) + c];
    to.diameter[i] = from.diameter[i] + 2.0 * part * x[i * (d + 1) + d];
  }
}

RadiiPath::RadiiPath(Packing &p, RadiiGoal &goal, const RadiiBounds &bounds, int threads)
    : p_(p), goal_(goal), bounds_(bounds), threads_(threads), unit_(radii_unit(p)), trial_(p) {
  renew();
}

void RadiiPath::renew() {
  if (bounds_.strains() > 0) shorten_cell(p_, notes);
  wrap_positions(p_);
  rows_ = RadiiRows(p_, bounds_, RadiiTuning::reach * unit_);
  moved_ = 0.0;
}

double RadiiPath::first_mu() const {
  double weights = 0.0, sum = 0.0;
  for (const double w : goal_.weight()) weights += w;
  for (size_t k = 0; k < rows_.pairs.size(); ++k)
    rows_.parts(k, [&](int32_t, double, double radial) { sum -= radial / rows_.gap[k]; });
  return sum > 0.0 ? weights / sum : unit_;
}

// Half of what x takes off the gap of an unlisted pair at most: |s| + |t| of a sphere, and for a strain its norm times
// half the least distance of such a pair. Of pairs farther apart the same share of the distance leaves wider gaps.
double RadiiPath::longest_of(const std::vector<double> &x) const {
  const size_t b = rows_.block();
  double most = 0.0;
  for (size_t i = 0; i < p_.n(); ++i)
    most = std::max(most, std::sqrt(squared(&x[i * b], p_.dim)) + std::fabs(x[i * b + b - 1]));
  if (bounds_.strains() == 0) return most;
  return most + 0.5 * norm(strain_of(bounds_, x, 1.0)) * (RadiiTuning::reach * unit_ + diameter_max(p_));
}

// Newton's direction, its slope and the decrement.
void RadiiPath::direction(double mu) {
  const size_t m = rows_.size(), b = rows_.block();
  goal_.linearise(p_);
  weights_.resize(m), force_.resize(m);
  for (size_t k = 0; k < m; ++k) force_[k] = mu / rows_.gap[k], weights_[k] = force_[k] / rows_.gap[k];
  rows_.transpose_times(force_, gradient_);
  for (size_t i = 0; i < p_.n(); ++i) gradient_[i * b + b - 1] += goal_.weight()[i];
  multiplier_.resize(goal_.equations());
  std::vector<double> bending(rows_.linear() < m ? p_.n() * (b - 1) * (b - 1) : 0);
  for (size_t k = rows_.linear(); k < m; ++k)
    rows_.bending(p_, rows_.facing(k), [&](int u, int v, double share) {
      const size_t i = static_cast<size_t>(rows_.pairs.i[rows_.facing(k)]);
      bending[(i * (b - 1) + u) * (b - 1) + v] += 2.0 / mu * force_[k] * force_[rows_.facing(k)] * share;
    });
  matrix.factorise(rows_, weights_, goal_.columns(), RadiiTuning::ridge, threads_, goal_.stiffness(p_, multiplier_),
                   bending);
  step_ = gradient_;
  multiplier_ = matrix.solve(step_);
  slope_ = 0.0;
  for (size_t q = 0; q < step_.size(); ++q) slope_ += gradient_[q] * step_[q];
  largest_ = longest_of(step_);
  decrement_ = slope_ / mu;
  rows_.times(step_, change_);
}

double RadiiPath::longest_feasible() const {
  double nearest = 1.0 / RadiiTuning::to_boundary;
  for (size_t k = 0; k < change_.size(); ++k)
    if (change_[k] < 0.0) nearest = std::min(nearest, -rows_.gap[k] / change_[k]);
  // Unlisted pairs stay apart: their gaps shrink by twice the step at most.
  const double listed = 0.5 * (RadiiTuning::reach * unit_ - moved_) / std::max(largest_, 1e-300);
  return std::min(RadiiTuning::to_boundary * nearest, RadiiTuning::to_boundary * listed);
}

// The trial. Where moments curve it is corrected by the motions that the rows stop least. False where no radii near it
// keep the equations, or spheres would move farther than the rows are listed.
bool RadiiPath::place(double part) {
  move_radii(p_, step_, part, bounds_, trial_);
  corrected_ = 0.0;
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < RadiiTuning::corrections && goal_.equations() > 0; ++k) {
    if (!(*std::min_element(trial_.diameter.begin(), trial_.diameter.end()) > 0.0)) return false;
    const double now = goal_.residual(trial_);
    if (now <= RadiiTuning::kept) break;
    if (!(now < before)) return false;
    before = now;
    std::vector<double> length = goal_.wrong(trial_), x(step_.size());
    for (double &v : length) v = -v;
    matrix.solve(x, length);
    move_radii(Packing(trial_), x, 1.0, bounds_, trial_);
    corrected_ += longest_of(x);
  }
  return moved_ + 2.0 * (part * largest_ + corrected_) < RadiiTuning::reach * unit_;
}

// Of the function along the step; -infinity behind a row.
double RadiiPath::ascent(double part, double mu) {
  if (!place(part)) return -std::numeric_limits<double>::infinity();
  rows_.measure_gaps(trial_, trial_gap_);
  double sum = 0.0;
  for (size_t k = 0; k < trial_gap_.size(); ++k) {
    if (!(trial_gap_[k] > 0.0)) return -std::numeric_limits<double>::infinity();
    sum += math::log(trial_gap_[k] / rows_.gap[k]);
  }
  return goal_.gain(step_, part, trial_) + mu * sum;
}

void RadiiPath::move(double part) {
  place(part);
  p_.position.swap(trial_.position), p_.diameter.swap(trial_.diameter);
  std::swap(p_.cell, trial_.cell), std::swap(p_.container, trial_.container);
  moved_ += 2.0 * (part * largest_ + corrected_);
  if (moved_ > 0.5 * RadiiTuning::reach * unit_) return renew();
  rows_.measure(p_);
}

bool RadiiPath::centre(double mu, int64_t max_steps, Monitor &monitor) {
  for (int k = 0; k < RadiiTuning::steps_at_one_mu; ++k) {
    if (monitor.interrupted() || steps >= max_steps) return false;
    jam_progress shown = progress_of(JAM_PHASE_CRUNCH);
    shown.packing_fraction = packing_fraction(p_), shown.gain = mu / unit_;
    shown.steps = steps, shown.factorisations = matrix.factorisations;
    if (monitor.report(shown)) return false;
    direction(mu);
    ++steps;
    double part = longest_feasible();
    while (part > RadiiTuning::shortest && !(ascent(part, mu) >= RadiiTuning::least_ascent * part * slope_))
      part *= 0.5;
    if (!(part > RadiiTuning::shortest)) break;  // rounding: the maximum is reached
    if (decrement_ < RadiiTuning::decrement) {
      for (size_t q = 0; q < force_.size(); ++q) force_[q] *= 1.0 - change_[q] / rows_.gap[q];
      return true;
    }
    if (part >= RadiiTuning::to_boundary)
      for (int q = 0; q < RadiiTuning::longer; ++q) {
        const double longer = 2.0 * part;
        if (moved_ + 2.0 * longer * largest_ >= RadiiTuning::reach * unit_ || !(ascent(longer, mu) > ascent(part, mu)))
          break;
        part = longer;
      }
    move(part);
  }
  for (size_t q = 0; q < force_.size(); ++q) force_[q] = mu / rows_.gap[q];
  return true;
}

}  // namespace jam::inside
