// The engine: reading its state, and giving observers the ways of the spheres.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/limits.hpp"
#include "core/pairs.hpp"
#include "dynamics/event_driven/engine_of.hpp"

namespace jam::inside {

// f(k, offset) for every sphere that i can meet before its exit.
template <int D, Offsets O>
template <class F>
void EngineOf<D, O>::each_neighbour(int32_t i, F &&f) const {
  if (in_cell_mode()) {
    const int32_t found = gather(i);
    for (int32_t e = 0; e < found; ++e) f(found_[e], nullptr);
    return;
  }
  for (int32_t e = 0, m = lists_.count[i]; e < m; ++e) f(lists_.of(i)[e], lists_.offset_of(i, e));
}

template <int D, Offsets O>
double EngineOf<D, O>::worst_overlap() const {
  double worst = 0.0;
  for (int32_t i = 0; i < spheres_.n; ++i)
    each_neighbour(i, [&](int32_t k, const int64_t *offset) {
      const Body<D> &a = spheres_.body[i], &b = spheres_.body[k];
      const double sigma = static_cast<double>(spheres_.contact_sum(a, b)) * clock_.grown();
      double r2 = 0.0;
      for (int c = 0; c < D; ++c) {
        const double r = static_cast<double>(difference(a, b, c, offset)) + a.v[c] * (clock_.now - a.time) -
                         b.v[c] * (clock_.now - b.time);
        r2 += r * r;
      }
      if (r2 > sigma * sigma * (1.0 + 1e-6)) return;
      const double gap = exact_gap(a, b, offset) / (sigma * sigma);
      worst = std::max(worst, -gap / (1.0 + std::sqrt(std::max(0.0, 1.0 + gap))));
    });
  for (int32_t i = 0; walls_ && i < spheres_.n; ++i) {
    Body<D> b = spheres_.body[i];
    for (int c = 0; c < D; ++c) b.x[c] += static_cast<uint64_t>(std::llrint(b.v[c] * (clock_.now - b.time)));
    worst = std::max(worst, walls_->overlap(b, clock_));
  }
  return worst;
}

template <int D, Offsets O>
void EngineOf<D, O>::write_state(Packing &p, double ahead) const {
  const double now = clock_.now + ahead, factor = clock_.rate * now, side = cell_of_packing_.side();
  for (int32_t i = 0; i < spheres_.n; ++i) {
    const size_t u = static_cast<size_t>(spheres_.user[i]);
    const Body<D> &b = spheres_.body[i];
    Place x;
    for (int c = 0; c < D; ++c) {
      x[c] = b.x[c] + static_cast<uint64_t>(std::llrint(b.v[c] * (now - b.time)));
      p.velocity[u * D + c] = b.v[c] * unit;
    }
    if constexpr (listed) lattice_.wrap(x);
    double *position = &p.position[u * D];
    for (int c = 0; c < D; ++c)
      position[c] =
          (listed ? static_cast<double>(static_cast<int64_t>(x[c])) : static_cast<double>(x[c])) * unit * side;
    cell_of_packing_.wrap(position);
    const int64_t radius =
        wrapping_sum(b.radius, std::llrint(static_cast<double>(b.radius) * factor + clock_.left_over[i]));
    if (options_.growth > 0.0) p.diameter[u] = 2.0 * unit * static_cast<double>(radius) * side;
  }
}

// In a build that requests it: no pair at all overlaps, in the lists or not. The search is that of core/pairs, which
// does not use the lists here; positions as doubles are good to 1e-15 of a diameter or better.
template <int D, Offsets O>
void EngineOf<D, O>::check_pairs() const {
#ifdef JAM_CHECK_PAIRS
  if (sums.collisions == 0 || sums.events < next_check_) return;  // overlaps of the start are the caller's
  next_check_ = sums.events + 32 * static_cast<int64_t>(spheres_.n);
  const CallScope quiet(CallScope::memory_limit());  // no callback sees what is half made
  Packing p = start_;
  write_state(p);
  const ClosestPair worst = closest_pair(p);
  const double sharp = std::max(1e-11, overlap_of_long_flights(p));
  if (worst.gap < -sharp)
    fail(check_code_, "spheres %d and %d overlap by %g after %lld collisions", worst.i, worst.j, -worst.gap,
         static_cast<long long>(sums.collisions));
  const ClosestWall wall = closest_wall(p);
  if (wall.gap < -sharp)
    fail(check_code_, "sphere %d overlaps %s by %g after %lld collisions", wall.sphere,
         p.container[wall.w].name().c_str(), -wall.gap, static_cast<long long>(sums.collisions));
#endif
}

// Component of the way of sphere i since its list was made; no way is half a box long.
template <int D, Offsets O>
double EngineOf<D, O>::way(int32_t i, int c) const {
  const Body<D> &b = spheres_.body[i];
  const double to_place = static_cast<double>(static_cast<int64_t>(b.x[c] - lists_.centre[i][c]));
  return (to_place + b.v[c] * (clock_.now - b.time)) * unit;
}

// Gives the way of sphere i to the observer, before the place of its list moves.
template <int D, Offsets O>
void EngineOf<D, O>::note_path(int32_t i) const {
  double *travel = observer_->travel(spheres_.user[i]);
  for (int c = 0; c < D; ++c) travel[c] += way(i, c);
}

// All that spheres carry about the centre of mass, as Spheres::twice_kinetic counts it.
template <int D, Offsets O>
void EngineOf<D, O>::count_momenta() const {
  if (!observer_) return;
  StressSums &stress = observer_->stress;
  double momentum[D] = {};
  stress.restart(kinetic_.since);
  for (int32_t i = 0; i < spheres_.n; ++i) {
    stress.template add<D>(spheres_.mass_of(i) * unit * unit, spheres_.body[i].v);
    for (int c = 0; c < D; ++c)
      if ((spheres_.closed >> c & 1) == 0) momentum[c] += spheres_.mass_of(i) * spheres_.body[i].v[c] * unit;
  }
  if (spheres_.n > 1 || spheres_.closed) stress.template add<D>(-1.0 / spheres_.n, momentum);
}

template <int D, Offsets O>
void EngineOf<D, O>::observe(Observer *observer) {
  if (observer_)
    for (int32_t i = 0; i < spheres_.n; ++i) note_path(i);
  observer_ = observer;
  if (!observer) return;
  count_momenta();
  for (int32_t i = 0; i < spheres_.n; ++i)
    for (int c = 0; c < D; ++c) observer->travel(spheres_.user[i])[c] -= way(i, c);
}

template <int D, Offsets O>
void EngineOf<D, O>::displacements(std::vector<double> &out) const {
  for (int32_t i = 0; i < spheres_.n; ++i) {
    const int32_t u = spheres_.user[i];
    for (int c = 0; c < D; ++c) out[static_cast<size_t>(u) * D + c] = observer_->travel(u)[c] + way(i, c);
  }
}

// The engine to bytes and back: all that the coming events depend on, in one list. What follows from the packing (the
// shifts of the Mari-Kurchan model) is rebuilt.
template <int D, Offsets O>
void EngineOf<D, O>::archive(Archive &a) {
  a(sums);
  a(max_overlap);
  a(options_);
  a(spheres_.user);
  a(spheres_.body);
  calendar_.archive(a, walls_ ? walls_->container.count() : 0);
  a(clock_.now);
  a(clock_.rate);
  a(clock_.relative_rate);
  a(clock_.left_over);
  a(spheres_.mass);
  for (double *t : {&clock_.lists_end, &clock_.fraction_time, &clock_.full_time, &clock_.time_end, &clock_.step_end})
    a(*t);
  a(clock_.target_radius);
  a(kinetic_.since);
  a(kinetic_.twice);
  lists_.archive(a);
  levels_.archive(a, lattice_);
  cell_mode_.archive(a, lattice_);
  pace_.archive(a);
  if (walls_) walls_->archive(a);
  if (a.reading()) {
    options_.instruction_set = InstructionSet::best;  // of this processor, not of the one that wrote
    check_archive();
    if (walls_ && !in_cell_mode())
      for (int32_t i = 0; i < spheres_.n; ++i) walls_->note_centre(i, lists_.centre[i], lists_.rho[i]);
    if (mari_kurchan_) {
      mari_kurchan_->prepare(spheres_.user);
      for (int32_t i = 0; i < spheres_.n; ++i) note_centre(i);
    }
  }
}

// Every index must be in its range, or a damaged file would send the engine astray.
template <int D, Offsets O>
void EngineOf<D, O>::check_archive() {
  const size_t n = static_cast<size_t>(spheres_.n);
  Archive::check(spheres_.user.size() == n && spheres_.body.size() == n && clock_.left_over.size() == n &&
                 (spheres_.mass.empty() || spheres_.mass.size() == n));
  lists_.check(n, scale);
  pace_.check();
  std::vector<char> seen(n, 0);
  for (int32_t u : spheres_.user) {
    Archive::check(u >= 0 && static_cast<size_t>(u) < n && !seen[u]);
    seen[u] = 1;
  }
  for (const double m : spheres_.mass) Archive::check(m > 0.0 && std::isfinite(m));
  for (int32_t i = 0; i < spheres_.n; ++i) {
    const Body<D> &b = spheres_.body[i];
    Archive::check(b.radius > 0 && b.radius <= int64_t{1} << 62 && std::isfinite(b.time));
    // One sphere may hold all the energy, and growth heats.
    const double fastest = 10.0 * limits::velocity_max * std::sqrt(D * spheres_.n / spheres_.mass_of(i));
    for (const double v : b.v) Archive::check(std::fabs(v) <= fastest * scale);
  }
  for (const double part : clock_.left_over) Archive::check(std::isfinite(part));
  for (const double x : {clock_.now, clock_.rate, clock_.relative_rate, kinetic_.twice, sums.time, max_overlap})
    Archive::check(std::isfinite(x));
  for (const int64_t count : {sums.events, sums.collisions})
    Archive::check(count >= 0 && count < int64_t{1} << 60);  // differences are taken of them
  Archive::check(cell_mode_.on == 0 || (!listed && cell_mode_.on == 1));
  if (in_cell_mode()) return cell_mode_.check(spheres_.n, lattice_);
  Archive::check(levels_.all().empty() == (mari_kurchan_ != nullptr));
  levels_.check(lists_.rho, lists_.centre, lattice_);
}

}  // namespace jam::inside
