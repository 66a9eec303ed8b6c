// The engine: neighbour lists, made through cells that hold the centres of the safe spheres.
#pragma once
#include <algorithm>

#include "dynamics/engine.hpp"

namespace jam {

// Cells no wider than the longest list reach over cell_range_; none when they would not be worth it.
template <int D, bool Shift>
void Engine<D, Shift>::choose_cells() {
  cells_ = 0;
  search_cost_ = static_cast<double>(n_) * 4.0;
  if (quenched_) {
    size_t length = 0;
    for (const auto &list : outer_) length += list.size();
    search_cost_ = 2.0 * static_cast<double>(length) / n_;
  }
  if (Shift) return;
  const double reach = 2.0 * rho_max_ * unit;
  double best = 0.5 * n_;  // in units of tune_shell
  for (int range = 1; range <= 3; ++range) {
    const auto side =
        static_cast<int64_t>(std::min(std::floor(range / reach), std::floor(std::pow(4.0 * n_ + 64.0, 1.0 / D))));
    if (side < 2 * range + 1) continue;
    const double looked_cells = std::pow(2.0 * range + 1.0, D);
    const double cost = looked_cells * 0.5 * (1.0 + n_ / std::pow(static_cast<double>(side), D));
    if (side * reach > range) continue;
    if (cost < best) best = cost, cells_ = side, cell_range_ = range;
  }
  search_cost_ = best;
}

template <int D, bool Shift>
size_t Engine<D, Shift>::cell_of(const Place &x) const {
  size_t cell = 0;
  for (int c = D - 1; c >= 0; --c)
    cell =
        cell * static_cast<size_t>(cells_) + static_cast<size_t>(((x[c] >> 32) * static_cast<uint64_t>(cells_)) >> 32);
  return cell;
}

template <int D, bool Shift>
void Engine<D, Shift>::build_lists() {
  double largest = 0.0, mean = mean_radius();
  for (const Body &b : body_) largest = std::max(largest, static_cast<double>(b.radius));
  const double sigma = 2.0 * largest * unit;
  if (!Shift && !fits(sigma)) {
    wants_images_ = true;
    return;
  }
  // Growth uses up the margin; about twenty collisions a sphere is a good life for a list.
  margin_ = 1e-9;
  if (rate_ > 0.0) {
    const double wanted = collision_time_ > 0.0 ? 20.0 * rate_ * collision_time_ : 0.3 * shell_;
    margin_ = std::min(std::max(wanted, smallest_margin), std::max(smallest_margin, 0.5 * shell_));
  }
  // Lists reach 1 + margin + 2 shells. Without images the difference of two places must stay below half the box, or it
  // wraps to another image than that of the list: both spheres may stand at the far ends of their safe spheres, two
  // shells further.
  const double space = (Shift ? 1.4 : 0.4999) / sigma - 1.0, shells = Shift ? 2.0 : 4.0;
  margin_ = std::min(margin_, space - shells * smallest_shell);
  if (rate_ > 0.0) lists_end_ = margin_ * 0.999 / rate_;
  widest_shell_ = std::max(smallest_shell, std::min(1.5, 0.999 * (space - margin_) / shells));
  shell_ = std::min(std::max(shell_, smallest_shell), widest_shell_);
  rho_max_ = 0.0;
  for (int32_t i = 0; i < n_; ++i) {
    Body &b = body_[i];
    if (observer_) note_path(i);
    for (int c = 0; c < D; ++c) {
      if (Shift) b.x[c] &= (uint64_t{1} << 61) - 1;
      centre_[i][c] = b.x[c];
    }
    const double radius = static_cast<double>(b.radius);
    // Small spheres among large ones are as quick: their shells are wider than their share.
    safe_[i] = 2.0 * shell_ * std::sqrt(radius * std::min(mean, largest));
    safe_[i] = std::min(safe_[i], 2.0 * shell_ * largest);
    rho_[i] = (radius * (1.0 + margin_) + safe_[i]) * (1.0 + 1e-12);
    rho_max_ = std::max(rho_max_, rho_[i]);
  }
  if (choose_cells_alone(sigma)) return build_cells_alone();
  if (quenched_) check_outer();
  choose_cells();
  if (cells_ > 0) {
    size_t total = 1;
    for (int c = 0; c < D; ++c) total *= static_cast<size_t>(cells_);
    cell_first_.assign(total, -1);
    cell_next_.resize(n_);
    for (int32_t i = n_ - 1; i >= 0; --i) link(i, home(i));
  }
  std::fill(neighbours_.begin(), neighbours_.end(), 0);
  if (capacity_ == 0) widen_lists();
  for (int32_t i = 0; i < n_; ++i)
    candidates(i, [&](int32_t k, const int64_t *offset) {
      if (k > i) append(i, k, offset);
    });
  max_overlap = std::max(max_overlap, worst_overlap());
  check_pairs();
}

// A wide shell costs long lists, a narrow one remakes them often. In units of one neighbour looked at (13 ns) a
// collision costs 2 (14 + L), each of the x exits that come with it 30 + 4 L + K, K for the search; with x ~ s^-1.6 and
// L, and K through cells, as (1 + 2 s)^D this leads to within 6 % of the best rate at a row of fixed shells, packing
// fractions 0.27 to 0.6. True when changed.
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
    const double more = std::pow((1.0 + 2.0 * shell) / (1.0 + 2.0 * now), D);
    return 2.0 * (14.0 + more * length) +
           x * std::pow(now / shell, 1.6) * (30.0 + 4.0 * more * length + (Shift ? 1.0 : more) * search_cost_);
  };
  // Not for a gain that making all lists anew eats up.
  double best = 0.97 * cost(shell_);
  const double before = shell_;
  for (double shell = std::max(smallest_shell, before / 1.5); shell <= std::min(widest_shell_, before * 1.5);
       shell *= 1.1)
    if (cost(shell) < best) best = cost(shell), shell_ = shell;
  return shell_ != before;
}

