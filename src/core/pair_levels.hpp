// Spheres by the reach of their pairs, with cells for each level, from which pair lists are made: a small sphere meets
// those of its own size in small cells and large ones in large cells.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/packing.hpp"

namespace jam::inside {

// The level of a reach: how often it is halved from the widest one, except for less than a factor of two.
constexpr size_t most_halvings = 30;  // 1e9 between the widest and the narrowest
inline size_t halvings(double reach, double widest) {
  size_t count = 0;
  for (double r = 2.0 * reach; r < widest && count < most_halvings; r *= 2.0) ++count;
  return count;
}

// Spheres sorted by cell; a cell's members are members[start[cell] .. start[cell + 1]).
class PairCells {
 public:
  PairCells(const Packing &p, const std::vector<int32_t> &spheres, int64_t side);
  // Calls f(j) for every member of the 3^d cells around the place of i, a member or not.
  template <class F>
  void around(const Packing &p, int32_t i, F &&f) const {
    std::array<int64_t, JAM_MAX_DIM> at{};
    place(p, i, at.data());
    visit(dim_ - 1, 0, at, f);
  }

 private:
  void place(const Packing &p, int32_t i, int64_t *at) const;
  template <class F>
  void visit(int c, int64_t cell, const std::array<int64_t, JAM_MAX_DIM> &at, F &&f) const {
    if (c < 0) {
      for (int32_t k = start_[cell]; k < start_[cell + 1]; ++k) f(members_[k]);
      return;
    }
    for (int64_t step = -1; step <= 1; ++step) {
      const int64_t to = at[c] + step, k = to < 0 ? to + side_ : to < side_ ? to : to - side_;
      visit(c - 1, cell * side_ + k, at, f);
    }
  }
  int dim_;
  int64_t side_;
  Cell basis_;
  std::vector<int32_t> start_, members_;
};

struct PairLevel {
  std::vector<int32_t> member;       // ascending
  std::unique_ptr<PairCells> cells;  // null: fewer than four along an axis
};

// Levels of a factor of two in reach[i] + slope * diameter, coarsest first. The cells of each are no narrower than the
// cutoff of any of its spheres with one of its own level or a finer one.
std::vector<PairLevel> pair_levels(const Packing &p, const std::vector<double> &reach, double slope);

}  // namespace jam::inside
