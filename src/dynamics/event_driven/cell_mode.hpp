// Cell mode, for dilute systems, where lists are short-lived: a sphere meets those of the cells around its own, and
// leaving its cell is an event.
#pragma once
#include <algorithm>

#include "dynamics/event_driven/calendar.hpp"
#include "dynamics/event_driven/cell_grid.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"

namespace jam::inside {

template <int D>
struct CellMode {
  using Home = std::array<int32_t, D>;

  int64_t on = 0;  // 1: now
  CellGrid<D> grid;
  std::vector<int32_t> first, next;  // chains of the spheres in a cell
  std::vector<Home> cell;            // of each sphere: the one it was last seen to enter

  // Chooses cells for the largest contact distance, and the margin for growth; false where lists are better.
  // wanted: 1 wherever cells hold, -1 never, 0 where they are faster.
  bool choose(int32_t n, double sigma, int64_t wanted, double &margin) {
    using Tuning = CellModeTuning;
    on = 0;
    if (D > Tuning::highest_dimension || wanted < 0) return false;
    const double most = std::floor((1.0 - 1e-9) / (sigma * (1.0 + margin)));
    const double crowded = Tuning::crowded[std::min(D, Tuning::highest_dimension)];
    if (most < Tuning::fewest || (wanted == 0 && n > crowded * math::pow(most, D))) return false;
    const double side = std::max(Tuning::fewest, std::min(most, std::floor(math::pow(n / Tuning::fastest, 1.0 / D))));
    grid.side = static_cast<int64_t>(side);
    grid.range = 1;
    // The rest of the cell is space for growth.
    margin = std::min(Tuning::largest_margin, (1.0 - 1e-9) / (sigma * side) - 1.0);
    return true;
  }
  void build(const std::vector<std::array<uint64_t, D>> &place, const Lattice<D> &lattice) {
    on = 1;
    grid.make_scratch();
    first.assign(grid.total(), -1);
    next.resize(place.size());
    cell.resize(place.size());
    for (int32_t i = static_cast<int32_t>(place.size()) - 1; i >= 0; --i) {
      const auto home = grid.home(place[i], lattice);
      for (int c = 0; c < D; ++c) cell[i][c] = static_cast<int32_t>(home[c]);
      link(i, grid.number_of(cell[i]));
    }
  }
  // Writes the other spheres in the cells around that of i to `found`; returns their number.
  int32_t gather(int32_t i, const Lattice<D> &lattice, int32_t *found) const {
    const size_t cells = grid.cells_around(cell[i], lattice);
    int32_t count = 0;
    for (size_t s = 0; s < cells; ++s)
      for (int32_t k = first[grid.around[s]]; k >= 0; k = next[k])
        if (k != i) found[count++] = k;
    return count;
  }
  // Time until sphere i at b leaves its cell, and along which axis. scale: integer units to the box.
  double crossing_time(int32_t i, const Body<D> &b, double scale, int *axis) const {
    const double width = scale / static_cast<double>(grid.side);
    double best = never;
    for (int c = 0; c < D; ++c) {
      const double edge = static_cast<double>(cell[i][c]) * width;
      const double u = static_cast<double>(static_cast<int64_t>(b.x[c] - static_cast<uint64_t>(edge)));
      const double t = b.v[c] > 0.0 ? (width - u) / b.v[c] : b.v[c] < 0.0 ? -u / b.v[c] : never;
      if (t < best) {
        best = t;
        if (axis) *axis = c;
      }
    }
    return std::max(0.0, best);
  }
  // Takes sphere i at b into the cell that it enters now.
  void cross(int32_t i, const Body<D> &b, double scale) {
    int axis = 0;
    crossing_time(i, b, scale, &axis);
    unlink(i, grid.number_of(cell[i]));
    // The direction of flight decides: by rounding the position may still be inside the old cell.
    int32_t &place = cell[i][axis];
    place += b.v[axis] > 0.0 ? 1 : -1;
    if (place < 0) place += static_cast<int32_t>(grid.side);
    if (place == grid.side) place = 0;
    link(i, grid.number_of(cell[i]));
  }
  size_t number_of(int32_t i) const { return grid.number_of(cell[i]); }
  void archive(Archive &a, const Lattice<D> &lattice) {
    grid.archive(a, lattice);
    a(first);
    a(next);
    a(on);
    a(cell);
  }
  // Each sphere is in its cell, and in no other.
  void check(int32_t n, const Lattice<D> &lattice) {
    const double cells = grid.check(n, lattice);
    Archive::check(on == 1 && grid.side >= static_cast<int64_t>(CellModeTuning::fewest) && grid.range == 1);
    Archive::check(cell.size() == static_cast<size_t>(n) && next.size() == static_cast<size_t>(n) &&
                   cells == static_cast<double>(first.size()));
    for (const auto &home : cell)
      for (int32_t place : home) Archive::check(place >= 0 && place < grid.side);
    std::vector<char> seen(static_cast<size_t>(n), 0);
    int64_t met = 0;
    for (size_t k = 0; k < first.size(); ++k)
      for (int32_t i = first[k]; i >= 0; i = next[i]) {
        Archive::check(i < n && !seen[i] && number_of(i) == k);
        seen[i] = 1;
        ++met;
      }
    Archive::check(met == n);
    grid.make_scratch();
  }

 private:
  void link(int32_t i, size_t number) {
    next[i] = first[number];
    first[number] = i;
  }
  void unlink(int32_t i, size_t number) {
    int32_t *at = &first[number];
    while (*at != i) at = &next[*at];
    *at = next[i];
  }
};

}  // namespace jam::inside
