// Header section "the pore space".
#include <cmath>
#include <limits>

#include "analysis/structure.hpp"
#include "capi/analysis.hpp"
#include "core/container.hpp"
#include "io/pore_space.hpp"

using namespace jam::inside;

namespace {

jam_voxel_options default_voxel_options() {
  jam_voxel_options o{};
  o.struct_size = sizeof o;
  return o;
}

jam_voxel_report report_of(const VoxelGrid &grid, int lines) {
  jam_voxel_report r{};
  r.struct_size = sizeof r;
  r.nx = static_cast<int32_t>(grid.count[0]);
  r.ny = static_cast<int32_t>(grid.count[1]);
  r.nz = static_cast<int32_t>(grid.count[2]);
  r.dx = grid.spacing[0], r.dy = grid.spacing[1], r.dz = grid.spacing[2];
  r.bytes = bytes_of_image(grid, lines);
  r.porosity = std::numeric_limits<double>::quiet_NaN();
  return r;
}

// Void over all. Shares are of whole voxels, which stand for the volume of the container; whole voxels count inside it.
class Porosity {
 public:
  Porosity(const Packing &p, const VoxelGrid &grid, int lines) : layer_(grid.layer()) {
    if (lines > 0) inside_ = scene_volume(p) / p.cell.volume() * static_cast<double>(grid.total());
    counts_ = lines == 0;
  }
  void add(const double *layer) {
    for (size_t k = 0; k < layer_; ++k) {
      if (layer[k] > 0.0) solid_ += layer[k];
      if (counts_ && layer[k] != voxel_outside) inside_ += 1.0;
    }
  }
  double value() const { return 1.0 - solid_ / inside_; }

 private:
  size_t layer_;
  bool counts_ = false;
  double solid_ = 0.0, inside_ = 0.0;
};

}  // namespace

extern "C" {

jam_status jam_mesh_options_init(jam_mesh_options *o, size_t size) {
  return init_options(o, size, default_mesh_options());
}
jam_status jam_voxel_options_init(jam_voxel_options *o, size_t size) {
  return init_options(o, size, default_voxel_options());
}

jam_status jam_write_stl(const jam_system *sys, const char *path, const jam_mesh_options *o, jam_mesh_report *report) {
  return guard_const(sys, [&]() -> Answer {
    check_out_struct(report, "report");
    jam_mesh_options full = default_mesh_options();
    take_options(o, full);
    const bool bridges = full.contacts == JAM_MESH_BRIDGED && full.walls != JAM_MESH_WALLS;
    if (bridges && full.bridge_gap == 0.0) need_contacts(sys);
    if (!path) {
      const int64_t triangles = estimated_triangles(sys->packing, sys->contacts_of_any_kind(), full);
      give_struct({sizeof(jam_mesh_report), 0, triangles, 0, stl_bytes(triangles), NAN, NAN}, report);
      return JAM_OK;
    }
    const SolidMesh mesh = solid_mesh(sys->packing, sys->contacts_of_any_kind(), full);
    jam_mesh_report r{};
    r.struct_size = sizeof r;
    r.bytes = write_stl(mesh, path);
    r.triangles = static_cast<int64_t>(mesh.triangle.size());
    r.bridges = mesh.bridges;
    r.volume = mesh.volume;
    r.solid = mesh.solid;
    give_struct(r, report);
    if (bridges && r.bridges == 0)
      return {JAM_NOT_JAMMED,
              full.bridge_gap > 0.0
                  ? sentence("no two spheres are within a gap of %g: the mesh has no bridge", full.bridge_gap)
                  : "the contact network joins no two spheres that a bridge could join: the mesh has "
                    "no bridge; bridge_gap bridges pairs by their distance"};
    return JAM_OK;
  });
}

jam_status jam_voxels(const jam_system *sys, const jam_voxel_options *o, jam_voxel_report *report, double *out,
                      size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    check_out_struct(report, "report");
    jam_voxel_options full = default_voxel_options();
    take_options(o, full);
    const VoxelGrid grid = voxel_grid(sys->packing, full);
    const size_t total = static_cast<size_t>(grid.total());
    jam_voxel_report r = report_of(grid, full.lines);
    if (outputs_wanted(total, needed, {{out, out_len, total, "out"}}, report)) {
      const VoxelImage image(sys->packing, grid, full.lines);
      Porosity porosity(sys->packing, grid, full.lines);
      for (int64_t z = 0; z < grid.count[2]; ++z) {
        double *const layer = out + static_cast<size_t>(z) * grid.layer();
        image.fill_layer(z, layer);
        porosity.add(layer);
      }
      r.porosity = porosity.value();
    }
    give_struct(r, report);
    return JAM_OK;
  });
}

jam_status jam_write_voxels(const jam_system *sys, const char *path, const jam_voxel_options *o,
                            jam_voxel_report *report) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    check_out_struct(report, "report");
    jam_voxel_options full = default_voxel_options();
    take_options(o, full);
    const VoxelGrid grid = voxel_grid(sys->packing, full);
    jam_voxel_report r = report_of(grid, full.lines);
    Porosity porosity(sys->packing, grid, full.lines);
    const VoxelImage image(sys->packing, grid, full.lines);
    write_image(image, grid, sys->packing.dim, full.lines, path, [&](const double *layer) { porosity.add(layer); });
    r.porosity = porosity.value();
    give_struct(r, report);
    return JAM_OK;
  });
}

jam_status jam_solid_profile(const jam_system *sys, int32_t axis, int32_t bins, int32_t columns, double *table,
                             size_t table_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    const Table<JAM_PROFILE_COLUMNS> made(columns, table, table_len);
    check_solid_profile(sys->packing, axis, bins);
    if (!made.wanted(static_cast<size_t>(bins), needed)) return JAM_OK;
    const Profile profile = solid_profile(sys->packing, axis, bins);
    made.give(profile.low.size(), [&](size_t k, auto &row) {
      row[JAM_PROFILE_LOW] = profile.low[k];
      row[JAM_PROFILE_HIGH] = profile.high[k];
      row[JAM_PROFILE_SOLID] = profile.solid[k];
    });
    return JAM_OK;
  });
}

jam_status jam_near_coordination(const jam_system *sys, double h_max, int32_t *out, size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    check_near_coordination(h_max);
    if (!array_wanted(sys->packing.n(), out, out_len, needed)) return JAM_OK;
    const std::vector<int32_t> z = near_coordination(sys->packing, h_max);
    return give_array(z.data(), z.size(), out, out_len, needed);
  });
}

jam_status jam_pore_sizes(jam_system *sys, int64_t points, int64_t seed, int32_t columns, double *table,
                          size_t table_len, size_t *needed) {
  return guard_cancellable(sys, [&]() -> jam_status {
    check_pore_points(sys->packing, points);
    const Table<JAM_PORE_COLUMNS> made(columns, table, table_len);
    if (!made.wanted(static_cast<size_t>(points), needed)) return JAM_OK;
    return give_table(pore_sizes(sys->packing, points, seed), columns, table, table_len, needed);
  });
}

}  // extern "C"
