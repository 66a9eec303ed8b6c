// The engine: neighbour lists, made through the cells of list_cells.hpp.
#pragma once
#include <algorithm>

#include "core/call_scope.hpp"
#include "core/math.hpp"
#include "dynamics/event_driven/engine.hpp"

namespace jam {

// Cells no wider than the longest list reach over cell_range_; none when they would not be worth it.
template <int D, bool Shift>
void Engine<D, Shift>::choose_cells() {
  cells_ = 0;
  constexpr double look = 4.0, look_in_vectors = 0.125;  // at one sphere, in units of tune_shell
  search_cost_ = n_ * (quenched_ ? look_in_vectors : look);
  if constexpr (Shift) return choose_image_cells();
  const double reach = 2.0 * rho_max_ * unit;
  double best = 0.5 * n_;  // in units of tune_shell
  for (int range = 1; range <= 3; ++range) {
    const auto side =
        static_cast<int64_t>(std::min(std::floor(range / reach), std::floor(math::pow(4.0 * n_ + 64.0, 1.0 / D))));
    if (side < 2 * range + 1) continue;
    const double looked_cells = math::pow(2.0 * range + 1.0, D);
    const double cost = looked_cells * 0.5 * (1.0 + n_ / math::pow(static_cast<double>(side), D));
    if (side * reach > range) continue;
    if (cost < best) best = cost, cells_ = side, cell_range_ = range;
  }
  search_cost_ = best;
}

template <int D, bool Shift>
void Engine<D, Shift>::build_lists() {
  double largest = 0.0, mean = mean_radius();
  for (const Body<D> &b : body_) largest = std::max(largest, static_cast<double>(b.radius));
  const double sigma = 2.0 * largest * unit * reach_factor_;  // largest contact distance
  if (!Shift && !fits(sigma)) {
    wants_images_ = true;
    return;
  }
  // Growth uses up the margin; a list should hold for about twenty collisions a sphere.
  margin_ = 1e-9;
  if (rate_ > 0.0) {
    const double wanted = collision_time_ > 0.0 ? 20.0 * rate_ * collision_time_ : 0.3 * shell_;
    margin_ = std::min(std::max(wanted, smallest_margin), std::max(smallest_margin, 0.5 * shell_));
  }
  // Lists reach 1 + margin + 2 shells. Without images the difference of two places must stay below half the box, or it
  // wraps to another image than that of the list: both spheres may stand at the far ends of their safe spheres, two
  // shells further. With images lists reach as far as the integers hold.
  const double widest = Shift ? (lattice_.cube() ? 1.4 : 2.8) : 0.4999;
  const double space = widest / sigma - 1.0, shells = Shift ? 2.0 : 4.0;
  margin_ = std::min(margin_, space - shells * smallest_shell);
  if (rate_ > 0.0) lists_end_ = margin_ * 0.999 / rate_;
  widest_shell_ = std::max(smallest_shell, std::min(1.5, 0.999 * (space - margin_) / shells));
  shell_ = std::min(std::max(shell_, smallest_shell), widest_shell_);
  rho_max_ = 0.0;
  for (int32_t i = 0; i < n_; ++i) {
    Body<D> &b = body_[i];
    if (observer_) note_path(i);
    if constexpr (Shift) lattice_.wrap(b.x);
    for (int c = 0; c < D; ++c) centre_[i][c] = b.x[c];
    const double radius = static_cast<double>(b.radius);
    // Small spheres among large ones are as quick, so their shells are wider in proportion.
    safe_[i] = 2.0 * shell_ * std::sqrt(radius * std::min(mean, largest));
    safe_[i] = std::min(safe_[i], 2.0 * shell_ * largest);
    rho_[i] = (radius * reach_factor_ * (1.0 + margin_) + safe_[i]) * (1.0 + 1e-12);
    rho_max_ = std::max(rho_max_, rho_[i]);
  }
  if (choose_cells_alone(sigma)) return build_cells_alone();
  if (quenched_)
    for (int32_t i = 0; i < n_; ++i) note_centre(i);
  choose_cells();
  if (cells_ > 0) build_blocks();
  std::fill(neighbours_.begin(), neighbours_.end(), 0);
  if (capacity_ == 0) widen_lists();
  for (int32_t i = 0; i < n_; ++i) {
    if (i % 64 == 0) CallScope::look();
    candidates(i, [&](int32_t k, const std::array<int64_t, D> *offset) {
      if (k > i) append(i, k, offset);
    });
  }
  max_overlap = std::max(max_overlap, worst_overlap());
  check_pairs();
}

// Chooses the shell s: wide shells cost long lists, narrow ones remake lists often. The unit of cost is one neighbour
// looked at. A collision costs 2 (14 + L); each of the x exits that come with it costs 30 + 4 L + K, K for the search.
// With x ~ s^-1.6, and L and K through cells ~ (1 + 2 s)^D, the rate was within 6 % of the best of fixed shells at
// packing fractions 0.27 to 0.6. Returns true when the shell has changed.
template <int D, bool Shift>
bool Engine<D, Shift>::tune_shell() {
  const int64_t made = sums.collisions - collisions_before_, left = exits_ - exits_before_;
  if (made < 4 * n_ && left < 2 * n_) return false;
  if (made > 0) collision_time_ = (sums.time - tuned_time_) * n_ / static_cast<double>(made);
  const double x = static_cast<double>(left) / static_cast<double>(std::max<int64_t>(made, 1));
  collisions_before_ = sums.collisions;
  exits_before_ = exits_;
  tuned_time_ = sums.time;
  if (cells_alone_) return false;
  double length = 0.0;
  for (int32_t m : neighbours_) length += m;
  length /= n_;
  const auto cost = [&, now = shell_](double shell) {
    const double more = math::pow((1.0 + 2.0 * shell) / (1.0 + 2.0 * now), D);
    return 2.0 * (14.0 + more * length) +
           x * math::pow(now / shell, 1.6) * (30.0 + 4.0 * more * length + (Shift ? 1.0 : more) * search_cost_);
  };
  // A gain below 3 % does not pay for making all lists again.
  double best = 0.97 * cost(shell_);
  const double before = shell_;
  for (double shell = std::max(smallest_shell, before / 1.5); shell <= std::min(widest_shell_, before * 1.5);
       shell *= 1.1)
    if (cost(shell) < best) best = cost(shell), shell_ = shell;
  return shell_ != before;
}

// f(offset) for every image of k within the cutoff of i, between centres; offset makes x_i - x_k + offset that image.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::each_image(int32_t i, int32_t k, double cutoff, std::array<int64_t, D> shift, F &&f) const {
  std::array<int64_t, D> distance;
  for (int c = 0; c < D; ++c) distance[c] = wrapping_sum(static_cast<int64_t>(centre_[i][c] - centre_[k][c]), shift[c]);
  lattice_.images(distance, cutoff, [&](const std::array<int64_t, D> &image) {
    std::array<int64_t, D> offset;
    for (int c = 0; c < D; ++c) offset[c] = wrapping_sum(shift[c], image[c]);
    f(&offset);
  });
}

