// Cells that hold the centres of the safe spheres, in blocks of eight for pair_kernel's search.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "core/archive.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"

namespace jam::inside {

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
