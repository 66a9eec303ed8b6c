// Levels: the cells that find the candidates of lists, apart for spheres of different size. Spheres whose lists reach
// within a factor of two of each other share a level, which has cells of its own, so that a small sphere finds large
// ones in large cells and small ones in small cells. Levels are joined where this costs less; equal spheres have one.
#pragma once
#include <algorithm>
#include <type_traits>

#include "core/pair_levels.hpp"
#include "dynamics/event_driven/image_grid.hpp"

namespace jam::inside {

template <int D, Offsets O>
class Levels {
 public:
  static constexpr bool listed = O == Offsets::listed;
  using Grid = std::conditional_t<listed, ImageGrid<D>, CellGrid<D>>;
  using Place = std::array<uint64_t, D>;
  struct Level {
    Grid grid;                    // unused: all members are examined
    ListCells<D> cells;           // of the grid
    std::vector<int32_t> member;  // of a level without cells, and of one that larger spheres search
    double rho_max = 0.0;         // the longest list radius
    int32_t n = 0;
    double cost = 0.0;  // of a search by one of its own, in units of ListTuning
  };

  const std::vector<Level> &all() const { return level_; }
  bool single() const { return level_.size() == 1; }
  // No level: partners are found in another way.
  void clear() {
    level_.clear();
    of_.clear();
  }

  // Makes the levels of these list radii. unit: of lengths, in V^(1/d). Returns the mean cost of a search.
  // Once for many lists: `cold` makes it a third as long.
  [[gnu::cold]] double choose(const std::vector<double> &rho, double unit, const Lattice<D> &lattice) {
    std::vector<int32_t> halved = by_halves(rho);
    for (Level &l : level_) fit(l, unit, lattice);
    double cost = mean_cost(level_, unit, lattice);
    std::vector<int32_t> joined(level_.size());
    for (size_t k = 0; k < joined.size(); ++k) joined[k] = static_cast<int32_t>(k);
    while (join_cheapest(cost, joined, unit, lattice)) continue;
    of_.clear();
    if (!single())
      for (const int32_t h : halved) of_.push_back(joined[h]);
    // The images of a small cube are examined one by one.
    if (listed && lattice.cube() && single() && !level_[0].grid.used())
      return static_cast<double>(rho.size()) * ListTuning::look;
    return cost;
  }
  void fill(const std::vector<Place> &centre, const Lattice<D> &lattice) {
    for (size_t k = 0; k < level_.size(); ++k) {
      Level &l = level_[k];
      l.member.clear();
      if (!l.grid.used()) continue;
      l.grid.make_scratch();
      l.cells.clear(l.grid.total());
    }
    for (int32_t i = 0; i < static_cast<int32_t>(centre.size()); ++i) {
      Level &l = level_[of(i)];
      if (!l.grid.used() || &l != level_.data()) l.member.push_back(i);
      put(i, centre, lattice);
    }
  }
  void put(int32_t i, const std::vector<Place> &centre, const Lattice<D> &lattice) {
    Level &l = level_[of(i)];
    if (l.grid.used()) l.cells.put(i, cell_of(l, centre[i], lattice), centre);
  }
  void drop(int32_t i, const std::vector<Place> &centre, const Lattice<D> &lattice) {
    Level &l = level_[of(i)];
    if (l.grid.used()) l.cells.drop(i, cell_of(l, centre[i], lattice));
  }

