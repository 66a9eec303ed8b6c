// Spheres of very different size by level, with cells for each. Lists are made from them: a sphere searches for those
// of its own level and of coarser ones. Or the cells are kept, move by move, where lists would last for no sweep. The
// levels are those of core/pair_levels.hpp.
#pragma once
#include <algorithm>
#include <vector>

#include "core/math.hpp"
#include "core/pair_levels.hpp"
#include "dynamics/monte_carlo/cells.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

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