// f(k, offset) for every k (and image) that belongs into the list of i.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::candidates(int32_t i, F &&f) {
  using Offset = std::array<int64_t, D>;
  if constexpr (Shift)
    if (quenched_) {
      each_partner(i, [&](int32_t k, const Offset &shift) {
        each_image(i, k, rho_[i] + rho_[k], shift, [&](const Offset *offset) { f(k, offset); });
      });
      return;
    }
  const auto check = [&](int32_t k) {
    if (k == i) return;
    const double cutoff = rho_[i] + rho_[k];
    if constexpr (Shift) {
      each_image(i, k, cutoff, {}, [&](const Offset *offset) { f(k, offset); });
    } else {
      double r2 = 0.0;
      for (int c = 0; c < D; ++c) {
        const double r = static_cast<double>(static_cast<int64_t>(centre_[i][c] - centre_[k][c]));
        r2 += r * r;
      }
      if (r2 < cutoff * cutoff) f(k, nullptr);
    }
  };
  if (cells_ == 0) {
    for (int32_t k = 0; k < n_; ++k) check(k);
  } else if constexpr (Shift) {
    search_images(i, f);
  } else {
    const int32_t found = search(i);
    for (int32_t e = 0; e < found; ++e) check(found_[e]);
  }
}

// f(k, offset) for every sphere that i can meet before its exit.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::each_neighbour(int32_t i, F &&f) const {
  if (cells_alone_) {
    const int32_t found = gather(i);
    for (int32_t e = 0; e < found; ++e) f(found_[e], nullptr);
    return;
  }
  for (int32_t e = 0, m = neighbours_[i]; e < m; ++e) f(list_of(i)[e], offset_of(i, e));
}

