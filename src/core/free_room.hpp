// Where another sphere may fit among those that are placed: a list of voxels of the brick. A voxel goes where no point
// of it is free, and is halved along all axes as the rest grows small. As spheres are added, no voxel becomes free
// again, so that points of the list have the law of random sequential addition, and an empty list is saturation
// (Zhang and Torquato, Phys. Rev. E 88, 053312).
#pragma once
#include <cstdint>
#include <vector>

#include "core/growing_cells.hpp"
#include "core/rng.hpp"

namespace jam::inside {

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
