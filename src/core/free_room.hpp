// Where another sphere may fit among those that are placed: a list of voxels of the brick. A voxel goes where no point
// of it is free, and is halved along all axes as the rest grows small. As spheres are added, no voxel becomes free
// again, so that points of the list have the law of random sequential addition, and an empty list is saturation
// (Zhang and Torquato, Phys. Rev. E 88, 053312).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/cell_reduction.hpp"
#include "core/pair_rule.hpp"

namespace jam::inside {

// The spheres that are placed so far, in cells.

// Cells at least as wide as the largest diameter, as linked lists, since spheres are added one by one.
class GrowingCells {
 public:
  GrowingCells(const Packing &p, double cutoff) : p_(p), basis_(upright(p.cell)) {
    const double fit = basis_.height_min() / cutoff,
                 enough = std::ceil(math::pow(static_cast<double>(p.n()), 1.0 / p.dim));
    side_ = std::max<int64_t>(1, static_cast<int64_t>(std::min(fit * (1.0 - 1e-12), enough)));
    if (side_ < 3) side_ = 1;
    int64_t cells = 1;
    for (int c = 0; c < p.dim; ++c) cells *= side_;
    head_.assign(static_cast<size_t>(cells), -1);
    next_.assign(p.n(), -1);
  }
  void add(int32_t i) {
    const int64_t cell = cell_of(&p_.position[static_cast<size_t>(i) * p_.dim]);
    next_[i] = head_[cell];
    head_[cell] = i;
  }
  // Whether sphere i would overlap a sphere that is already placed: at x, and at all points within `around` of x.
  bool blocked(const double *x, int32_t i, double around = 0.0) const {
    if (side_ == 1) return in_cell(0, x, i, around);
    Cell::Vector s{};
    basis_.fraction(x, s.data());
    Neighbours near;
    int64_t stride = 1;
    for (int c = 0; c < p_.dim; ++c, stride *= side_) {
      const int64_t own = index(s[c]);
      near[c] = {own * stride, (own > 0 ? own - 1 : side_ - 1) * stride, (own + 1 < side_ ? own + 1 : 0) * stride};
    }
    return visit(p_.dim - 1, 0, near, x, i, around);
  }

 private:
  int64_t index(double s) const {
    return std::min(static_cast<int64_t>(wrap(s, 1.0) * static_cast<double>(side_)), side_ - 1);
  }
  int64_t cell_of(const double *x) const {
    Cell::Vector s{};
    basis_.fraction(x, s.data());
    int64_t cell = 0;
    for (int c = p_.dim - 1; c >= 0; --c) cell = cell * side_ + index(s[c]);
    return cell;
  }
  using Neighbours = std::array<std::array<int64_t, 3>, JAM_MAX_DIM>;  // along each axis: the own cell, then the others
  bool visit(int c, int64_t cell, const Neighbours &near, const double *x, int32_t i, double around) const {
    if (c < 0) return in_cell(cell, x, i, around);
    for (const int64_t one : near[c])
      if (visit(c - 1, cell + one, near, x, i, around)) return true;
    return false;
  }
  bool in_cell(int64_t cell, const double *x, int32_t i, double around) const {
    for (int32_t j = head_[cell]; j >= 0; j = next_[j]) {
      const double touch = contact_distance(p_, i, j) - around;
      if (!(touch > 0.0)) continue;
      Cell::Vector dx{};
      for (int c = 0; c < p_.dim; ++c) dx[c] = x[c] - p_.position[static_cast<size_t>(j) * p_.dim + c];
      bool near = false;
      if (side_ > 1) {  // then the nearest image alone is within reach
        p_.cell.nearest(dx.data());
        double r2 = 0.0;
        for (int c = 0; c < p_.dim; ++c) r2 += dx[c] * dx[c];
        near = r2 < touch * touch;
      } else {
        p_.cell.images(dx.data(), touch, [&](const double *) { near = true; });
      }
      if (near) return true;
    }
    return false;
  }
  const Packing &p_;
  const Cell basis_;
  int64_t side_;
  std::vector<int32_t> head_, next_;
};

class FreeRoom {
 public:
  FreeRoom(const Packing &p, const GrowingCells &cells) : p_(p), cells_(cells) {}
  bool known() const { return count() > 0; }
  void forget() { voxel_.clear(), smallest_ = -1; }
  // Whether the list has all voxels where sphere i may fit.
  bool serves(int32_t i) const { return p_.diameter[i] >= p_.diameter[smallest_]; }
  // Lists the room for sphere order[at] and those after it that are hardly smaller, or refines the list. False where no
  // room is left.
  bool refine(const std::vector<int32_t> &order, size_t at);
  // A uniform point of the voxels.
  void random_point(Rng &rng, double *x) const;

 private:
  size_t count() const { return voxel_.size() / static_cast<size_t>(p_.dim); }
  void begin(const std::vector<int32_t> &order, size_t at);
  bool may_fit(const uint32_t *voxel, const std::vector<double> &edge) const;
  // Voxels of the list, each in 2^halvings parts along every axis, without those that are taken. False: too many.
  bool sift(int halvings);
  const Packing &p_;
  const GrowingCells &cells_;
  int32_t smallest_ = -1;        // sphere of the list
  std::vector<uint32_t> voxel_;  // (count, dim)
  std::vector<double> edge_;     // of a voxel
  double most_ = 0.0;            // of them
};

}  // namespace jam::inside
