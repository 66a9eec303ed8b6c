// The engine to bytes and back: all that the coming events depend on, in one list. What follows from the packing
// (user_, the shifts of the Mari-Kurchan model) is made anew by the constructor.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/limits.hpp"
#include "core/math.hpp"
#include "dynamics/event_driven/engine.hpp"

namespace jam {

template <int D, bool Shift>
void Engine<D, Shift>::archive(Archive &a) {
  a(sums);
  a(max_overlap);
  a(options_);
  a(user_);
  a(body_);
  calendar_.archive(a);
  a(now_);
  a(rate_);
  a(relative_rate_);
  a(left_over_);
  a(mass_);
  for (double *t : {&lists_end_, &fraction_time_, &full_time_, &time_end_, &step_end_}) a(*t);
  a(target_radius_);
  a(kinetic_time_);
  a(twice_kinetic_);
  a(shell_);
  a(margin_);
  a(centre_);
  a(rho_);
  a(safe_);
  a(neighbour_);
  a(neighbours_);
  a(offset_);
  uint64_t capacity = capacity_;
  a(capacity);
  capacity_ = capacity;
  a(rho_max_);
  a(cells_);
  a(cell_range_);
  if (!lattice_.cube()) {
    a(image_cells_);
    a(image_range_);
  }
  a(block_);
  a(cell_first_);
  a(cell_next_);
  a(cells_alone_);
  a(cell_);
  for (int64_t *k : {&exits_, &exits_before_, &collisions_before_, &events_before_, &rebase_at_}) a(*k);
  for (double *x : {&search_cost_, &widest_shell_, &tuned_time_, &time_before_, &bucket_width_, &collision_time_})
    a(*x);
  if (a.reading()) {
    options_.instruction_set = InstructionSet::best;  // of this processor, not of the one that wrote
    check_archive();
    make_scratch();
    if (quenched_) {
      prepare_partners();
      for (int32_t i = 0; i < n_; ++i) note_centre(i);
    }
  }
}

// Every index must be in its range and every list must be mutual, or a damaged file would send the engine astray.
template <int D, bool Shift>
void Engine<D, Shift>::check_archive() const {
  const size_t n = static_cast<size_t>(n_);
  const auto sphere = [n](int32_t k) { return k >= 0 && static_cast<size_t>(k) < n; };
  Archive::check(user_.size() == n && body_.size() == n && left_over_.size() == n &&
                 (mass_.empty() || mass_.size() == n));
  Archive::check(centre_.size() == n && rho_.size() == n && safe_.size() == n && neighbours_.size() == n);
  Archive::check(capacity_ > 0 && capacity_ % 8 == 0 && neighbour_.size() / n == capacity_ &&
                 neighbour_.size() % n == 0);
  Archive::check(offset_.size() == (Shift ? neighbour_.size() * D : 0));
  std::vector<char> seen(n, 0);
  for (int32_t u : user_) {
    Archive::check(sphere(u) && !seen[u]);
    seen[u] = 1;
  }
  for (const double m : mass_) Archive::check(m > 0.0 && std::isfinite(m));
  for (size_t i = 0; i < n; ++i) {
    const Body<D> &b = body_[i];
    Archive::check(b.radius > 0 && b.radius <= int64_t{1} << 62 && std::isfinite(b.time));
    // One sphere may hold all the energy, and growth heats.
    const double fastest = 10.0 * limits::velocity_max * std::sqrt(D * n_ / (mass_.empty() ? 1.0 : mass_[i]));
    for (const double v : b.v) Archive::check(std::fabs(v) <= fastest * scale);
  }
  // A longer reach would find images without end.
  for (size_t i = 0; i < n; ++i) Archive::check(rho_[i] >= 0.0 && rho_[i] <= 4.0 * scale && std::isfinite(safe_[i]));
  for (const double part : left_over_) Archive::check(std::isfinite(part));
  for (const double x : {now_, rate_, relative_rate_, twice_kinetic_, sums.time, max_overlap})
    Archive::check(std::isfinite(x));
  for (const int64_t count :
       {exits_, exits_before_, collisions_before_, events_before_, rebase_at_, sums.events, sums.collisions})
    Archive::check(count >= 0 && count < int64_t{1} << 60);  // differences are taken of them
  for (size_t i = 0; i < n; ++i) {
    Archive::check(neighbours_[i] >= 0 && static_cast<size_t>(neighbours_[i]) <= capacity_);
    for (int32_t e = 0; e < neighbours_[i]; ++e) {
      const int32_t k = neighbour_[i * capacity_ + e];
      Archive::check(sphere(k) && static_cast<size_t>(k) != i && neighbours_[k] >= 0 &&
                     static_cast<size_t>(neighbours_[k]) <= capacity_);
      const int32_t *list = &neighbour_[static_cast<size_t>(k) * capacity_];
      Archive::check(std::count(list, list + neighbours_[k], static_cast<int32_t>(i)) ==
                     std::count(&neighbour_[i * capacity_], &neighbour_[i * capacity_] + neighbours_[i], k));
    }
  }
  Archive::check(cell_range_ >= 1 && cell_range_ <= 3);  // scratch grows with its power, with or without cells
  if (cells_ != 0 || cells_alone_ != 0) check_cells();
}

template <int D, bool Shift>
void Engine<D, Shift>::check_cells() const {
  double total = math::pow(static_cast<double>(cells_), D);
  if constexpr (Shift) {
    Archive::check(cells_ == 1 && cells_alone_ == 0 && !lattice_.cube() && !quenched_);
    double looked_cells = 1.0;
    for (int c = 0; c < D; ++c) {
      const int64_t cells = image_cells_[c], range = image_range_[c];
      Archive::check(cells > 0 && cells < 1 << 20 && range >= 0 && range < 1 << 20);
      total *= static_cast<double>(cells);
      looked_cells *= 2.0 * static_cast<double>(range) + 1.0;
    }
    Archive::check(looked_cells <= 2.0 * n_);
  } else {
    Archive::check(cells_ > 0 && cells_ < 1 << 20 && cells_ >= 2 * cell_range_ + 1 &&
                   (cells_alone_ == 0 || cells_alone_ == 1));
  }
  if (cells_alone_) {
    Archive::check(cells_ >= 5 && cell_range_ == 1 && cell_.size() == static_cast<size_t>(n_));
    for (const auto &cell : cell_)
      for (int32_t place : cell) Archive::check(place >= 0 && place < cells_);
    Archive::check(total == static_cast<double>(cell_first_.size()) && cell_next_.size() == static_cast<size_t>(n_));
  } else {
    Archive::check(total <= static_cast<double>(block_.size()));
  }
  std::vector<char> seen(static_cast<size_t>(n_), 0);
  int64_t met = 0;
  const auto meet = [&](int32_t i, size_t cell) {
    Archive::check(i >= 0 && i < n_ && !seen[i] && cell_of(home_of(i)) == cell);
    seen[i] = 1;
    ++met;
  };
  for (size_t cell = 0; static_cast<double>(cell) < total; ++cell) {
    if (cells_alone_) {
      for (int32_t i = cell_first_[cell]; i >= 0; i = cell_next_[i]) meet(i, cell);
      continue;
    }
    int64_t blocks = 0;
    for (size_t at = cell;;) {
      const Block<D> &b = block_[at];
      const int32_t last = b.id[Block<D>::lanes - 1];
      for (int l = 0; l < Block<D>::lanes; ++l) {
        if (b.id[l] == Block<D>::free || (l == Block<D>::lanes - 1 && last < Block<D>::free)) continue;
        meet(b.id[l], cell);
        for (int c = 0; c < D; ++c) Archive::check(b.x[c][l] == static_cast<int32_t>(centre_[b.id[l]][c] >> 32));
      }
      if (last >= Block<D>::free) break;
      at = static_cast<size_t>(Block<D>::link_to(last));
      Archive::check(at < block_.size() && ++blocks <= static_cast<int64_t>(block_.size()));
    }
  }
  Archive::check(met == n_);
}

}  // namespace jam
