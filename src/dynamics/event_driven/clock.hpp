// The engine: construction, the moving origin of time, and refreshing.
#pragma once
#include <algorithm>
#include <numeric>

#include "core/math.hpp"
#include "dynamics/event_driven/engine.hpp"

namespace jam {

// Order of the spheres along a Morton curve: neighbours in space are near in memory.
std::vector<int32_t> curve_order(const Packing &p);

template <int D, bool Shift>
Engine<D, Shift>::Engine(const Packing &p, const EngineOptions &o, Archive *from)
    : Units<Shift>(p.cell),
      lattice_(p.cell, Shift ? scale : 0x1p61),
      n_(static_cast<int32_t>(p.n())),
      options_(o),
      kernel_(pair_kernel<D>(o.instruction_set)),
      cell_of_packing_(p.cell),
      non_additivity_(p.non_additivity),
      reach_factor_(1.0 + std::max(0.0, p.non_additivity)),
      body_(p.n()),
      calendar_(p.n()),
      user_(curve_order(p)),
      left_over_(p.n(), 0.0),
      mass_(sphere_masses(p)),
      centre_(p.n()),
      rho_(p.n()),
      safe_(p.n()),
      neighbours_(p.n(), 0) {
  const bool mk = Shift && p.model == JAM_MODEL_MK;
#ifdef JAM_CHECK_PAIRS
  start_ = p;
#endif
  if (mk) {
    quenched_ = std::make_unique<MkShifts>(p);
    prepare_partners();
  }
  if (from) {
    archive(*from);
    return;
  }
  for (int32_t i = 0; i < n_; ++i) {
    const size_t u = static_cast<size_t>(user_[i]);
    Body<D> &b = body_[i];
    for (int c = 0; c < D; ++c) {
      const double x = p.position[u * D + c] / p.cell.side();
      b.x[c] = static_cast<uint64_t>((p.cell.cube() ? wrap(x, 1.0) : x) * scale);
      b.v[c] = p.velocity[u * D + c] * scale;
    }
    b.time = 0.0;
    b.radius = std::llrint(0.5 * p.diameter[u] / p.cell.side() * scale);
  }
  if (!mass_.empty()) {
    std::vector<double> sorted(p.n());
    for (int32_t i = 0; i < n_; ++i) sorted[i] = mass_[user_[i]];
    mass_.swap(sorted);
  }
  const double fraction = packing_fraction();
  shell_ = mk ? 0.2 : std::min(0.36, std::max(0.06, 0.4 - 0.45 * fraction));
  if (o.growth > 0.0) {
    start_rate(o.growth * scale / (2.0 * mean_radius()));
    double largest = 0.0;
    for (const Body<D> &b : body_) largest = std::max(largest, static_cast<double>(b.radius));
    // A sphere touches its own image, or the largest contact distance reaches the shortest lattice vector.
    // Two units before it, so that rounding takes no sphere beyond.
    full_time_ = std::max(0.0, ((0.5 * scale * lattice_.shortest() - 2.0) / (largest * reach_factor_) - 1.0) / rate_);
    if (o.target_fraction < never) {
      target_radius_ = static_cast<double>(body_[0].radius) * math::pow(o.target_fraction / fraction, 1.0 / D);
      fraction_time_ = (target_radius_ / static_cast<double>(body_[0].radius) - 1.0) / rate_;
    }
  }
  refresh(1.0, true);
}

// At an origin of time.
template <int D, bool Shift>
void Engine<D, Shift>::start_rate(double rate) {
  rate_ = rate;
  if (!options_.relative) return;
  relative_rate_ = rate;
  step_end_ = 0.005 / rate;  // linear pieces of half a per cent: the mean relative rate is a quarter of a per cent low
}

// Lists stay, as their ends move with the rate; all events are predicted anew.
template <int D, bool Shift>
void Engine<D, Shift>::set_growth(double growth) {
  for (Body<D> &b : body_) move(b);
  shift_origin();
  const double rate = growth / (2.0 * mean_radius() * unit), slower = rate_ / rate;
  lists_end_ *= slower;
  full_time_ *= slower;
  if (fraction_time_ < never) fraction_time_ *= slower;
  start_rate(rate);
  refresh(1.0, false);
}

template <int D, bool Shift>
double Engine<D, Shift>::mean_radius() const {
  double sum = 0.0;
  for (const Body<D> &b : body_) sum += static_cast<double>(b.radius);
  return sum / n_;
}

template <int D, bool Shift>
double Engine<D, Shift>::packing_fraction() const {
  double sum = 0.0;
  const double grown = 2.0 * unit * (1.0 + rate_ * now_);
  for (const Body<D> &b : body_) {
    double volume = 1.0;
    for (int c = 0; c < D; ++c) volume *= static_cast<double>(b.radius) * grown;
    sum += volume;
  }
  return sum * unit_sphere_volume(D);
}

// Sets the origin of time to now_; what is too small for the integer radii is carried over.
template <int D, bool Shift>
void Engine<D, Shift>::shift_origin() {
  const double t = now_, factor = rate_ * t;
  for (int32_t i = 0; i < n_; ++i) {
    Body<D> &b = body_[i];
    b.time -= t;
    calendar_.time(i) -= t;
    if (factor == 0.0) continue;
    const double add = static_cast<double>(b.radius) * factor + left_over_[i];
    const int64_t whole = std::llrint(add);
    b.radius = wrapping_sum(b.radius, whole);
    left_over_[i] = add - static_cast<double>(whole);
  }
  sums.kinetic_integral += twice_kinetic_ * (now_ - kinetic_time_);
  kinetic_time_ = 0.0;
  lists_end_ -= t;
  full_time_ -= t;
  time_end_ -= t;
  step_end_ -= t;
  rate_ /= 1.0 + factor;
  // Anew from the radii, as differences of times would pile up errors.
  if (target_radius_ > 0.0) {
    const double left = target_radius_ - static_cast<double>(body_[0].radius) - left_over_[0];
    fraction_time_ = std::max(0.0, left / static_cast<double>(body_[0].radius) / rate_);
  }
  sums.time += t;
  now_ = 0.0;
}

template <int D, bool Shift>
void Engine<D, Shift>::rebase() {
  shift_origin();
  check_pairs();
  if (tune_shell())
    refresh(1.0, true);
  else
    sort_calendar();
}

template <int D, bool Shift>
void Engine<D, Shift>::sort_calendar() {
  const double elapsed = sums.time - time_before_;
  const int64_t events = sums.events - events_before_;
  if (events > 2 * n_ && elapsed > 0.0) {
    bucket_width_ = elapsed / static_cast<double>(events);
    time_before_ = sums.time;
    events_before_ = sums.events;
  } else if (bucket_width_ == 0.0) {
    // The median of the times to come. On a lattice most spheres may stand at an edge of their cell and leave it now:
    // then a part of the mean, which costs at most a longer heap.
    constexpr double least_part = 0.1;
    std::vector<double> times;
    double mean = 0.0;
    for (int32_t i = 0; i < n_; ++i)
      if (const double t = calendar_.time(i); t < never) times.push_back(t), mean += t / n_;
    if (!times.empty()) {
      const auto median = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
      std::nth_element(times.begin(), median, times.end());
      bucket_width_ = std::max(*median, least_part * mean) / n_;
    }
  }
  double earliest = never;
  for (int32_t i = 0; i < n_; ++i) earliest = std::min(earliest, calendar_.time(i));
  const double least = 4.0 * earliest / static_cast<double>(calendar_.buckets());
  double width = bucket_width_ < never ? std::max(bucket_width_, least) : least;
  rebase_at_ = sums.events + 8 * static_cast<int64_t>(n_) + 64;
  calendar_.rebuild(0.0, earliest < never && !options_.heap_only ? width : 0.0);
}

// Brings all spheres to now_, scales velocities, remakes lists if asked or needed, predicts everything.
template <int D, bool Shift>
void Engine<D, Shift>::refresh(double velocity_factor, bool lists) {
  for (Body<D> &b : body_) {
    move(b);
    if (velocity_factor != 1.0)
      for (int c = 0; c < D; ++c) b.v[c] *= velocity_factor;
  }
  shift_origin();
  take_kinetic();
  if (lists) build_lists();
  if (wants_images_) return;
  for (int32_t i = 0; i < n_; ++i) calendar_.time(i) = never;
  for (int32_t i = 0; i < n_; ++i) predict(i);
  sort_calendar();
}

// Sum of m v^2 about the centre of mass. One sphere has no motion but this one, so it counts.
template <int D, bool Shift>
void Engine<D, Shift>::take_kinetic() {
  double sum = 0.0, momentum[D] = {};
  for (int32_t i = 0; i < n_; ++i) {
    const double mass = mass_.empty() ? 1.0 : mass_[i];
    for (int c = 0; c < D; ++c) {
      sum += mass * (body_[i].v[c] * unit) * (body_[i].v[c] * unit);
      momentum[c] += mass * (body_[i].v[c] * unit);
    }
  }
  if (n_ > 1)
    for (double m : momentum) sum -= m * m / n_;  // masses have mean 1
  twice_kinetic_ = sum;
}

template <int D, bool Shift>
void Engine<D, Shift>::thermalise() {
  take_kinetic();
  if (twice_kinetic_ > 0.0) refresh(std::sqrt(D * static_cast<double>(n_) / twice_kinetic_), false);
}

}  // namespace jam