  void archive(Archive &a, const Lattice<D> &lattice) {
    uint64_t count = level_.size();
    a(count);
    Archive::check(count <= most_halvings + 1);
    level_.resize(count);
    a(of_);
    for (Level &l : level_) {
      a(l.rho_max);
      a(l.cost);
      int64_t n = l.n;
      a(n);
      l.n = static_cast<int32_t>(n);
      l.grid.archive(a, lattice);
      a(l.cells.block);
      a(l.member);
    }
  }
  // Each sphere is in its level and cell, and in no other.
  void check(const std::vector<double> &rho, const std::vector<Place> &centre, const Lattice<D> &lattice) {
    const auto n = static_cast<int32_t>(rho.size());
    Archive::check(of_.size() == (level_.size() > 1 ? rho.size() : 0));
    for (const int32_t k : of_) Archive::check(k >= 0 && static_cast<size_t>(k) < level_.size());
    std::vector<char> in_cell(rho.size(), 0), member(rho.size(), 0);
    for (size_t k = 0; k < level_.size(); ++k) {
      Level &l = level_[k];
      Archive::check(l.n >= 0 && l.n <= n && std::isfinite(l.rho_max) && std::isfinite(l.cost));
      const auto belongs = [&](int32_t i) { Archive::check(i >= 0 && i < n && of(i) == k && rho[i] <= l.rho_max); };
      for (const int32_t i : l.member) {
        belongs(i);
        Archive::check(!member[i]);
        member[i] = 1;
      }
      Archive::check((l.grid.used() && k == 0) || static_cast<int32_t>(l.member.size()) == l.n);
      const double total = l.grid.check(l.n, lattice);
      if (!l.grid.used()) continue;
      l.grid.make_scratch();
      Archive::check(total <= static_cast<double>(l.cells.block.size()));
      int64_t met = 0;
      for (size_t cell = 0; static_cast<double>(cell) < total; ++cell)
        l.cells.check(cell, centre, [&](int32_t i, size_t at) {
          belongs(i);
          Archive::check(!in_cell[i] && cell_of(l, centre[i], lattice) == at);
          in_cell[i] = 1;
          ++met;
        });
      Archive::check(met == l.n);
    }
  }

 private:
  size_t of(int32_t i) const { return of_.empty() ? 0 : static_cast<size_t>(of_[i]); }
  static size_t cell_of(const Level &l, const Place &place, const Lattice<D> &lattice) {
    return l.grid.number_of(l.grid.home(place, lattice));
  }
  static void fit(Level &l, double unit, const Lattice<D> &lattice) {
    l.cost = l.grid.choose(l.n, 2.0 * l.rho_max * unit, lattice);
  }
  // Levels of a factor of two each, coarsest first; returns that of each sphere.
  std::vector<int32_t> by_halves(const std::vector<double> &rho) {
    const double widest = *std::max_element(rho.begin(), rho.end());
    std::vector<int32_t> halved(rho.size()), number(most_halvings + 1, -1);
    std::vector<Level> level(most_halvings + 1);
    for (size_t i = 0; i < rho.size(); ++i) {
      const size_t h = halvings(rho[i], widest);
      halved[i] = static_cast<int32_t>(h);
      level[h].rho_max = std::max(level[h].rho_max, rho[i]);
      ++level[h].n;
    }
    level_.clear();
    for (size_t h = 0; h <= most_halvings; ++h)
      if (level[h].n > 0) number[h] = static_cast<int32_t>(level_.size()), level_.push_back(level[h]);
    for (int32_t &h : halved) h = number[h];
    return halved;
  }
  // Over all spheres; each searches its own level, coarser ones and finer ones.
  static double mean_cost(const std::vector<Level> &level, double unit, const Lattice<D> &lattice) {
    double sum = 0.0, n = 0.0;
    for (size_t a = 0; a < level.size(); ++a) {
      double cost = 0.0;
      for (size_t l = 0; l < level.size(); ++l)
        cost += l <= a ? level[l].cost
                       : level[l].grid.cost_within((level[a].rho_max + level[l].rho_max) * unit, level[l].n, lattice);
      sum += level[a].n * cost;
      n += level[a].n;
    }
    return sum / n;
  }
  // Joins the two neighbouring levels whose junction saves most; false when none does.
  bool join_cheapest(double &cost, std::vector<int32_t> &joined, double unit, const Lattice<D> &lattice) {
    std::vector<Level> best;
    size_t at = 0;
    for (size_t k = 0; k + 1 < level_.size(); ++k) {
      std::vector<Level> trial = level_;
      trial[k].n += trial[k + 1].n;
      trial.erase(trial.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      fit(trial[k], unit, lattice);
      const double now = mean_cost(trial, unit, lattice);
      if (now <= cost) cost = now, best = trial, at = k;
    }
    if (best.empty()) return false;
    level_ = best;
    for (int32_t &k : joined)
      if (k > static_cast<int32_t>(at)) --k;
    return true;
  }

  std::vector<Level> level_;  // coarsest first
  std::vector<int32_t> of_;   // the level of each sphere; empty: one level
};

}  // namespace jam::inside
