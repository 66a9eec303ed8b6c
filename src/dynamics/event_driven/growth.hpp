// The engine: how it begins, the moving origin of time, rates of growth, and refreshing.
#pragma once
#include <algorithm>

#include "core/call_scope.hpp"
#include "core/cell_reduction.hpp"
#include "core/math.hpp"
#include "dynamics/event_driven/engine_of.hpp"

namespace jam::inside {

template <int D, Offsets O>
EngineOf<D, O>::EngineOf(const Packing &p, const EngineOptions &o, Archive *from)
    : Units<O>(search_cell(p)),
      options_(o),
      kernel_(pair_kernel<D>(o.instruction_set)),
      cell_of_packing_(p.cell),
      lattice_(search_cell(p), listed ? scale : 0x1p61),
      spheres_(p),
      clock_(p.n()),
      calendar_(p.n()),
      lists_(p.n()),
      found_(p.n()) {
#ifdef JAM_CHECK_PAIRS
  start_ = p;
  if (from) check_code_ = JAM_E_FORMAT;
#endif
  if (listed && p.model == JAM_MODEL_MK)
    mari_kurchan_ = std::make_unique<MariKurchan<D>>(p, lattice_, spheres_.user, scale);
  if (p.container) walls_ = std::make_unique<Walls<D>>(p, lattice_, listed);
  if (from)
    archive(*from);
  else
    begin(p);
}

template <int D, Offsets O>
void EngineOf<D, O>::begin(const Packing &p) {
  using Tuning = ListTuning;
  spheres_.take(p, scale);
  const double fraction = packing_fraction();
  lists_.shell = mari_kurchan_
                     ? Tuning::mari_kurchan_shell
                     : std::min(Tuning::most_first,
                                std::max(Tuning::least_first, Tuning::first_shell - Tuning::per_fraction * fraction));
  if (options_.growth > 0.0) {
    clock_.start_rate(options_.growth * scale / (2.0 * spheres_.mean_radius()), options_.relative != 0);
    // A sphere touches its own image, or the largest contact distance reaches the shortest lattice vector.
    // Two units before it, so that rounding takes no sphere beyond.
    const double widest = spheres_.largest_radius() * spheres_.reach_factor;
    clock_.full_time = std::max(0.0, ((0.5 * scale * lattice_.shortest() - 2.0) / widest - 1.0) / clock_.rate);
    if (options_.target_fraction < never) {
      const double first = static_cast<double>(spheres_.body[0].radius);
      clock_.target_radius = first * math::pow(options_.target_fraction / fraction, 1.0 / D);
      clock_.fraction_time = (clock_.target_radius / first - 1.0) / clock_.rate;
    }
  }
  refresh(1.0, true);
}

// Lists stay, as their ends move with the rate; all events are predicted again.
template <int D, Offsets O>
void EngineOf<D, O>::set_growth(double growth) {
  for (Body<D> &b : spheres_.body) move(b);
  move_origin();
  const double rate = growth / (2.0 * spheres_.mean_radius() * unit);
  clock_.slow(clock_.rate / rate);
  clock_.start_rate(rate, options_.relative != 0);
  renew(1.0, false);
}

template <int D, Offsets O>
double EngineOf<D, O>::packing_fraction() const {
  double sum = 0.0;
  const double grown = 2.0 * unit * clock_.grown();
  for (const Body<D> &b : spheres_.body) {
    double volume = 1.0;
    for (int c = 0; c < D; ++c) volume *= static_cast<double>(b.radius) * grown;
    sum += volume;
  }
  if (walls_) sum *= walls_->share_of_cell;
  return sum * unit_sphere_volume(D);
}

// Sets the origin of time to the present.
template <int D, Offsets O>
void EngineOf<D, O>::move_origin() {
  sums.of_pressure.kinetic_integral += kinetic_.integral_to(clock_.now);
  kinetic_.since = 0.0;
  if (observer_) observer_->stress.template advance<D>(clock_.now, 0.0);
  sums.time += clock_.move_origin(spheres_, calendar_);
}

template <int D, Offsets O>
void EngineOf<D, O>::rebase() {
  move_origin();
  check_pairs();
  if (pace_.choose_shell(sums, in_cell_mode(), lists_))
    renew(1.0, true);
  else
    sort_calendar();
}

// Brings all spheres to the present, scales velocities, remakes lists if requested or needed, predicts everything.
template <int D, Offsets O>
void EngineOf<D, O>::refresh(double velocity_factor, bool lists) {
  for (Body<D> &b : spheres_.body) {
    move(b);
    if (velocity_factor != 1.0)
      for (int c = 0; c < D; ++c) b.v[c] *= velocity_factor;
  }
  move_origin();
  kinetic_.twice = spheres_.twice_kinetic(unit);
  count_momenta();
  if (lists) build_lists();
  if (wants_images_) return;
  for (int32_t i = 0; i < spheres_.n; ++i) calendar_.time(i) = never;
  for (int32_t i = 0; i < spheres_.n; ++i) predict(i);
  sort_calendar();
}

// refresh() of an engine that runs: no callback meanwhile, as it may store the engine. The main loop looks soon after.
template <int D, Offsets O>
void EngineOf<D, O>::renew(double velocity_factor, bool lists) {
  const CallScope quiet(CallScope::memory_limit());
  refresh(velocity_factor, lists);
}

template <int D, Offsets O>
void EngineOf<D, O>::thermalise() {
  kinetic_.twice = spheres_.twice_kinetic(unit);
  if (kinetic_.twice > 0.0) renew(std::sqrt(D * static_cast<double>(spheres_.n) / kinetic_.twice), false);
}

}  // namespace jam::inside
