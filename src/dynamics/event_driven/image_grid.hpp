// Cells along the cell vectors of any cell: they find the candidates of a list with their images. The Mari-Kurchan
// model has lists of its own.
#pragma once
#include <algorithm>
#include <cmath>

#include "dynamics/event_driven/cell_grid.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"

namespace jam::inside {

// What a search of cells with images needs, one for all grids: the cells, which image each is (a cell is there at most
// `copies` times), and the lattice vectors that take them there.
struct ImageCells {
  std::vector<size_t> cell;
  std::vector<int32_t> turn;
  std::vector<int64_t> image;  // (images, D)
  size_t copies = 1;
  std::vector<std::pair<size_t, int32_t>> along;  // scratch: places along an axis, and turns
  std::vector<int32_t> seen_from;                 // scratch

  void make_space(size_t cells, size_t width) {
    if (cell.size() < cells) cell.resize(cells), turn.resize(cells);
    if (along.size() < width) along.resize(width);
  }
  // Where a place stands for each image: its upper 32 bits, D numbers an image.
  template <size_t D>
  const int32_t *places(const std::array<uint64_t, D> &place) {
    seen_from.resize(image.size());
    for (size_t m = 0; m < image.size(); m += D)
      for (size_t c = 0; c < D; ++c)
        seen_from[m + c] = static_cast<int32_t>((place[c] - static_cast<uint64_t>(image[m + c])) >> 32);
    return seen_from.data();
  }
};

template <int D>
struct ImageGrid {
  using Home = std::array<int64_t, D>;
  using Offset = std::array<int64_t, D>;

  int64_t in_use = 0;
  std::array<int64_t, D> side{}, range{};  // along each cell vector

  bool used() const { return in_use != 0; }
  // Cells that reach over `range` others along each vector; more along those whose faces are near each other. None when
  // examining all spheres costs less. Returns the cost of a search in units of ListTuning.
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
  // No cells: all partners are examined.
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
      const auto at = static_cast<int64_t>(s[c] * static_cast<double>(side[c]));
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
  void make_scratch() {}
  // Writes the cells around a cell, each as often as an image of it is so near; returns their number.
  size_t cells_around(const Home &home, const Lattice<D> &lattice, ImageCells &found) const {
    return gather(home, range, lattice, found);
  }
  // The same for all cells within a reach, in V^(1/d), of a place in `home`.
  size_t gather_within(const Home &home, double reach, const Lattice<D> &lattice, ImageCells &found) const {
    return gather(home, range_within(reach, lattice), lattice, found);
  }
  double cells_within(double reach, const Lattice<D> &lattice) const {
    double cells = 1.0;
    for (const int64_t over : range_within(reach, lattice)) cells *= 2.0 * static_cast<double>(over) + 1.0;
    return cells;
  }
  // Of a search among n spheres, which examines all of them where they are fewer than the cells.
  double cost_within(double reach, int32_t n, const Lattice<D> &lattice) const {
    const double all = n;
    return used() ? std::min(all, 0.5 * cells_within(reach, lattice) * (1.0 + n / static_cast<double>(total()))) : all;
  }
  void archive(Archive &a, const Lattice<D> &) {
    a(in_use);
    a(side);
    a(range);
  }
  double check(int32_t n, const Lattice<D> &) const {
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
  [[gnu::noinline]] size_t gather(const Home &home, const std::array<int64_t, D> &over, const Lattice<D> &lattice,
                                  ImageCells &found) const {
    size_t cells = 1, count = 1, longest = 1;
    for (const int64_t o : over) {
      const auto width = static_cast<size_t>(2 * o + 1);
      cells *= width;
      longest = std::max(longest, width);
    }
    found.make_space(cells, longest);
    found.cell[0] = 0;
    found.turn[0] = 0;
    found.image.assign(D, 0);
    found.copies = 1;
    // Axis by axis, and from the last entry to the first, so that each is replaced after its last use.
    for (int c = D - 1; c >= 0; --c) {
      const auto width = static_cast<size_t>(2 * over[c] + 1);
      int64_t place = home[c] - over[c], least = 0;
      int32_t turns = 0;
      while (place < 0) place += side[c], --least;
      for (size_t s = 0; s < width; ++s) {
        found.along[s] = {static_cast<size_t>(place), turns};
        if (++place == side[c]) place = 0, ++turns;
      }
      const int32_t images = found.along[width - 1].second + 1;
      for (size_t k = count; k-- > 0;) {
        const size_t cell = found.cell[k] * static_cast<size_t>(side[c]);
        const int32_t from = found.turn[k] * images;
        for (size_t s = width; s-- > 0;) {
          found.cell[k * width + s] = cell + found.along[s].first;
          found.turn[k * width + s] = from + found.along[s].second;
        }
      }
      count *= width;
      if (images == 1) continue;
      if (2 * over[c] + 1 > side[c]) found.copies *= static_cast<size_t>(images);
      take_images(c, least, static_cast<size_t>(images), lattice, found.image);
    }
    return count;
  }
  // Each lattice vector becomes `times` of them, by so many turns along vector c from `least` on.
  [[gnu::noinline]] static void take_images(int c, int64_t least, size_t times, const Lattice<D> &lattice,
                                            std::vector<int64_t> &image) {
    const size_t before = image.size() / D;
    image.resize(before * times * D);
    for (size_t m = before; m-- > 0;) {
      Offset from;
      std::copy_n(&image[m * D], D, from.begin());
      for (size_t t = times; t-- > 0;) {
        Offset moved = from;
        lattice.add(moved, c, least + static_cast<int64_t>(t));
        std::copy_n(moved.begin(), D, &image[(m * times + t) * D]);
      }
    }
  }
  std::array<int64_t, D> range_within(double reach, const Lattice<D> &lattice) const {
    std::array<int64_t, D> over;
    for (int c = 0; c < D; ++c)
      over[c] =
          static_cast<int64_t>(std::ceil(reach * (1.0 + 1e-9) * static_cast<double>(side[c]) / lattice.height(c)));
    return over;
  }
};

// Cells that hold the centres of the safe spheres, in blocks of eight for pair_kernel's search.
template <int D>
struct ListCells {
  using Place = std::array<uint64_t, D>;
  static constexpr int lanes = Block<D>::lanes;

