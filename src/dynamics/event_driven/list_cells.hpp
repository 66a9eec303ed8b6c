// The engine: cells that hold the centres of the safe spheres, in blocks of eight for pair_kernel's search.
#pragma once
#include <cstdlib>

#include "dynamics/event_driven/engine.hpp"

namespace jam {

// The cell of a sphere, axis by axis: that of its centre or, without lists, the one it was last seen to enter.
template <int D, bool Shift>
std::array<int64_t, D> Engine<D, Shift>::home_of(int32_t i) const {
  std::array<int64_t, D> home;
  if constexpr (Shift) {
    double s[D];
    lattice_.fraction(centre_[i], s);
    for (int c = 0; c < D; ++c) {
      const auto place = static_cast<int64_t>(std::floor(s[c] * static_cast<double>(image_cells_[c])));
      home[c] = std::min(std::max<int64_t>(place, 0), image_cells_[c] - 1);
    }
    return home;
  }
  for (int c = 0; c < D; ++c)
    home[c] = cells_alone_ ? cell_[i][c]
                           : static_cast<int64_t>(((centre_[i][c] >> 32) * static_cast<uint64_t>(cells_)) >> 32);
  return home;
}

template <int D, bool Shift>
size_t Engine<D, Shift>::cell_of(const std::array<int64_t, D> &home) const {
  size_t cell = 0;
  for (int c = D - 1; c >= 0; --c) cell = cell * static_cast<size_t>(side_of_cells(c)) + static_cast<size_t>(home[c]);
  return cell;
}

// Writes the cells within cell_range_ of a cell to around_; returns their number.
template <int D, bool Shift>
size_t Engine<D, Shift>::cells_around(const std::array<int64_t, D> &home) const {
  if constexpr (Shift) {
    size_t found = 0;
    each_cell_around(D - 1, home, 0, {}, [&](size_t cell, const auto &) { around_[found++] = cell; });
    return found;
  }
  const size_t width = 2 * static_cast<size_t>(cell_range_) + 1;
  size_t count = 1, stride = 1;
  around_[0] = 0;
  // Axis by axis, from the last cell to the first, so that each is replaced after its last use.
  for (int c = 0; c < D; ++c) {
    std::array<size_t, 7> at;
    int64_t place = home[c] - cell_range_;
    if (place < 0) place += cells_;
    for (size_t s = 0; s < width; ++s) {
      at[s] = static_cast<size_t>(place) * stride;
      if (++place == cells_) place = 0;
    }
    for (size_t s = width; s-- > 0;)
      for (size_t k = 0; k < count; ++k) around_[s * count + k] = around_[k] + at[s];
    count *= width;
    stride *= static_cast<size_t>(cells_);
  }
  return count;
}

template <int D, bool Shift>
void Engine<D, Shift>::make_scratch() {
  size_t width = 1;
  for (int c = 0; c < D; ++c) width *= 2 * static_cast<size_t>(Shift ? image_range_[c] : cell_range_) + 1;
  around_.resize(width);
  found_.resize(static_cast<size_t>(n_));
}

template <int D, bool Shift>
void Engine<D, Shift>::build_blocks() {
  make_scratch();
  size_t total = 1;
  for (int c = 0; c < D; ++c) total *= static_cast<size_t>(side_of_cells(c));
  Block<D> empty;
  std::fill(empty.id, empty.id + Block<D>::lanes, Block<D>::free);
  for (auto &axis : empty.x) std::fill(axis, axis + Block<D>::lanes, 0);
  block_.assign(total, empty);
  for (int32_t i = 0; i < n_; ++i) put(i, cell_of(home_of(i)));
}

template <int D, bool Shift>
void Engine<D, Shift>::put(int32_t i, size_t cell) {
  constexpr int lanes = Block<D>::lanes;
  const auto fill = [&](Block<D> &b, int l, int32_t sphere) {
    b.id[l] = sphere;
    for (int c = 0; c < D; ++c) b.x[c][l] = static_cast<int32_t>(centre_[sphere][c] >> 32);
  };
  for (size_t at = cell;;) {
    Block<D> &b = block_[at];
    for (int l = 0; l < lanes; ++l)
      if (b.id[l] == Block<D>::free) return fill(b, l, i);
    const int32_t last = b.id[lanes - 1];
    if (last < Block<D>::free) {
      at = static_cast<size_t>(Block<D>::link_to(last));
      continue;
    }
    // Full: the last centre moves to a further block, and a link takes its lane.
    Block<D> more;
    std::fill(more.id, more.id + lanes, Block<D>::free);
    for (auto &axis : more.x) std::fill(axis, axis + lanes, 0);
    fill(more, 0, last);
    fill(more, 1, i);
    b.id[lanes - 1] = Block<D>::link_to(static_cast<int32_t>(block_.size()));
    block_.push_back(more);
    return;
  }
}

template <int D, bool Shift>
void Engine<D, Shift>::drop(int32_t i, size_t cell) {
  for (size_t at = cell;;) {
    Block<D> &b = block_[at];
    for (int32_t &id : b.id)
      if (id == i) {
        id = Block<D>::free;
        return;
      }
    at = static_cast<size_t>(Block<D>::link_to(b.id[Block<D>::lanes - 1]));
  }
}

// Writes all spheres whose centres may be within reach of that of i, and i, to found_; returns their number. Floats and
// the upper 32 bits of coordinates decide: the factor covers the rounding of the floats, 4 the bits cut off.
template <int D, bool Shift>
int32_t Engine<D, Shift>::search(int32_t i) const {
  const auto reach = static_cast<float>((rho_[i] + rho_max_) * 0x1p-32 * (1.0 + 1e-6) + 4.0);
  int32_t x[D];
  for (int c = 0; c < D; ++c) x[c] = static_cast<int32_t>(centre_[i][c] >> 32);
  return kernel_.search(block_.data(), around_.data(), cells_around(home_of(i)), x, reach, found_.data());
}

}  // namespace jam
