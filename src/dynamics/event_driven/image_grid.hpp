// Cells along the cell vectors of any cell: they find the candidates of a list with their images. The Mari-Kurchan
// model has lists of its own.
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
    walk(D - 1, home, range, 0, {}, lattice, f);
  }
  // The same for all cells within a reach, in V^(1/d), of a place in `home`.
  template <class F>
  void each_within(const Home &home, double reach, const Lattice<D> &lattice, F &&f) const {
    walk(D - 1, home, range_within(reach, lattice), 0, {}, lattice, f);
  }
  double cells_within(double reach, const Lattice<D> &lattice) const {
    double cells = 1.0;
    for (const int64_t over : range_within(reach, lattice)) cells *= 2.0 * static_cast<double>(over) + 1.0;
    return cells;
  }
  // Of a search among n spheres, which looks at all of them where they are fewer than the cells.
  double cost_within(double reach, int32_t n, const Lattice<D> &lattice) const {
    const double all = n;
    return used() ? std::min(all, 0.5 * cells_within(reach, lattice) * (1.0 + n / static_cast<double>(total()))) : all;
  }
  void archive(Archive &a, const Lattice<D> &) {
    a(in_use);
    a(unused_range);
    a(side);
    a(range);
  }
  double check(int32_t n, const Lattice<D> &) const {
    Archive::check(unused_range == 1);
    if (in_use == 0) return 0.0;
    Archive::check(in_use == 1);
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
  std::array<int64_t, D> range_within(double reach, const Lattice<D> &lattice) const {
    std::array<int64_t, D> over;
    for (int c = 0; c < D; ++c)
      over[c] =
          static_cast<int64_t>(std::ceil(reach * (1.0 + 1e-9) * static_cast<double>(side[c]) / lattice.height(c)));
    return over;
  }
  // Components above c are chosen.
  template <class F>
  void walk(int c, const Home &home, const std::array<int64_t, D> &over, size_t cell, const Offset &image,
            const Lattice<D> &lattice, F &&f) const {
    const int64_t cells = side[c];
    int64_t place = home[c] - over[c], turns = 0;
    while (place < 0) place += cells, --turns;
    Offset moved = image;
    if (turns != 0) lattice.add(moved, c, turns);
    for (int64_t step = -over[c]; step <= over[c]; ++step) {
      const size_t at = cell * static_cast<size_t>(cells) + static_cast<size_t>(place);
      if (c == 0)
        f(at, moved);
      else
        walk(c - 1, home, over, at, moved, lattice, f);
      if (++place == cells) place = 0, lattice.add(moved, c, 1);
    }
  }
};

}  // namespace jam
