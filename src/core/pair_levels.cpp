#include "core/pair_levels.hpp"

#include <algorithm>
#include <cmath>

#include "core/cell_reduction.hpp"
#include "core/math.hpp"

namespace jam::inside {

PairCells::PairCells(const Packing &p, const std::vector<int32_t> &spheres, int64_t side)
    : dim_(p.dim), side_(side), basis_(upright(p.cell)) {
  int64_t cells = 1;
  for (int c = 0; c < dim_; ++c) cells *= side_;
  start_.assign(static_cast<size_t>(cells) + 1, 0);
  std::vector<int64_t> home(spheres.size());
  SparseLook sparse_look;
  for (size_t k = 0; k < spheres.size(); ++k) {
    sparse_look();
    int64_t at[JAM_MAX_DIM], cell = 0;
    place(p, spheres[k], at);
    for (int c = dim_ - 1; c >= 0; --c) cell = cell * side_ + at[c];
    home[k] = cell;
    ++start_[static_cast<size_t>(cell) + 1];
  }
  for (size_t k = 1; k < start_.size(); ++k) start_[k] += start_[k - 1];
  members_.resize(spheres.size());
  std::vector<int32_t> fill(start_.begin(), start_.end() - 1);
  for (size_t k = 0; k < spheres.size(); ++k) members_[fill[home[k]]++] = spheres[k];
}

void PairCells::place(const Packing &p, int32_t i, int64_t *at) const {
  Cell::Vector s{};
  basis_.fraction(&p.position[static_cast<size_t>(i) * dim_], s.data());
  for (int c = 0; c < dim_; ++c) {
    // A soft sphere beyond a wall belongs to the outermost cell.
    const double part = p.cell.repeats(c) ? wrap(s[c], 1.0) : std::min(std::max(s[c], 0.0), 1.0);
    const auto k = static_cast<int64_t>(part * static_cast<double>(side_));
    at[c] = std::min(std::max<int64_t>(k, 0), side_ - 1);
  }
}

std::vector<PairLevel> pair_levels(const Packing &p, const std::vector<double> &reach, double slope) {
  const double per_diameter = slope * (1.0 + std::max(0.0, p.non_additivity));
  const auto of = [&](size_t i) { return reach[i] + per_diameter * p.diameter[i]; };
  double widest = 0.0;
  for (size_t i = 0; i < p.n(); ++i) widest = std::max(widest, of(i));
  constexpr size_t most = most_halvings;
  std::vector<PairLevel> level(most + 1);
  std::vector<double> longest(most + 1, 0.0), largest(most + 1, 0.0);
  for (size_t i = 0; i < p.n(); ++i) {
    const size_t halved = halvings(of(i), widest);
    level[halved].member.push_back(static_cast<int32_t>(i));
    longest[halved] = std::max(longest[halved], reach[i]);
    largest[halved] = std::max(largest[halved], p.diameter[i]);
  }
  const double height = upright(p.cell).height_min();
  double reach_max = 0.0, diameter_max = 0.0;  // of a level and all finer ones
  for (size_t k = most + 1; k-- > 0;) {
    reach_max = std::max(reach_max, longest[k]);
    diameter_max = std::max(diameter_max, largest[k]);
    const double n = static_cast<double>(level[k].member.size());
    // As many cells as spheres are enough; a side is never shorter than the cutoff. Nearest images are enough from
    // three cells on: two cells in a row would already need a second image.
    const double fit = height / (reach_max + per_diameter * diameter_max),
                 enough = std::ceil(math::pow(n, 1.0 / p.dim)) + 1.0;
    const auto side = static_cast<int64_t>(std::min(fit * (1.0 - 1e-12), enough));
    if (n > 0.0 && side >= 4) level[k].cells = std::make_unique<PairCells>(p, level[k].member, side);
  }
  const auto empty = [](const PairLevel &l) { return l.member.empty(); };
  level.erase(std::remove_if(level.begin(), level.end(), empty), level.end());
  return level;
}

}  // namespace jam::inside
