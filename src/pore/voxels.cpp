#include "pore/profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/limits.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {

VoxelGrid voxel_grid(const Packing &p, const jam_voxel_options &o) {
  check_has_pores(p);
  VoxelGrid grid;
  const int32_t given[] = {o.nx, o.ny, o.nz};
  const char *const names[] = {"nx", "ny", "nz"};
  check_not_negative(o.size, "size");
  if (o.lines < 0 || o.lines > 64) fail(JAM_E_ARGUMENT, "lines is %d, it must be in 0..64", o.lines);
  const double size = o.size > 0.0 ? o.size : VoxelTuning::default_size * p.cell.side();
  for (int c = 0; c < p.dim; ++c) {
    const double edge = p.cell.edge(c), count = given[c] ? given[c] : std::max(1.0, std::nearbyint(edge / size));
    if (!(count >= 1.0 && count <= VoxelTuning::most))
      fail(JAM_E_ARGUMENT, "%s is %g voxels, it must be in 1..1e5", given[c] ? names[c] : "an edge of the brick",
           count);
    grid.count[c] = static_cast<int64_t>(count);
    grid.spacing[c] = edge / count;
  }
  if (p.dim == 2 && o.nz > 1) fail(JAM_E_ARGUMENT, "nz is %d, an image of disks has one layer", o.nz);
  if (p.dim == 2) grid.spacing[2] = grid.spacing[0];
  return grid;
}

VoxelImage::VoxelImage(const Packing &p, const VoxelGrid &grid, int lines)
    : p_(p), grid_(grid), lines_(lines), parts_(p) {
  std::vector<double> radius;
  for (const double sigma : p.diameter) radius.push_back(0.5 * sigma);
  images_ = images_near_brick(p, radius);
  in_layer_.resize(static_cast<size_t>(grid.count[2]));
  for (size_t k = 0; k < images_.size(); ++k) {
    int64_t first = 0, last = 0;
    if (p.dim == 3) {
      const double z = images_[k].centre[2], r = radius[static_cast<size_t>(images_[k].sphere)];
      first = std::max<int64_t>(0, static_cast<int64_t>(std::floor((z - r) / grid.spacing[2])));
      last = std::min<int64_t>(grid.count[2] - 1, static_cast<int64_t>(std::floor((z + r) / grid.spacing[2])));
    }
    for (int64_t z = first; z <= last; ++z) in_layer_[static_cast<size_t>(z)].push_back(static_cast<int32_t>(k));
  }
}

// The part [from, to] of a line along x, in voxels, adds its length to each.
void VoxelImage::add_share(double from, double to, double *row) const {
  const int64_t n = grid_.count[0];
  from = std::max(from, 0.0), to = std::min(to, static_cast<double>(n));
  if (!(from < to)) return;
  const auto first = static_cast<int64_t>(from);
  const int64_t last = std::min(n - 1, static_cast<int64_t>(to));
  const double each = p_.dim == 3 ? 1.0 / (static_cast<double>(lines_) * lines_) : 1.0 / lines_;
  for (int64_t x = first; x <= last; ++x) {
    const double length = std::min(to, static_cast<double>(x + 1)) - std::max(from, static_cast<double>(x));
    row[x] += each * length;
  }
}

// Of a line along x, the part from `from` to `to` that no other sphere counts and no wall cuts off.
void VoxelImage::cut_line(const SphereImage &image, const Point &line, double &from, double &to) const {
  const auto sphere = static_cast<size_t>(image.sphere);
  const Point at = minus({0.0, line[1], line[2]}, image.centre);
  for (const HalfSpace &h : parts_.cuts(sphere)) {
    const double rest = h.offset - dot(h.normal, at);  // normal[0] x <= rest
    if (h.normal[0] > 0.0)
      to = std::min(to, rest / h.normal[0]);
    else if (h.normal[0] < 0.0)
      from = std::max(from, rest / h.normal[0]);
    else if (rest < 0.0)
      to = from;
  }
  if (!parts_.passes_round_wall(sphere)) return;
  const double wall = 0.5 * p_.cell.edge(0);
  double half2 = wall * wall;
  for (int c = 1; c < p_.container.round_axes(); ++c) {
    const double off = line[static_cast<size_t>(c)] - wall;
    half2 -= off * off;
  }
  const double half = half2 > 0.0 ? std::sqrt(half2) : 0.0;
  from = std::max(from, wall - half), to = std::min(to, wall + half);
}