  std::vector<Block<D>> block;  // one of each cell, and further ones of overfull cells

  void clear(size_t cells) { block.assign(cells, empty()); }
  // centre: of all spheres.
  void put(int32_t i, size_t cell, const std::vector<Place> &centre) {
    const auto fill = [&](Block<D> &b, int l, int32_t sphere) {
      b.id[l] = sphere;
      for (int c = 0; c < D; ++c) b.x[c][l] = static_cast<int32_t>(centre[sphere][c] >> 32);
    };
    for (size_t at = cell;;) {
      Block<D> &b = block[at];
      for (int l = 0; l < lanes; ++l)
        if (b.id[l] == Block<D>::free) return fill(b, l, i);
      const int32_t last = b.id[lanes - 1];
      if (last < Block<D>::free) {
        at = static_cast<size_t>(Block<D>::link_to(last));
        continue;
      }
      // Full: the last centre moves to a further block, and a link takes its lane.
      Block<D> more = empty();
      fill(more, 0, last);
      fill(more, 1, i);
      b.id[lanes - 1] = Block<D>::link_to(static_cast<int32_t>(block.size()));
      block.push_back(more);
      return;
    }
  }
  void drop(int32_t i, size_t cell) {
    for (size_t at = cell;;) {
      Block<D> &b = block[at];
      for (int32_t &id : b.id)
        if (id == i) {
          id = Block<D>::free;
          return;
        }
      at = static_cast<size_t>(Block<D>::link_to(b.id[lanes - 1]));
    }
  }
  // meet(i, cell) for every sphere of a cell of an archive, whose links may lead anywhere.
  template <class F>
  void check(size_t cell, const std::vector<Place> &centre, F &&meet) const {
    int64_t blocks = 0;
    for (size_t at = cell;;) {
      const Block<D> &b = block[at];
      const int32_t last = b.id[lanes - 1];
      for (int l = 0; l < lanes; ++l) {
        if (b.id[l] == Block<D>::free || (l == lanes - 1 && last < Block<D>::free)) continue;
        meet(b.id[l], cell);
        for (int c = 0; c < D; ++c) Archive::check(b.x[c][l] == static_cast<int32_t>(centre[b.id[l]][c] >> 32));
      }
      if (last >= Block<D>::free) break;
      at = static_cast<size_t>(Block<D>::link_to(last));
      Archive::check(at < block.size() && ++blocks <= static_cast<int64_t>(block.size()));
    }
  }

 private:
  static Block<D> empty() {
    Block<D> b;
    std::fill(b.id, b.id + lanes, Block<D>::free);
    for (auto &axis : b.x) std::fill(axis, axis + lanes, 0);
    return b;
  }
};

}  // namespace jam::inside
