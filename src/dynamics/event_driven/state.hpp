// The engine: reading its state, and giving observers the ways of the spheres.
#pragma once
#include <algorithm>

#include "core/create.hpp"
#include "core/error.hpp"
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

}  // namespace jam::inside
