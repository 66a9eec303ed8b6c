// Header section "the cell": cell vectors and affine strain.
#include <algorithm>
#include <limits>

#include "capi/analysis.hpp"
#include "capi/guard.hpp"
#include "capi/table.hpp"
#include "core/cell_reduction.hpp"
#include "core/create.hpp"
#include "core/digits.hpp"

using namespace jam;

namespace {

// What follows a change of the cell: overlaps are settled as at creation.
void take_cell(jam_system *sys, Packing &p) {
  settle_overlaps(p, p.overlap_allowed ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
  sys->commit(p);
  sys->packing.given = p.given;
}

}  // namespace

extern "C" {

jam_status jam_get_cell(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return guard_read(sys, [&]() -> jam_status {
    const std::vector<double> rows = sys->packing.cell.rows();
    return give_array(rows.data(), rows.size(), out, out_len, needed);
  });
}

jam_status jam_walls(const jam_system *sys, double *table, size_t table_len, size_t *needed) {
  return guard_read(sys, [&]() -> jam_status {
    const Packing &p = sys->packing;
    const Container &c = p.container;
    constexpr size_t columns = JAM_WALL_STRESS + 1;
    if (!table_wanted(static_cast<size_t>(c.count()), columns, table, table_len, needed)) return JAM_OK;
    const ContactNetwork *net = sys->known_contacts();
    const std::vector<double> stress = wall_stress(p, net ? *net : ContactNetwork());
    for (int w = 0; w < c.count(); ++w, table += columns) {
      const ClosestWall closest = closest_to_wall(p, w);
      table[JAM_WALL_AXIS] = c.axis(w);
      table[JAM_WALL_SIDE] = c.side(w);
      table[JAM_WALL_AREA] = c.area(w);
      table[JAM_WALL_PRESSURE] =
          p.wall_pressure.empty() ? std::numeric_limits<double>::quiet_NaN() : p.wall_pressure[static_cast<size_t>(w)];
      table[JAM_WALL_GAP] = closest.gap;
      table[JAM_WALL_STRESS] = stress[static_cast<size_t>(w)];
    }
    return JAM_OK;
  });
}

jam_status jam_set_cell(jam_system *sys, const double *cell, size_t cell_len, int64_t *transform, size_t transform_len,
                        double *rotation, size_t rotation_len, size_t *rows) {
  return guard_set(sys, [&]() -> jam_status {
    need(cell, "cell");
    Packing p = sys->packing;
    refuse_walls(p, "given another cell");
    check_matrix_len("cell", cell_len, p.dim);
    check_output(transform, transform_len, cell_len, "transform");
    check_output(rotation, rotation_len, cell_len, "rotation");
    const ReducedCell reduced = reduce_cell(p.dim, cell);
    p.given.take(digits_of(p.dim, p.position, p.diameter, std::vector<double>(cell, cell + cell_len)));
    enter_cell(p, reduced);
    take_cell(sys, p);
    put_output(reduced.transform, transform, cell_len);
    put_output(reduced.rotation, rotation, cell_len);
    if (rows) *rows = static_cast<size_t>(p.dim);
    return JAM_OK;
  });
}

jam_status jam_strain(jam_system *sys, const double *strain, size_t strain_len) {
  return guard_set(sys, [&]() -> jam_status {
    need(strain, "strain");
    Packing p = sys->packing;
    refuse_walls(p, "strained");
    check_matrix_len("strain", strain_len, p.dim);
    check_array_in(strain, strain_len, "strain");
    strain_affinely(p, strain);
    take_cell(sys, p);
    return JAM_OK;
  });
}

}  // extern "C"