// The lines along x of one plane, which cuts the image in a disk of this squared radius.
void VoxelImage::add_disk(const SphereImage &image, double height, double r2, double *out) const {
  const double y = image.centre[1], r = std::sqrt(r2), step = grid_.spacing[1];
  const auto first = std::max<int64_t>(0, static_cast<int64_t>(std::floor((y - r) / step)));
  const auto last = std::min<int64_t>(grid_.count[1] - 1, static_cast<int64_t>(std::floor((y + r) / step)));
  const int lines = std::max(lines_, 1);
  for (int64_t row = first; row <= last; ++row)
    for (int k = 0; k < lines; ++k) {
      const double line = (static_cast<double>(row) + (k + 0.5) / lines) * step, dy = line - y, half2 = r2 - dy * dy;
      if (!(half2 >= 0.0)) continue;
      const double half = std::sqrt(half2), x = image.centre[0];
      double *const at = out + row * grid_.count[0];
      double from = x - half, to = x + half;
      if (lines_ > 0 && !parts_.is_whole(static_cast<size_t>(image.sphere)))
        cut_line(image, {0.0, line, height}, from, to);
      from /= grid_.spacing[0], to /= grid_.spacing[0];
      if (lines_ > 0) {
        add_share(from, to, at);
        continue;
      }
      const auto begin = std::max<int64_t>(0, static_cast<int64_t>(std::ceil(from - 0.5)));
      const auto end = std::min<int64_t>(grid_.count[0] - 1, static_cast<int64_t>(std::floor(to - 0.5)));
      for (int64_t v = begin; v <= end; ++v) at[v] = 1.0;
    }
}

void VoxelImage::fill_layer(int64_t z, double *out) const {
  CallScope::look();
  std::fill(out, out + grid_.layer(), 0.0);
  const int lines = p_.dim == 3 ? std::max(lines_, 1) : 1;
  for (const int32_t k : in_layer_[static_cast<size_t>(z)]) {
    const SphereImage &image = images_[static_cast<size_t>(k)];
    const double radius = 0.5 * p_.diameter[static_cast<size_t>(image.sphere)];
    for (int q = 0; q < lines; ++q) {
      const double height = (static_cast<double>(z) + (q + 0.5) / lines) * grid_.spacing[2];
      const double dz = p_.dim == 3 ? height - image.centre[2] : 0.0, r2 = radius * radius - dz * dz;
      if (r2 >= 0.0) add_disk(image, height, r2, out);
    }
  }
  const int w = p_.container.count() - 1;
  const bool round = w >= 0 && p_.container[w].curved(), passed = parts_.any_passes_round_wall();
  for (int64_t y = 0; y < grid_.count[1]; ++y)
    for (int64_t x = 0; x < grid_.count[0]; ++x) {
      double &value = out[y * grid_.count[0] + x];
      value = std::min(value, 1.0);  // by rounding
      if (!round || (value > 0.0 && (lines_ > 0 || !passed))) continue;
      const double centre[] = {(static_cast<double>(x) + 0.5) * grid_.spacing[0],
                               (static_cast<double>(y) + 0.5) * grid_.spacing[1],
                               (static_cast<double>(z) + 0.5) * grid_.spacing[2]};
      if (p_.container[w].distance(centre) < 0.0) value = voxel_outside;
    }
}

}  // namespace jam::inside
