// Cells along the cell vectors of a cell that is no cube: they find the candidates of a list with their images. A small
// cube has few spheres, and the Mari-Kurchan model has lists of its own: both look at all partners.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "dynamics/event_driven/cell_grid.hpp"

namespace jam {

template <int D>
struct ImageGrid {
  using Home = std::array<int64_t, D>;
  using Offset = std::array<int64_t, D>;

  int64_t in_use = 0;
  int32_t unused_range = 1;                // stands in archives
  std::array<int64_t, D> side{}, range{};  // along each cell vector
  mutable std::vector<size_t> around;      // scratch: cells that are searched

  bool used() const { return in_use != 0; }
  // Cells that reach over `range` others along each vector; more along those whose faces are near each other. None when
  // looking at all spheres costs less. Returns the cost of a search in units of ListTuning.
  double choose(int32_t n, double wanted, const Lattice<D> &lattice) {
    forbid();
    const double reach = wanted * (1.0 + 1e-9);  // places are known to 1e-15 of the cell
    const double most = most_cells_along(n, D);
    double best = n;  // images cost twice the pairs of CellGrid
    for (int r = 1; r <= CellTuning::longest_range; ++r) {
      std::array<int64_t, D> cells, over;
      double looked_cells = 1.0, all = 1.0;
      for (int c = 0; c < D; ++c) {
        // A long cell has more of them along its long vector: their shape counts, not their number.
        const double fit = std::floor(r * lattice.height(c) / reach),
                     enough = std::max(1.0, std::floor(most * lattice.height(c)));
        cells[c] = static_cast<int64_t>(std::max(1.0, std::min(fit, enough)));
        over[c] = static_cast<int64_t>(std::ceil(reach * static_cast<double>(cells[c]) / lattice.height(c)));
        looked_cells *= 2.0 * static_cast<double>(over[c]) + 1.0;
        all *= static_cast<double>(cells[c]);
      }
      const double cost = looked_cells * 0.5 * (1.0 + n / all);
      if (cost < best) best = cost, in_use = 1, side = cells, range = over;
    }
    return best;
  }
  // No cells: all partners are looked at.
  void forbid() {
    in_use = 0;
    side.fill(1);
    range.fill(0);
  }
  Home home(const std::array<uint64_t, D> &place, const Lattice<D> &lattice) const {
    double s[D];
    lattice.fraction(place, s);
    Home cell;
    for (int c = 0; c < D; ++c) {
      const auto at = static_cast<int64_t>(std::floor(s[c] * static_cast<double>(side[c])));
      cell[c] = std::min(std::max<int64_t>(at, 0), side[c] - 1);
    }
    return cell;
  }
  size_t number_of(const Home &home) const {
    size_t cell = 0;
    for (int c = D - 1; c >= 0; --c) cell = cell * static_cast<size_t>(side[c]) + static_cast<size_t>(home[c]);
    return cell;
  }
  size_t total() const {
    size_t cells = 1;
    for (int c = 0; c < D; ++c) cells *= static_cast<size_t>(side[c]);
    return cells;
  }
  void make_scratch() {
    size_t width = 1;
    for (int c = 0; c < D; ++c) width *= 2 * static_cast<size_t>(range[c]) + 1;
    around.resize(width);
  }
  // Writes the cells within the range of a cell to `around`; returns their number.
  size_t cells_around(const Home &home, const Lattice<D> &lattice) const {
    size_t found = 0;
    each_around(home, lattice, [&](size_t cell, const Offset &) { around[found++] = cell; });
    return found;
  }
  // f(cell, image) for every cell around `home`; `image` is the lattice vector that takes the cell there.
  template <class F>
  void each_around(const Home &home, const Lattice<D> &lattice, F &&f) const {
    walk(D - 1, home, 0, {}, lattice, f);
  }
  void archive(Archive &a, const Lattice<D> &lattice) {
    a(in_use);
    a(unused_range);
    if (lattice.cube()) return;
    a(side);
    a(range);
  }
  double check(int32_t n, const Lattice<D> &lattice) const {
    Archive::check(unused_range == 1);
    if (in_use == 0) return 0.0;
    Archive::check(in_use == 1 && !lattice.cube());
    double looked_cells = 1.0, all = 1.0;
    for (int c = 0; c < D; ++c) {
      const int64_t cells = side[c], over = range[c];
      Archive::check(cells > 0 && cells < 1 << 20 && over >= 0 && over < 1 << 20);
      all *= static_cast<double>(cells);
      looked_cells *= 2.0 * static_cast<double>(over) + 1.0;
    }
    Archive::check(looked_cells <= 2.0 * n);
    return all;
  }

 private:
  // Components above c are chosen.
  template <class F>
  void walk(int c, const Home &home, size_t cell, const Offset &image, const Lattice<D> &lattice, F &&f) const {
    const int64_t cells = side[c];
    int64_t place = home[c] - range[c], turns = 0;
    while (place < 0) place += cells, --turns;
    Offset moved = image;
    if (turns != 0) lattice.add(moved, c, turns);
    for (int64_t step = -range[c]; step <= range[c]; ++step) {
      const size_t at = cell * static_cast<size_t>(cells) + static_cast<size_t>(place);
      if (c == 0)
        f(at, moved);
      else
        walk(c - 1, home, at, moved, lattice, f);
      if (++place == cells) place = 0, lattice.add(moved, c, 1);
    }
  }
};

}  // namespace jam
