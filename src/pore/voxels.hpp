// The brick as an image: each voxel solid or not, or the share of it that is solid.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "jam/jam.h"
#include "pore/images.hpp"
#include "pore/solid.hpp"

namespace jam::inside {

constexpr double voxel_outside = -1.0;  // outside a round container

struct VoxelGrid {
  std::array<int64_t, 3> count{1, 1, 1};
  std::array<double, 3> spacing{1.0, 1.0, 1.0};  // in d = 2 the third is that of x
  size_t layer() const { return static_cast<size_t>(count[0] * count[1]); }
  int64_t total() const { return count[0] * count[1] * count[2]; }
};
// JAM_E_ARGUMENT for what is no grid.
VoxelGrid voxel_grid(const Packing &p, const jam_voxel_options &o);

// Makes the image layer by layer, z ascending; x is fastest in each. A value is 0 or 1, or the share with lines > 0, or
// voxel_outside.
class VoxelImage {
 public:
  VoxelImage(const Packing &p, const VoxelGrid &grid, int lines);
  void fill_layer(int64_t z, double *out) const;

 private:
  void add_disk(const SphereImage &image, double height, double radius2, double *layer) const;
  void cut_line(const SphereImage &image, const Point &line, double &from, double &to) const;
  void add_share(double from, double to, double *row) const;
  const Packing &p_;
  VoxelGrid grid_;
  int lines_;
  Solid parts_;
  std::vector<SphereImage> images_;
  std::vector<std::vector<int32_t>> in_layer_;  // images that reach into each layer
};

}  // namespace jam::inside
