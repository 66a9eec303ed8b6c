// The engine in a cell that is no cube: cells along the cell vectors find the candidates of a list with their images. A
// small cube has few spheres, and the Mari-Kurchan model has lists of its own: both look at all partners.
#pragma once
#include "core/math.hpp"
#include "dynamics/event_driven/engine.hpp"

namespace jam {

// Cells that reach over `range` others along each vector; more along those whose faces are near each other. None when
// looking at all spheres costs less.
template <int D, bool Shift>
void Engine<D, Shift>::choose_image_cells() {
  image_cells_.fill(1);
  image_range_.fill(0);
  if (lattice_.cube() || quenched_) return;
  const double reach = 2.0 * rho_max_ * unit * (1.0 + 1e-9);  // places are known to 1e-15 of the cell
  const double most = std::floor(math::pow(4.0 * n_ + 64.0, 1.0 / D));
  double best = n_;  // images cost twice the pairs of choose_cells
  for (int range = 1; range <= 3; ++range) {
    std::array<int64_t, D> cells, over;
    double looked_cells = 1.0, total = 1.0;
    for (int c = 0; c < D; ++c) {
      // A long cell has more of them along its long vector: their shape counts, not their number.
      const double fit = std::floor(range * lattice_.height(c) / reach),
                   enough = std::max(1.0, std::floor(most * lattice_.height(c)));
      cells[c] = static_cast<int64_t>(std::max(1.0, std::min(fit, enough)));
      over[c] = static_cast<int64_t>(std::ceil(reach * static_cast<double>(cells[c]) / lattice_.height(c)));
      looked_cells *= 2.0 * static_cast<double>(over[c]) + 1.0;
      total *= static_cast<double>(cells[c]);
    }
    const double cost = looked_cells * 0.5 * (1.0 + n_ / total);
    if (cost < best) best = cost, cells_ = 1, image_cells_ = cells, image_range_ = over;
  }
  search_cost_ = best;
}

// f(cell, image) for every cell around `home`; `image` is the lattice vector that takes the cell there. Components
// above c are chosen.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::each_cell_around(int c, const std::array<int64_t, D> &home, size_t cell,
                                        const std::array<int64_t, D> &image, F &&f) const {
  const int64_t cells = image_cells_[c], range = image_range_[c];
  int64_t place = home[c] - range, turns = 0;
  while (place < 0) place += cells, --turns;
  std::array<int64_t, D> moved = image;
  if (turns != 0) lattice_.add(moved, c, turns);
  for (int64_t step = -range; step <= range; ++step) {
    const size_t at = cell * static_cast<size_t>(cells) + static_cast<size_t>(place);
    if (c == 0)
      f(at, moved);
    else
      each_cell_around(c - 1, home, at, moved, f);
    if (++place == cells) place = 0, lattice_.add(moved, c, 1);
  }
}

// f(k, offset) for every image of another sphere that belongs into the list of i. Cells that stand at the same image
// are searched together.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::search_images(int32_t i, F &&f) const {
  using Offset = std::array<int64_t, D>;
  const auto reach = static_cast<float>((rho_[i] + rho_max_) * 0x1p-32 * (1.0 + 1e-6) + 4.0);
  size_t cells = 0;
  Offset now{};
  const auto search_cells = [&] {
    int32_t x[D];
    for (int c = 0; c < D; ++c) x[c] = static_cast<int32_t>((centre_[i][c] - static_cast<uint64_t>(now[c])) >> 32);
    const int32_t found = kernel_.search(block_.data(), around_.data(), cells, x, reach, found_.data());
    cells = 0;
    for (int32_t e = 0; e < found; ++e) {
      const int32_t k = found_[e];
      if (k == i) continue;
      const double cutoff = rho_[i] + rho_[k];
      Offset offset;
      double r2 = 0.0;
      for (int c = 0; c < D; ++c) {
        offset[c] = -now[c];
        const auto r =
            static_cast<double>(wrapping_sum(static_cast<int64_t>(centre_[i][c] - centre_[k][c]), offset[c]));
        r2 += r * r;
      }
      if (r2 < cutoff * cutoff) f(k, &offset);
    }
  };
  each_cell_around(D - 1, home_of(i), 0, {}, [&](size_t cell, const Offset &image) {
    if (cells > 0 && image != now) search_cells();
    now = image;
    around_[cells++] = cell;
  });
  if (cells > 0) search_cells();
}

}  // namespace jam
