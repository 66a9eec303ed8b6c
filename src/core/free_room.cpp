// See free_room.hpp.
#include "core/free_room.hpp"

#include <limits>

#include "core/call_scope.hpp"
#include "core/tuning.hpp"

namespace jam::inside {

void FreeRoom::begin(const std::vector<int32_t> &order, size_t at) {
  // Distances of non-additive spheres need not fall with the diameter.
  const double part = p_.non_additivity == 0.0 ? PlaceTuning::serves : 1.0;
  smallest_ = order[at];
  for (size_t k = at; k < order.size() && p_.diameter[order[k]] >= part * p_.diameter[order[at]]; ++k)
    smallest_ = order[k];
  const size_t d = static_cast<size_t>(p_.dim);
  most_ = std::max(PlaceTuning::fewest_voxels, PlaceTuning::voxels_per_sphere * static_cast<double>(p_.n()));
  double wanted = 1.0;
  const auto parts = [&](size_t c) {
    return std::ceil(p_.cell.edge(c) / (PlaceTuning::voxel * p_.diameter[smallest_]));
  };
  for (size_t c = 0; c < d; ++c) wanted *= parts(c);
  const double coarser = wanted > most_ ? math::pow(most_ / wanted, 1.0 / p_.dim) : 1.0;
  std::vector<uint32_t> number(d), at_voxel(d, 0);
  edge_.resize(d);
  size_t total = 1;
  for (size_t c = 0; c < d; ++c) {
    number[c] = static_cast<uint32_t>(std::max(1.0, std::floor(coarser * parts(c))));
    edge_[c] = p_.cell.edge(c) / number[c];
    total *= number[c];
  }
  voxel_.reserve(total * d);
  for (size_t v = 0; v < total; ++v) {
    voxel_.insert(voxel_.end(), at_voxel.begin(), at_voxel.end());
    for (size_t c = 0; c < d && ++at_voxel[c] == number[c]; ++c) at_voxel[c] = 0;
  }
}

bool FreeRoom::may_fit(const uint32_t *voxel, const std::vector<double> &edge) const {
  Cell::Vector centre{};
  double square = 0.0;
  for (int c = 0; c < p_.dim; ++c) {
    centre[c] = (voxel[c] + 0.5) * edge[c];
    square += edge[c] * edge[c];
  }
  const double around = 0.5 * std::sqrt(square), radius = 0.5 * p_.diameter[smallest_];
  return p_.container.holds(centre.data(), radius - around) && !cells_.blocked(centre.data(), smallest_, around);
}

bool FreeRoom::sift(int halvings) {
  const size_t d = static_cast<size_t>(p_.dim), parts = size_t{1} << (halvings * p_.dim);
  std::vector<uint32_t> kept, part(d);
  std::vector<double> edge(edge_);
  for (double &e : edge) e = std::ldexp(e, -halvings);
  for (size_t v = 0; v < count(); ++v) {
    if (v % PlaceTuning::tries_between_looks == 0) CallScope::look();
    const uint32_t *whole = &voxel_[v * d];
    if (halvings && !may_fit(whole, edge_)) continue;
    for (size_t q = 0; q < parts; ++q) {
      for (size_t c = 0; c < d; ++c) part[c] = whole[c] << halvings | static_cast<uint32_t>(halvings ? q >> c & 1 : 0);
      if (may_fit(part.data(), edge)) kept.insert(kept.end(), part.begin(), part.end());
    }
    if (halvings && static_cast<double>(kept.size()) > most_ * p_.dim) return false;
  }
  voxel_ = std::move(kept), edge_ = std::move(edge);
  return true;
}

bool FreeRoom::refine(const std::vector<int32_t> &order, size_t at) {
  if (!known()) {
    begin(order, at);
    sift(0);
  } else {
    const bool fine = std::any_of(voxel_.begin(), voxel_.end(), [](uint32_t k) { return k >> 31; });
    if (fine || !sift(1)) sift(0);
  }
  return known();
}

void FreeRoom::random_point(Rng &rng, double *x) const {
  const size_t n = count();
  const size_t v = std::min(n - 1, static_cast<size_t>(rng.uniform() * static_cast<double>(n)));
  for (int c = 0; c < p_.dim; ++c) {
    const double in_brick = (voxel_[v * static_cast<size_t>(p_.dim) + c] + rng.uniform()) * edge_[c];
    x[c] = wrap(in_brick, p_.cell.edge(c));
  }
}

}  // namespace jam::inside
