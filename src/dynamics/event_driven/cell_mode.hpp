// The engine without lists, for dilute systems, where lists are short-lived. A sphere meets those of the cells around
// its own, and leaving its cell is an event.
#pragma once
#include "core/math.hpp"
#include "dynamics/event_driven/engine.hpp"

namespace jam {

// Cells alone are faster than lists where few spheres share the smallest possible cell. `crowded` is where both were
// equally fast at N = 1024 and 16384; from d = 5 on the cells around one are too many. With five cells a side at least,
// spheres in adjacent cells are less than half a box apart, and no difference wraps to another image.
template <int D, bool Shift>
bool Engine<D, Shift>::choose_cells_alone(double sigma) {
  constexpr double crowded[] = {0.0, 0.0, 0.6, 0.52, 0.48}, fastest = 0.12;  // spheres per cell
  cells_alone_ = 0;
  if (Shift || D > 4 || options_.cells < 0) return false;
  const double most = std::floor((1.0 - 1e-9) / (sigma * (1.0 + margin_)));
  if (most < 5.0 || (options_.cells == 0 && n_ > crowded[std::min(D, 4)] * math::pow(most, D))) return false;
  const double side = std::max(5.0, std::min(most, std::floor(math::pow(n_ / fastest, 1.0 / D))));
  cells_ = static_cast<int64_t>(side);
  cell_range_ = 1;
  margin_ = std::min(0.2, (1.0 - 1e-9) / (sigma * side) - 1.0);  // the rest of the cell is space for growth
  if (rate_ > 0.0) lists_end_ = margin_ * 0.999 / rate_;
  return true;
}

template <int D, bool Shift>
void Engine<D, Shift>::link(int32_t i, size_t cell) {
  cell_next_[i] = cell_first_[cell];
  cell_first_[cell] = i;
}

template <int D, bool Shift>
void Engine<D, Shift>::unlink(int32_t i, size_t cell) {
  int32_t *at = &cell_first_[cell];
  while (*at != i) at = &cell_next_[*at];
  *at = cell_next_[i];
}

// Writes the other spheres in the cells around that of i to found_; returns their number.
template <int D, bool Shift>
int32_t Engine<D, Shift>::gather(int32_t i) const {
  const size_t cells = cells_around(home_of(i));
  int32_t count = 0;
  for (size_t s = 0; s < cells; ++s)
    for (int32_t k = cell_first_[around_[s]]; k >= 0; k = cell_next_[k])
      if (k != i) found_[count++] = k;
  return count;
}

template <int D, bool Shift>
void Engine<D, Shift>::build_cells_alone() {
  cells_alone_ = 1;
  make_scratch();
  size_t total = 1;
  for (int c = 0; c < D; ++c) total *= static_cast<size_t>(cells_);
  cell_first_.assign(total, -1);
  cell_next_.resize(n_);
  cell_.resize(n_);
  for (int32_t i = n_ - 1; i >= 0; --i) {
    for (int c = 0; c < D; ++c)
      cell_[i][c] = static_cast<int32_t>(((centre_[i][c] >> 32) * static_cast<uint64_t>(cells_)) >> 32);
    link(i, cell_of(home_of(i)));
  }
  std::fill(neighbours_.begin(), neighbours_.end(), 0);
  if (capacity_ == 0) widen_lists();
  max_overlap = std::max(max_overlap, worst_overlap());
  check_pairs();
}

// Time from now until sphere i, which stands at now_, leaves its cell, and along which axis.
template <int D, bool Shift>
double Engine<D, Shift>::crossing_time(int32_t i, int *axis) const {
  const Body<D> &b = body_[i];
  const double width = scale / static_cast<double>(cells_);
  double best = never;
  for (int c = 0; c < D; ++c) {
    const double edge = static_cast<double>(cell_[i][c]) * width;
    const double u = static_cast<double>(static_cast<int64_t>(b.x[c] - static_cast<uint64_t>(edge)));
    const double t = b.v[c] > 0.0 ? (width - u) / b.v[c] : b.v[c] < 0.0 ? -u / b.v[c] : never;
    if (t < best) {
      best = t;
      if (axis) *axis = c;
    }
  }
  return std::max(0.0, best);
}

template <int D, bool Shift>
void Engine<D, Shift>::cross(int32_t i) {
  int axis = 0;
  crossing_time(i, &axis);
  unlink(i, cell_of(home_of(i)));
  // The direction of flight decides: by rounding the position may still be inside the old cell.
  int32_t &place = cell_[i][axis];
  place += body_[i].v[axis] > 0.0 ? 1 : -1;
  if (place < 0) place += static_cast<int32_t>(cells_);
  if (place == cells_) place = 0;
  link(i, cell_of(home_of(i)));
  if (observer_) note_path(i);
  for (int c = 0; c < D; ++c) centre_[i][c] = body_[i].x[c];
}

}  // namespace jam
