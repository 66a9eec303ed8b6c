// Equal cells of a cube, as many along each axis: they find the candidates of lists (image_grid.hpp), or take the place
// of lists (cell_mode.hpp).
#pragma once
#include <algorithm>
#include <cmath>

#include "core/archive.hpp"
#include "core/math.hpp"
#include "dynamics/event_driven/lattice.hpp"

namespace jam::inside {

// At most so many cells along an axis: few spheres a cell are enough.
inline double most_cells_along(int32_t n, int dim) {
  return std::floor(math::pow(CellTuning::per_sphere * n + CellTuning::at_least, 1.0 / dim));
}

template <int D>
struct CellGrid {
  using Home = std::array<int64_t, D>;  // a cell, axis by axis

  int64_t side = 0;                    // cells along an axis; 0: none
  int range = 1;                       // cells on either side that are searched
  mutable std::vector<size_t> around;  // scratch: cells that are searched

  bool used() const { return side > 0; }
  // Cells no wider than `reach` over the range, which is a part of the box; none when they would not be worth it.
  // Returns the cost of a search in units of ListTuning.
  double choose(int32_t n, double reach, const Lattice<D> &) {
    side = 0;
    double best = 0.5 * n;
    for (int r = 1; r <= CellTuning::longest_range; ++r) {
      const auto cells = static_cast<int64_t>(std::min(std::floor(r / reach), most_cells_along(n, D)));
      if (cells < 2 * r + 1) continue;
      const double looked_cells = math::pow(2.0 * r + 1.0, D);
      const double cost = looked_cells * 0.5 * (1.0 + n / math::pow(static_cast<double>(cells), D));
      if (cells * reach > r) continue;
      if (cost < best) best = cost, side = cells, range = r;
    }
    return best;
  }
  Home home(const std::array<uint64_t, D> &place, const Lattice<D> &) const {
    Home cell;
    for (int c = 0; c < D; ++c) cell[c] = static_cast<int64_t>(((place[c] >> 32) * static_cast<uint64_t>(side)) >> 32);
    return cell;
  }
  template <class Cell>
  size_t number_of(const Cell &home) const {
    size_t cell = 0;
    for (int c = D - 1; c >= 0; --c) cell = cell * static_cast<size_t>(side) + static_cast<size_t>(home[c]);
    return cell;
  }
  size_t total() const {
    size_t cells = 1;
    for (int c = 0; c < D; ++c) cells *= static_cast<size_t>(side);
    return cells;
  }
  void make_scratch() {
    size_t width = 1;
    for (int c = 0; c < D; ++c) width *= 2 * static_cast<size_t>(range) + 1;
    around.resize(width);
  }
  // Writes the cells within the range of a cell to `around`; returns their number.
  template <class Cell>
  size_t cells_around(const Cell &home, const Lattice<D> &) const {
    const size_t width = 2 * static_cast<size_t>(range) + 1;
    size_t count = 1, stride = 1;
    around[0] = 0;
    // Axis by axis, from the last cell to the first, so that each is replaced after its last use.
    for (int c = 0; c < D; ++c) {
      std::array<size_t, 2 * CellTuning::longest_range + 1> at;
      int64_t place = home[c] - range;
      if (place < 0) place += side;
      for (size_t s = 0; s < width; ++s) {
        at[s] = static_cast<size_t>(place) * stride;
        if (++place == side) place = 0;
      }
      for (size_t s = width; s-- > 0;)
        for (size_t k = 0; k < count; ++k) around[s * count + k] = around[k] + at[s];
      count *= width;
      stride *= static_cast<size_t>(side);
    }
    return count;
  }
  // Cells on either side within which all lies that is so near a place in a cell; reach: a part of the box.
  int64_t range_within(double reach) const {
    return static_cast<int64_t>(std::ceil(reach * (1.0 + 1e-9) * static_cast<double>(side)));
  }
  double cells_within(double reach, const Lattice<D> &) const {
    const double width = 2.0 * static_cast<double>(range_within(reach)) + 1.0;
    return math::pow(std::min(width, static_cast<double>(side)), D);
  }
  // Of a search among n spheres, which examines all of them where they are fewer than the cells.
  double cost_within(double reach, int32_t n, const Lattice<D> &lattice) const {
    const double all = 0.5 * n, cells = used() ? cells_within(reach, lattice) : all;
    return used() ? std::min(all, 0.5 * cells * (1.0 + n / static_cast<double>(total()))) : all;
  }
  // Writes the cells within this reach of a cell to `around`, each once; returns their number.
  size_t gather_within(const Home &home, double reach, const Lattice<D> &) const {
    const int64_t over = range_within(reach), width = std::min(2 * over + 1, side);
    around.assign(1, 0);
    for (int c = D - 1; c >= 0; --c) {
      const size_t before = around.size();
      int64_t place = (home[c] - std::min(over, side)) % side;
      if (place < 0) place += side;
      around.resize(before * static_cast<size_t>(width));
      for (int64_t step = width - 1; step >= 0; --step)
        for (size_t k = 0; k < before; ++k)
          around[static_cast<size_t>(step) * before + k] =
              around[k] * static_cast<size_t>(side) + static_cast<size_t>((place + step) % side);
    }
    return around.size();
  }
  void archive(Archive &a, const Lattice<D> &) {
    a(side);
    a(range);
  }
  // Returns the number of cells, as a double: a damaged file may hold any.
  double check(int32_t, const Lattice<D> &) const {
    Archive::check(range >= 1 && range <= CellTuning::longest_range);  // scratch grows with its power
    if (side == 0) return 0.0;
    Archive::check(side > 0 && side < 1 << 20 && side >= 2 * range + 1);
    return math::pow(static_cast<double>(side), D);
  }
};

}  // namespace jam::inside
