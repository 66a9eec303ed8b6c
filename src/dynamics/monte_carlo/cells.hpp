// Spheres by the cell that they are in, kept true move by move. For dilute hard spheres: their steps are so long that
// lists would last for no sweep.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace jam::inside {

template <int D>
class MonteCarloCells {
 public:
  using Place = std::array<uint64_t, D>;  // 2^64 to the box side

  bool in_use() const { return in_use_; }
  void clear() { in_use_ = false; }
  // side: cells along the box, at least 3, and none narrower than what is searched for.
  void build(const std::vector<Place> &x, size_t side) {
    begin(x, side);
    for (size_t i = 0; i < x.size(); ++i) put(static_cast<int32_t>(i), cell_at(x[i]));
  }
  // Of these spheres alone.
  void build(const std::vector<Place> &x, const std::vector<int32_t> &members, size_t side) {
    begin(x, side);
    for (const int32_t i : members) put(i, cell_at(x[static_cast<size_t>(i)]));
  }
  void move(int32_t i, const Place &to) {
    const size_t cell = cell_at(to);
    if (cell == cell_[i]) return;
    (before_[i] == none ? head_[cell_[i]] : next_[before_[i]]) = next_[i];
    if (next_[i] != none) before_[next_[i]] = before_[i];
    put(i, cell);
  }
  // Whether f(k) is true of a sphere in the cells around a place. The cell of the place itself comes first.
  template <class F>
  bool any(const Place &at, F &&f) const {
    return any_from<0>(at, 0, f);
  }
  // The same in all cells up to `reach` from that of the place along each axis, each once.
  template <class F>
  bool any_within(const Place &at, size_t reach, F &&f) const {
    return any_within_from<0>(at, 0, reach, f);
  }
  size_t side() const { return side_; }

 private:
  static constexpr int32_t none = -1;
  void begin(const std::vector<Place> &x, size_t side) {
    side_ = side;
    in_use_ = true;
    size_t total = 1;
    for (int c = 0; c < D; ++c) total *= side;
    head_.assign(total, none);
    next_.resize(x.size());
    before_.resize(x.size());
    cell_.resize(x.size());
  }
  // The upper 32 bits of x times cells, over 2^32.
  size_t digit(const Place &at, int c) const { return static_cast<size_t>((at[c] >> 32) * side_ >> 32); }
  size_t cell_at(const Place &at) const {
    size_t cell = 0;
    for (int c = 0; c < D; ++c) cell = cell * side_ + digit(at, c);
    return cell;
  }
  template <int C, class F>
  bool any_from(const Place &at, size_t cell, F &&f) const {
    if constexpr (C == D) {
      for (int32_t k = head_[cell]; k != none; k = next_[k])
        if (f(k)) return true;
      return false;
    } else {
      const size_t here = digit(at, C), begin = cell * side_;
      return any_from<C + 1>(at, begin + here, f) || any_from<C + 1>(at, begin + (here ? here - 1 : side_ - 1), f) ||
             any_from<C + 1>(at, begin + (here + 1 < side_ ? here + 1 : 0), f);
    }
  }
  template <int C, class F>
  bool any_within_from(const Place &at, size_t cell, size_t reach, F &&f) const {
    if constexpr (C == D) {
      for (int32_t k = head_[cell]; k != none; k = next_[k])
        if (f(k)) return true;
      return false;
    } else {
      const size_t count = std::min(2 * reach + 1, side_), first = digit(at, C) + side_ - std::min(reach, side_);
      for (size_t k = 0; k < count; ++k)
        if (any_within_from<C + 1>(at, cell * side_ + (first + k) % side_, reach, f)) return true;
      return false;
    }
  }
  void put(int32_t i, size_t cell) {
    cell_[i] = cell;
    before_[i] = none;
    next_[i] = head_[cell];
    if (next_[i] != none) before_[next_[i]] = i;
    head_[cell] = i;
  }

  size_t side_ = 0;
  bool in_use_ = false;
  std::vector<int32_t> head_, next_, before_;  // chains of the spheres in a cell
  std::vector<size_t> cell_;
};

}  // namespace jam::inside