template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::each_in_cells(int32_t i, F &&f) const {
  const int width = 2 * cell_range_ + 1;
  std::array<std::array<size_t, 7>, D> at;
  size_t stride = 1;
  for (int c = 0; c < D; ++c) {
    const auto home = cells_alone_
                          ? static_cast<int64_t>(cell_[i][c])
                          : static_cast<int64_t>(((centre_[i][c] >> 32) * static_cast<uint64_t>(cells_)) >> 32);
    for (int s = 0; s < width; ++s) at[c][s] = static_cast<size_t>((home + s - cell_range_ + cells_) % cells_) * stride;
    stride *= static_cast<size_t>(cells_);
  }
  std::array<int, D> digit{};
  for (;;) {
    size_t cell = 0;
    for (int c = 0; c < D; ++c) cell += at[c][digit[c]];
    for (int32_t k = cell_first_[cell]; k >= 0; k = cell_next_[k]) f(k);
    int c = 0;
    while (c < D && ++digit[c] == width) digit[c++] = 0;
    if (c == D) return;
  }
}

// f(offset) for every image of k within the cutoff of i, between centres; offset makes x_i - x_k + offset that image.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::each_image(int32_t i, int32_t k, double cutoff, std::array<int64_t, D> shift, F &&f) const {
  constexpr int64_t box = int64_t{1} << 61;
  std::array<int64_t, D> offset{};
  std::array<int64_t, D> distance{};
  std::array<int, D> step{};
  std::array<double, D + 1> r2{};
  double nearest2 = 0.0;
  for (int c = 0; c < D; ++c) {
    distance[c] = static_cast<int64_t>(centre_[i][c] - centre_[k][c]) + shift[c];
    const int64_t nearest = (distance[c] + (distance[c] >= 0 ? box / 2 : -(box / 2))) / box * box;
    distance[c] -= nearest;
    shift[c] -= nearest;
    nearest2 += static_cast<double>(distance[c]) * static_cast<double>(distance[c]);
    if (nearest2 >= cutoff * cutoff) return;
  }
  // Depth first over -1, 0, 1 boxes in each direction, cut off as soon as the distance is too long.
  int c = 0;
  step[0] = -2;
  while (c >= 0) {
    if (++step[c] > 1) {
      --c;
      continue;
    }
    const double r = static_cast<double>(distance[c] + step[c] * box);
    r2[c + 1] = r2[c] + r * r;
    if (r2[c + 1] >= cutoff * cutoff) continue;
    offset[c] = shift[c] + step[c] * box;
    if (c == D - 1)
      f(offset.data());
    else
      step[++c] = -2;
  }
}

