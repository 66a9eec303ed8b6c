// The engine: rebuilding all lists, or that of one sphere.
#pragma once
#include <algorithm>

#include "core/call_scope.hpp"
#include "dynamics/event_driven/engine_of.hpp"

namespace jam::inside {

// Growth uses up the margin. Lists reach 1 + margin + 2 shells. Without images the difference of two places must stay
// below half the box, or it wraps to another image than that of the list: both spheres may be at the far ends of
// their safe spheres, two shells further. With images lists reach as far as the integers hold.
template <int D, Offsets O>
void EngineOf<D, O>::choose_margin(double sigma) {
  using Tuning = ListTuning;
  double &margin = lists_.margin, &shell = lists_.shell;
  margin = Tuning::without_growth;
  if (clock_.rate > 0.0) {
    const double wanted = pace_.collision_time > 0.0 ? Tuning::collisions * clock_.rate * pace_.collision_time
                                                     : Tuning::first_margin * shell;
    margin = std::min(std::max(wanted, Tuning::smallest_margin),
                      std::max(Tuning::smallest_margin, Tuning::most_margin * shell));
  }
  const double widest = listed ? (lattice_.cube() ? Tuning::reach_cube : Tuning::reach_cell) : Tuning::reach_wrapped;
  const double space = widest / sigma - 1.0, shells = listed ? 2.0 : 4.0;
  margin = std::min(margin, space - shells * Tuning::smallest_shell);
  if (clock_.rate > 0.0) clock_.lists_end = margin * Tuning::used_up / clock_.rate;
  pace_.widest_shell =
      std::max(Tuning::smallest_shell, std::min(Tuning::widest_shell, Tuning::used_up * (space - margin) / shells));
  shell = std::min(std::max(shell, Tuning::smallest_shell), pace_.widest_shell);
}

// Safe spheres and lists are around the places of now.
template <int D, Offsets O>
void EngineOf<D, O>::place_centres(double largest) {
  const double mean = spheres_.mean_radius(), shell = lists_.shell;
  for (int32_t i = 0; i < spheres_.n; ++i) {
    Body<D> &b = spheres_.body[i];
    if (observer_) note_path(i);
    if constexpr (listed) lattice_.wrap(b.x);
    for (int c = 0; c < D; ++c) lists_.centre[i][c] = b.x[c];
    const double radius = static_cast<double>(b.radius);
    // Small spheres among large ones are as quick, so their shells are wider in proportion.
    double &safe = lists_.safe[i], &rho = lists_.rho[i];
    safe = 2.0 * shell * std::sqrt(radius * std::min(mean, largest));
    safe = std::min(safe, 2.0 * shell * largest);
    rho = (radius * spheres_.reach_factor * (1.0 + lists_.margin) + safe) * (1.0 + 1e-12);
    if (walls_) walls_->note_centre(i, lists_.centre[i], rho);
  }
}

template <int D, Offsets O>
bool EngineOf<D, O>::choose_cell_mode(double sigma) {
  if constexpr (listed) {
    (void)sigma;
    return false;
  } else {
    // As many spheres as would fill the whole cell as densely.
    const auto crowd = walls_ ? static_cast<int32_t>(spheres_.n * walls_->share_of_cell) : spheres_.n;
    if (!cell_mode_.choose(crowd, sigma, options_.cells, lists_.margin)) return false;
    if (clock_.rate > 0.0) clock_.lists_end = lists_.margin * ListTuning::used_up / clock_.rate;
    if (walls_) std::fill(walls_->near.begin(), walls_->near.end(), 1);  // cells say nothing of walls
    cell_mode_.build(lists_.centre, lattice_);
    return true;
  }
}

template <int D, Offsets O>
void EngineOf<D, O>::choose_levels() {
  if (mari_kurchan_) {
    levels_.clear();
    pace_.search_cost = spheres_.n * ListTuning::look_in_vectors;
    return;
  }
  pace_.search_cost = levels_.choose(lists_.rho, unit, lattice_);
  levels_.fill(lists_.centre, lattice_);
}

template <int D, Offsets O>
void EngineOf<D, O>::build_lists() {
  const double largest = spheres_.largest_radius();
  const double sigma = 2.0 * largest * unit * spheres_.reach_factor;  // largest contact distance
  if (!listed && !Lists<D, O>::fit_wrapped(sigma)) {
    wants_images_ = true;
    return;
  }
  choose_margin(sigma);
  place_centres(largest);
  if (choose_cell_mode(sigma)) {
    lists_.clear();
    levels_.clear();
    return rebuild_done();
  }
  if (mari_kurchan_)
    for (int32_t i = 0; i < spheres_.n; ++i) note_centre(i);
  choose_levels();
  lists_.clear();
  for (int32_t i = 0; i < spheres_.n; ++i) {
    if (i % ListTuning::spheres_between_looks == 0) CallScope::look();
    candidates(i, [&](int32_t k, const Offset *offset) {
      if (k > i) lists_.append(i, k, offset);
    });
  }
  rebuild_done();
}

template <int D, Offsets O>
void EngineOf<D, O>::rebuild_done() {
  max_overlap = std::max(max_overlap, worst_overlap());
  check_pairs();
}

// f(k, offset) for every image of k within the reach of the list of i, between centres; the offset makes x_i - x_k that
// image.
template <int D, Offsets O>
template <class F>
void EngineOf<D, O>::each_image(int32_t i, int32_t k, const Offset &shift, F &&f) const {
  Offset distance = lists_.between_centres(i, k);
  for (int c = 0; c < D; ++c) distance[c] = wrapping_sum(distance[c], shift[c]);
  lattice_.images(distance, lists_.rho[i] + lists_.rho[k], [&](const Offset &image) {
    Offset offset;
    for (int c = 0; c < D; ++c) offset[c] = wrapping_sum(shift[c], image[c]);
    f(k, &offset);
  });
}

// f(k, offset) for every sphere k (and image) that the cells of a level around i give and that belongs into its list.
// Floats and the upper 32 bits of coordinates decide in the cells: the factor of the reach covers the rounding of the
// floats, the sum the bits cut off.
template <int D, Offsets O>
template <class F>
void EngineOf<D, O>::search(int32_t i, const Level &level, F &&f) const {
  const auto &grid = level.grid;
  const Place &centre = lists_.centre[i];
  const double within = lists_.rho[i] + level.rho_max;
  const auto reach = static_cast<float>(within * 0x1p-32 * (1.0 + CellTuning::rounding) + CellTuning::cut_off_bits);
  const bool larger = lists_.rho[i] > level.rho_max;  // than the spheres for which the cells were chosen
  if (larger && grid.cells_within(within * unit, lattice_) > level.n) return try_all(i, level.member, f);
  const auto home = grid.home(centre, lattice_);
  CellSearch<D> query{level.cells.block.data(), nullptr, 0, reach, nullptr, nullptr};
  int32_t own[D];
  if constexpr (listed) {
    query.count = larger ? grid.gather_within(home, within * unit, lattice_, image_cells_)
                         : grid.cells_around(home, lattice_, image_cells_);
    query.cells = image_cells_.cell.data();
    query.turn = image_cells_.turn.data();
    query.x = image_cells_.places(centre);
    const size_t most = image_cells_.copies * static_cast<size_t>(spheres_.n);
    if (found_.size() < most) found_.resize(most);
    if (turn_.size() < most) turn_.resize(most);
  } else {
    query.count = larger ? grid.gather_within(home, within * unit, lattice_) : grid.cells_around(home, lattice_);
    query.cells = grid.around.data();
    for (int c = 0; c < D; ++c) own[c] = static_cast<int32_t>(centre[c] >> 32);
    query.x = own;
  }
  const int32_t found = kernel_.search(query, found_.data(), turn_.data());
  for (int32_t e = 0; e < found; ++e) {
    const int32_t k = found_[e];
    if (k == i) continue;
    const double cutoff = lists_.rho[i] + lists_.rho[k];
    const Offset between = lists_.between_centres(i, k);
    Offset offset{};
    double r2 = 0.0;
    for (int c = 0; c < D; ++c) {
      if constexpr (listed) offset[c] = -image_cells_.image[static_cast<size_t>(turn_[e]) * D + c];
      const auto r = static_cast<double>(wrapping_sum(between[c], offset[c]));
      r2 += r * r;
    }
    if (r2 < cutoff * cutoff) f(k, &offset);
  }
}

// The same among these spheres, one by one.
template <int D, Offsets O>
template <class F>
void EngineOf<D, O>::try_all(int32_t i, const std::vector<int32_t> &spheres, F &&f) const {
  for (const int32_t k : spheres) {
    if (k == i) continue;
    if constexpr (listed) {
      each_image(i, k, Offset{}, f);
    } else {
      const double cutoff = lists_.rho[i] + lists_.rho[k];
      double r2 = 0.0;
      for (const int64_t x : lists_.between_centres(i, k)) {
        const double r = static_cast<double>(x);
        r2 += r * r;
      }
      if (r2 < cutoff * cutoff) f(k, nullptr);
    }
  }
}

// f(k, offset) for every k (and image) that belongs into the list of i.
template <int D, Offsets O>
template <class F>
void EngineOf<D, O>::candidates(int32_t i, F &&f) const {
  if constexpr (listed)
    if (mari_kurchan_) {
      mari_kurchan_->each_partner(spheres_.user[i], kernel_, found_.data(),
                                  [&](int32_t k, const Offset &shift) { each_image(i, k, shift, f); });
      return;
    }
  for (const Level &level : levels_.all()) {
    if (level.grid.used())
      search(i, level, f);
    else
      try_all(i, level.member, f);
  }
}

// Sphere i, which is at the present, gets a new safe sphere and list.
template <int D, Offsets O>
void EngineOf<D, O>::recentre(int32_t i) {
  Body<D> &b = spheres_.body[i];
  if constexpr (!listed)
    if (cell_mode_.on) {
      cell_mode_.cross(i, b, scale);
      if (observer_) note_path(i);
      for (int c = 0; c < D; ++c) lists_.centre[i][c] = b.x[c];
      return;
    }
  lists_.forget(i);
  if (observer_) note_path(i);
  if (!mari_kurchan_) levels_.drop(i, lists_.centre, lattice_);
  if constexpr (listed) lattice_.wrap(b.x);
  for (int c = 0; c < D; ++c) lists_.centre[i][c] = b.x[c];
  if (walls_) walls_->note_centre(i, lists_.centre[i], lists_.rho[i]);
  if (mari_kurchan_)
    note_centre(i);
  else
    levels_.put(i, lists_.centre, lattice_);
  candidates(i, [&](int32_t k, const Offset *offset) { lists_.append(i, k, offset); });
}

}  // namespace jam::inside
