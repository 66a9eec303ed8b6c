// Header section "the cell": cell vectors, affine strain, copies side by side.
#include <algorithm>
#include <limits>

#include "capi/analysis.hpp"
#include "core/cell_change.hpp"
#include "core/create.hpp"
#include "core/decimal.hpp"
#include "network/tile.hpp"

using namespace jam::inside;

namespace {

// What follows a change of the cell: overlaps are settled as at creation, and vectors that were not kept are noted.
void take_cell(jam_system *sys, Packing &p, const NormalCell &normal) {
  apply_overlap_policy(p, p.overlap_allowed ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
  sys->commit(p);
  sys->packing.given = p.given;
  note_cell(normal, true, sys->notes);
}

// Of the copies of a packing with a report: what follows from positions and forces. Forces balance as before; whether
// more spheres have more motions is not known.
jam_crunch_report report_of_copies(const SystemState &of, const Packing &p, const ContactNetwork &net, int64_t copies) {
  bool own_images = false;
  for (size_t k = 0; k < of.contacts.size(); ++k) own_images = own_images || of.contacts.pairs.own_image(k);
  jam_crunch_report r{};
  r.struct_size = sizeof r;
  certify(p, net, r, own_images);
  r.lp_solver = of.report.lp_solver, r.method = of.report.method, r.stationary = of.report.stationary;
  r.zero_force_contacts = copies * of.report.zero_force_contacts;
  r.undecided_contacts = copies * of.report.undecided_contacts;
  r.undercoordinated = copies * of.report.undercoordinated;
  r.flexes = -1;
  r.rigidity_margin = r.gain = r.max_step = r.gamma_residual = r.duality_gap = std::numeric_limits<double>::quiet_NaN();
  r.status = JAM_OK;
  return r;
}

}  // namespace

extern "C" {

jam_status jam_get_cell(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return guard_read(sys, [&]() -> jam_status {
    const std::vector<double> rows = sys->packing.cell.rows();
    return give_array(rows.data(), rows.size(), out, out_len, needed);
  });
}

jam_status jam_walls(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t *needed) {
  return guard_read(sys, [&]() -> jam_status {
    const Packing &p = sys->packing;
    const Container &c = p.container;
    const Table<JAM_WALL_COLUMNS> made(columns, table, table_len);
    const auto walls = static_cast<size_t>(c.count());
    if (!made.wanted(walls, needed)) return JAM_OK;
    const ContactNetwork *net = sys->known_contacts();
    const std::vector<double> stress = wall_stress(p, net ? *net : ContactNetwork());
    made.give(walls, [&](size_t k, auto &row) {
      const int w = static_cast<int>(k);
      row[JAM_WALL_AXIS] = c[w].axis();
      row[JAM_WALL_SIDE] = c[w].side();
      row[JAM_WALL_AREA] = c[w].area();
      if (!p.wall_pressure.empty()) row[JAM_WALL_PRESSURE] = p.wall_pressure[k];
      row[JAM_WALL_GAP] = closest_to_wall(p, w).gap;
      row[JAM_WALL_STRESS] = stress[k];
    });
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
    constexpr bool changes_cell = true;  // whatever arrays it gives
    outputs_wanted(static_cast<size_t>(p.dim), rows,
                   {{transform, transform_len, cell_len, "transform"}, {rotation, rotation_len, cell_len, "rotation"}},
                   changes_cell);
    const NormalCell normal = normal_cell(p.dim, cell);
    p.given.take(digits_of(p.dim, p.position, p.diameter, std::vector<double>(cell, cell + cell_len)));
    enter_cell(p, normal);
    take_cell(sys, p, normal);
    put_output(normal.transform, transform, cell_len);
    put_output(normal.rotation, rotation, cell_len);
    return JAM_OK;
  });
}

jam_status jam_strain(jam_system *sys, const double *strain, size_t strain_len) {
  return guard_set(sys, [&]() -> jam_status {
    need(strain, "strain");
    Packing p = sys->packing;
    check_matrix_len("strain", strain_len, p.dim);
    check_array_in(strain, strain_len, "strain");
    const NormalCell normal = strain_affinely(p, strain);
    take_cell(sys, p, normal);
    return JAM_OK;
  });
}

jam_status jam_tile(const jam_system *src, const int32_t *count, size_t count_len, jam_system **out) {
  const auto make = [&]() -> jam_status {
    need(count, "count");
    need(out, "out");
    const Packing &p = src->packing;
    if (count_len != static_cast<size_t>(p.dim))
      fail(JAM_E_ARGUMENT, "count has %zu numbers, it must have dim = %d", count_len, p.dim);
    const Copies copies(p, count);
    auto sys = std::make_unique<jam_system>();
    ContactNetwork own;  // contacts of the copies that the network does not give
    if (src->known_contacts()) own = between_copies(p, unlisted_own_images(p, src->contacts), copies);
    const bool known = src->known_contacts() && own.size() == 0;
    if (known) sys->contacts = src->contacts;
    sys->packing = tile(p, copies, known ? &sys->contacts : nullptr);
    sys->update_diameters();
    sys->has_report = known;
    if (known)
      sys->report =
          copies.number() == 1 ? src->report : report_of_copies(*src, sys->packing, sys->contacts, copies.number());
    sys->memory_limit = src->memory_limit;
    sys->notes = src->notes;
    if (copies.number() > 1)
      sys->notes.say("%lld copies of a packing of %zu spheres side by side", static_cast<long long>(copies.number()),
                     p.n());
    if (src->by_distance())
      sys->notes.say(
          "the copies have no contacts: those by distance are not copied; jam_contacts_by_distance finds them");
    if (own.size() > 0)
      sys->notes.say(
          "the copies have no contact network: sphere %d touches its own image, a contact of the copies that "
          "the network of one fixed cell omits; jam_contacts_from_geometry lists those of the copies",
          own.pairs.i[0]);
    *out = sys.release();
    return JAM_OK;
  };
  return guard_const(src, make, "src");
}

}  // extern "C"