// f(k, offset) for every k (and image) that belongs into the list of i.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::candidates(int32_t i, F &&f) const {
  if constexpr (Shift)
    if (quenched_) {
      for (const Outer &partner : outer_[i])
        each_image(i, partner.k, rho_[i] + rho_[partner.k], shift_of(i, partner),
                   [&](const int64_t *offset) { f(partner.k, offset); });
      return;
    }
  const auto check = [&](int32_t k) {
    if (k == i) return;
    const double cutoff = rho_[i] + rho_[k];
    if constexpr (Shift) {
      each_image(i, k, cutoff, {}, [&](const int64_t *offset) { f(k, offset); });
    } else {
      double r2 = 0.0;
      for (int c = 0; c < D; ++c) {
        const double r = static_cast<double>(static_cast<int64_t>(centre_[i][c] - centre_[k][c]));
        r2 += r * r;
      }
      if (r2 < cutoff * cutoff) f(k, nullptr);
    }
  };
  if (cells_ > 0)
    each_in_cells(i, check);
  else
    for (int32_t k = 0; k < n_; ++k) check(k);
}

// f(k, offset) for every sphere that i can meet before its exit.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::each_neighbour(int32_t i, F &&f) const {
  if constexpr (!Shift)
    if (cells_alone_)
      return each_in_cells(i, [&](int32_t k) {
        if (k != i) f(k, nullptr);
      });
  const int32_t *list = &neighbour_[static_cast<size_t>(i) * capacity_];
  for (int32_t e = 0, m = neighbours_[i]; e < m; ++e) f(list[e], offset_of(i, e));
}

template <int D, bool Shift>
void Engine<D, Shift>::append(int32_t i, int32_t k, const int64_t *offset) {
  if (static_cast<size_t>(std::max(neighbours_[i], neighbours_[k])) >= capacity_) widen_lists();
  const size_t at_i = static_cast<size_t>(i) * capacity_ + neighbours_[i]++,
               at_k = static_cast<size_t>(k) * capacity_ + neighbours_[k]++;
  neighbour_[at_i] = k;
  neighbour_[at_k] = i;
  if constexpr (Shift) {
    for (int c = 0; c < D; ++c) offset_[at_i * D + c] = offset[c], offset_[at_k * D + c] = -offset[c];
  } else {
    (void)offset;
  }
}

// Takes one entry of i out of the list of k.
template <int D, bool Shift>
void Engine<D, Shift>::forget(int32_t i, int32_t k) {
  int32_t *list = &neighbour_[static_cast<size_t>(k) * capacity_];
  const int32_t last = --neighbours_[k];
  int32_t e = 0;
  while (list[e] != i) ++e;
  list[e] = list[last];
  if constexpr (Shift) {
    int64_t *offset = &offset_[static_cast<size_t>(k) * capacity_ * D];
    for (int c = 0; c < D; ++c) offset[static_cast<size_t>(e) * D + c] = offset[static_cast<size_t>(last) * D + c];
  }
}

template <int D, bool Shift>
void Engine<D, Shift>::widen_lists() {
  const size_t wider = capacity_ == 0 ? 16 : capacity_ + capacity_ / 4 + 4;
  std::vector<int32_t> list(wider * static_cast<size_t>(n_));
  std::vector<int64_t> offset(Shift ? wider * static_cast<size_t>(n_) * D : 0);
  for (size_t i = 0; i < static_cast<size_t>(n_) && capacity_ > 0; ++i) {
    std::copy_n(&neighbour_[i * capacity_], neighbours_[i], &list[i * wider]);
    if constexpr (Shift)
      std::copy_n(&offset_[i * capacity_ * D], static_cast<size_t>(neighbours_[i]) * D, &offset[i * wider * D]);
  }
  neighbour_.swap(list);
  offset_.swap(offset);
  capacity_ = wider;
}

// Sphere i, which stands at now_, gets a new safe sphere and list.
template <int D, bool Shift>
void Engine<D, Shift>::recentre(int32_t i) {
  if (cells_alone_) return cross(i);
  for (int32_t e = 0; e < neighbours_[i]; ++e) forget(i, neighbour_[static_cast<size_t>(i) * capacity_ + e]);
  neighbours_[i] = 0;
  if (observer_) note_path(i);
  Body &b = body_[i];
  Place place;
  for (int c = 0; c < D; ++c) {
    if (Shift) b.x[c] &= (uint64_t{1} << 61) - 1;
    place[c] = b.x[c];
  }
  if (cells_ > 0) {
    const size_t from = cell_of(centre_[i]), to = cell_of(place);
    if (from != to) {
      unlink(i, from);
      link(i, to);
    }
  }
  centre_[i] = place;
  if (quenched_ && left_outer(i)) renew_outer(i);
  candidates(i, [&](int32_t k, const int64_t *offset) { append(i, k, offset); });
}

}  // namespace jam
