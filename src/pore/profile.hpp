// Solid fraction in slabs and shells, by the exact volumes of balls cut by planes, balls and cylinders. Where spheres
// overlap, or pass a wall, it is that of their union inside the container.
#pragma once
#include <array>

#include "core/packing.hpp"
#include "jam/jam.h"
#include "pore/solid.hpp"

namespace jam::inside {

// Volume (d = 2: area) of the part of a ball of this radius where x < t; the centre is at 0.
double volume_below(int dim, double radius, double t);
// Volume that two balls share, whose centres are `apart`.
double shared_volume(int dim, double a, double b, double apart);
// Volume that a ball and an infinite cylinder share; d = 3, centre `apart` from the axis. To 1e-12 of the ball.
double shared_with_cylinder(double ball, double cylinder, double apart);

struct Profile {
  std::vector<double> low, high, solid;
};
// axis < d: slabs between the faces of the cell that a_axis joins, by their distance; axis == d: shells about the
// centre of a ball or the axis of a cylinder. JAM_E_UNSUPPORTED for shells without a round container.
void check_solid_profile(const Packing &p, int axis, int bins);  // before the work
Profile solid_profile(const Packing &p, int axis, int bins);

// The largest spheres that fit into the pores.

// A row for each of `points` random points of the void (JAM_PORE_X ...). The largest sphere that contains a point and
// no solid is one of finitely many, and all of them are tried: those that touch d + 1 surfaces; d surfaces and the
// point; in d = 3 also d - 1 surfaces and the point, with the centre in the plane of these three. A round wall adds
// spheres that touch one surface less.
void check_pore_points(const Packing &p, int64_t points);
std::vector<std::array<double, 5>> pore_sizes(const Packing &p, int64_t points, int64_t seed);

// The brick as an image: each voxel solid or not, or the share of it that is solid.

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
