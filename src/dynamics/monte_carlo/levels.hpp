// Spheres of very different size by level, with cells for each. Lists are made from them: a sphere searches for those
// of its own level and of coarser ones. Or the cells are kept, move by move, where lists would last for no sweep. The
// levels are those of core/pair_levels.hpp.
#pragma once
#include <algorithm>

#include "core/math.hpp"
#include "core/pair_levels.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

// Spheres by the cell that they are in, kept true move by move. For dilute hard spheres: their steps are so long that
// lists would last for no sweep.
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

template <int D>
class MonteCarloLevels {
 public:
  using Place = std::array<uint64_t, D>;

  // By radii, whose sum with that of any sphere of its own level or a finer one is at most twice the largest of it.
  explicit MonteCarloLevels(const std::vector<double> &radius) {
    if (radius.empty()) return;
    const double widest = *std::max_element(radius.begin(), radius.end());
    std::vector<Level> all(most_halvings + 1);
    of_.resize(radius.size());
    for (size_t i = 0; i < radius.size(); ++i) {
      Level &level = all[halvings(radius[i], widest)];
      level.member.push_back(static_cast<int32_t>(i));
      level.radius = std::max(level.radius, radius[i]);
    }
    for (Level &level : all) {
      for (const int32_t i : level.member) of_[i] = static_cast<int32_t>(level_.size());
      if (!level.member.empty()) level_.push_back(std::move(level));
    }
  }
  size_t count() const { return level_.size(); }

  // From now on the cells follow every move, until each_pair makes others.
  bool kept() const { return kept_; }
  void keep(const std::vector<Place> &x, double height, double stretch) {
    for (Level &level : level_) build(level, x, height / (2.0 * stretch * level.radius));
    height_ = height, stretch_ = stretch;
    kept_ = true;
  }
  void drop() { kept_ = false; }
  void move(int32_t i, const Place &to) {
    if (Level &level = level_[of_[i]]; level.cells.in_use()) level.cells.move(i, to);
  }
  // Whether f(k) is true of a sphere that may touch i, of this radius, at a place; f(i) is asked too.
  template <class F>
  bool any(int32_t i, const Place &at, double radius, F &&f) const {
    for (size_t k = 0; k < level_.size(); ++k) {
      const Level &level = level_[k];
      if (!level.cells.in_use()) {
        if (std::any_of(level.member.begin(), level.member.end(), f)) return true;
      } else if (static_cast<int32_t>(k) <= of_[i]) {
        if (level.cells.any(at, f)) return true;
      } else {
        const double cells = stretch_ * (radius + level.radius) / height_ * static_cast<double>(level.cells.side());
        if (level.cells.any_within(at, static_cast<size_t>(cells) + 1, f)) return true;
      }
    }
    return false;
  }

  // f(i, k) for all pairs nearer than `stretch` times the contact distance, and `skin`; for others too. height: of the
  // cell, in the same unit. between: called before every sphere.
  template <class F, class G>
  void each_pair(const std::vector<Place> &x, double height, double stretch, double skin, F &&f, G &&between) {
    drop();
    for (Level &level : level_) build(level, x, height / (2.0 * stretch * level.radius + skin));
    for (size_t own = 0; own < level_.size(); ++own)
      for (const int32_t i : level_[own].member) {
        between(i);
        for (size_t coarse = 0; coarse <= own; ++coarse) {
          const auto pair = [&](int32_t k) {
            if (coarse < own || k > i) f(i, k);
            return false;
          };
          const Level &level = level_[coarse];
          if (level.cells.in_use())
            level.cells.any(x[static_cast<size_t>(i)], pair);
          else
            std::for_each(level.member.begin(), level.member.end(), pair);
        }
      }
  }

 private:
  struct Level {
    std::vector<int32_t> member;  // ascending
    double radius = 0.0;          // the largest
    MonteCarloCells<D> cells;
  };
  static void build(Level &level, const std::vector<Place> &x, double fit) {
    level.cells.clear();
    if (!(fit >= static_cast<double>(MonteCarloTuning::fewest_cells))) return;
    const double enough = MonteCarloTuning::cells_per_sphere * static_cast<double>(level.member.size());
    level.cells.build(x, level.member, static_cast<size_t>(std::min(fit, math::pow(enough, 1.0 / D) + 1.0)));
  }
  std::vector<Level> level_;  // coarsest first
  std::vector<int32_t> of_;   // the level of each sphere
  bool kept_ = false;
  double height_ = 0.0, stretch_ = 1.0;
};

}  // namespace jam::inside