template <int D, bool Shift>
void Engine<D, Shift>::append(int32_t i, int32_t k, const std::array<int64_t, D> *offset) {
  if (static_cast<size_t>(std::max(neighbours_[i], neighbours_[k])) >= capacity_) widen_lists();
  const int32_t at_i = neighbours_[i]++, at_k = neighbours_[k]++;
  list_of(i)[at_i] = k;
  list_of(k)[at_k] = i;
  if constexpr (Shift) {
    for (int c = 0; c < D; ++c) {
      offset_[offset_at(i, at_i) + c * capacity_] = (*offset)[c];
      offset_[offset_at(k, at_k) + c * capacity_] = -(*offset)[c];
    }
  } else {
    (void)offset;
  }
}

// Takes one entry of i out of the list of k.
template <int D, bool Shift>
void Engine<D, Shift>::forget(int32_t i, int32_t k) {
  int32_t *list = list_of(k);
  const int32_t last = --neighbours_[k];
  int32_t e = 0;
  while (list[e] != i) ++e;
  list[e] = list[last];
  if constexpr (Shift)
    for (int c = 0; c < D; ++c) offset_[offset_at(k, e) + c * capacity_] = offset_[offset_at(k, last) + c * capacity_];
}

template <int D, bool Shift>
void Engine<D, Shift>::widen_lists() {
  const size_t n = static_cast<size_t>(n_), wider = capacity_ == 0 ? 16 : (capacity_ + capacity_ / 4 + 11) / 8 * 8;
  const size_t entry = sizeof(int32_t) + (Shift ? D * sizeof(int64_t) : 0);
  CallScope::need_memory(static_cast<double>(wider * n) * static_cast<double>(entry), "neighbour lists");
  std::vector<int32_t> list(wider * n);
  std::vector<int64_t> offset(Shift ? wider * n * D : 0);
  for (size_t i = 0; i < n && capacity_ > 0; ++i) {
    std::copy_n(&neighbour_[i * capacity_], neighbours_[i], &list[i * wider]);
    if constexpr (Shift)
      for (size_t row = i * D; row < (i + 1) * D; ++row)
        std::copy_n(&offset_[row * capacity_], neighbours_[i], &offset[row * wider]);
  }
  neighbour_.swap(list);
  offset_.swap(offset);
  capacity_ = wider;
}

// Sphere i, which stands at now_, gets a new safe sphere and list.
template <int D, bool Shift>
void Engine<D, Shift>::recentre(int32_t i) {
  if (cells_alone_) return cross(i);
  for (int32_t e = 0; e < neighbours_[i]; ++e) forget(i, list_of(i)[e]);
  neighbours_[i] = 0;
  if (observer_) note_path(i);
  if (cells_ > 0) drop(i, cell_of(home_of(i)));
  Body<D> &b = body_[i];
  if constexpr (Shift) lattice_.wrap(b.x);
  for (int c = 0; c < D; ++c) centre_[i][c] = b.x[c];
  if (cells_ > 0) put(i, cell_of(home_of(i)));
  if (quenched_) note_centre(i);
  candidates(i, [&](int32_t k, const std::array<int64_t, D> *offset) { append(i, k, offset); });
}

}  // namespace jam
