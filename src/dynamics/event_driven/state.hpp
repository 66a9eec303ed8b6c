// The engine: reading its state, and telling observers the ways of the spheres.
#pragma once
#include <algorithm>

#include "core/error.hpp"
#include "core/pairs.hpp"
#include "dynamics/event_driven/engine.hpp"

namespace jam {

template <int D, bool Shift>
double Engine<D, Shift>::worst_overlap() const {
  double worst = 0.0;
  for (int32_t i = 0; i < n_; ++i)
    each_neighbour(i, [&](int32_t k, const int64_t *offset) {
      const Body<D> &a = body_[i], &b = body_[k];
      const double sigma = static_cast<double>(contact_sum(a, b)) * (1.0 + rate_ * now_);
      double r2 = 0.0;
      for (int c = 0; c < D; ++c) {
        const double r =
            static_cast<double>(difference(a, b, c, offset)) + a.v[c] * (now_ - a.time) - b.v[c] * (now_ - b.time);
        r2 += r * r;
      }
      if (r2 > sigma * sigma * (1.0 + 1e-6)) return;
      const double gap = exact_gap(a, b, offset) / (sigma * sigma);
      worst = std::max(worst, -gap / (1.0 + std::sqrt(std::max(0.0, 1.0 + gap))));
    });
  return worst;
}

template <int D, bool Shift>
void Engine<D, Shift>::write_state(Packing &p, double ahead) const {
  const double now = now_ + ahead, factor = rate_ * now, side = cell_of_packing_.side();
  for (int32_t i = 0; i < n_; ++i) {
    const size_t u = static_cast<size_t>(user_[i]);
    const Body<D> &b = body_[i];
    Place x;
    for (int c = 0; c < D; ++c) {
      x[c] = b.x[c] + static_cast<uint64_t>(std::llrint(b.v[c] * (now - b.time)));
      p.velocity[u * D + c] = b.v[c] * unit;
    }
    if constexpr (Shift) lattice_.wrap(x);
    double *position = &p.position[u * D];
    for (int c = 0; c < D; ++c)
      position[c] = (Shift ? static_cast<double>(static_cast<int64_t>(x[c])) : static_cast<double>(x[c])) * unit * side;
    cell_of_packing_.wrap(position);
    const int64_t radius = wrapping_sum(b.radius, std::llrint(static_cast<double>(b.radius) * factor + left_over_[i]));
    if (options_.growth > 0.0) p.diameter[u] = 2.0 * unit * static_cast<double>(radius) * side;
  }
}

// In a build that asks for it: no pair at all overlaps, in the lists or not. The search is that of core/pairs, which
// knows nothing of the lists here; positions as doubles are good to 1e-15 of a diameter or better.
template <int D, bool Shift>
void Engine<D, Shift>::check_pairs() const {
#ifdef JAM_CHECK_PAIRS
  if (sums.collisions == 0 || sums.events < next_check_) return;  // overlaps of the start are the caller's
  next_check_ = sums.events + 32 * static_cast<int64_t>(n_);
  Packing p = start_;
  write_state(p);
  const ClosestPair worst = closest_pair(p);
  if (worst.gap < -1e-11)
    fail(JAM_E_INTERNAL, "spheres %d and %d overlap by %g after %lld collisions", worst.i, worst.j, -worst.gap,
         static_cast<long long>(sums.collisions));
#endif
}

// Tells the observer the way of sphere i since its list was made, before that place moves; no way is half a box long.
template <int D, bool Shift>
void Engine<D, Shift>::note_path(int32_t i) const {
  double *travel = observer_->travel(user_[i]);
  const Body<D> &b = body_[i];
  for (int c = 0; c < D; ++c)
    travel[c] += (static_cast<double>(static_cast<int64_t>(b.x[c] - centre_[i][c])) + b.v[c] * (now_ - b.time)) * unit;
}

template <int D, bool Shift>
void Engine<D, Shift>::observe(Observer *observer) {
  if (observer_)
    for (int32_t i = 0; i < n_; ++i) note_path(i);
  observer_ = observer;
  if (!observer) return;
  for (int32_t i = 0; i < n_; ++i) {
    double *travel = observer->travel(user_[i]);
    const Body<D> &b = body_[i];
    for (int c = 0; c < D; ++c)
      travel[c] -=
          (static_cast<double>(static_cast<int64_t>(b.x[c] - centre_[i][c])) + b.v[c] * (now_ - b.time)) * unit;
  }
}

template <int D, bool Shift>
void Engine<D, Shift>::displacements(std::vector<double> &out) const {
  for (int32_t i = 0; i < n_; ++i) {
    const size_t u = static_cast<size_t>(user_[i]);
    const Body<D> &b = body_[i];
    for (int c = 0; c < D; ++c)
      out[u * D + c] =
          observer_->travel(user_[i])[c] +
          (static_cast<double>(static_cast<int64_t>(b.x[c] - centre_[i][c])) + b.v[c] * (now_ - b.time)) * unit;
  }
}

}  // namespace jam
