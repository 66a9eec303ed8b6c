// Header section "analysis": Hessian, modes, floppy modes.
#include <algorithm>
#include <numeric>

#include "analysis/modes.hpp"
#include "capi/analysis.hpp"
#include "core/call_scope.hpp"
#include "core/limits.hpp"

using namespace jam::inside;

namespace {

// The contacts that the caller names, or all of them.
std::vector<size_t> chosen_contacts(const int64_t *contact, size_t contact_len, size_t all) {
  if (contact_len) need(contact, "contact");
  std::vector<size_t> chosen(contact ? contact_len : all);
  if (!contact) std::iota(chosen.begin(), chosen.end(), size_t{0});
  for (size_t k = 0; k < contact_len; ++k) {
    if (contact[k] < 0 || static_cast<size_t>(contact[k]) >= all)
      fail(JAM_E_ARGUMENT, "contact[%zu] is %lld, it must be in 0..%zu", k, static_cast<long long>(contact[k]),
           all ? all - 1 : 0);
    chosen[k] = static_cast<size_t>(contact[k]);
  }
  return chosen;
}

}  // namespace

extern "C" {

jam_status jam_hessian_options_init(jam_hessian_options *o, size_t size) {
  return init_options(o, size, default_hessian_options());
}
jam_status jam_modes_options_init(jam_modes_options *o, size_t size) {
  return init_options(o, size, default_modes_options());
}

jam_status jam_hessian_map(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    return give_array(g.sphere.data(), g.sphere.size(), out, out_len, needed);
  });
}

jam_status jam_hessian(const jam_system *sys, const jam_hessian_options *h, int32_t *row_start, size_t row_start_len,
                       int32_t *column, size_t column_len, double *value, size_t value_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    const jam_hessian_options options = take_hessian_options(h);
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    const BlockMatrix h_blocks = make_hessian(g, contact_weights(g, diameter_mean(sys->packing), options));
    const size_t entries = csr_entries(h_blocks);
    if (!outputs_wanted(entries, needed,
                        {{row_start, row_start_len, h_blocks.rows() + 1, "row_start"},
                         {column, column_len, entries, "column"},
                         {value, value_len, entries, "value"}}))
      return empty_network(sys) ? JAM_NOT_JAMMED : JAM_OK;
    const CsrMatrix csr = to_csr(h_blocks);
    put_output(csr.start, row_start, csr.start.size());
    put_output(csr.column, column, csr.column.size());
    put_output(csr.value, value, csr.value.size());
    return empty_network(sys) ? JAM_NOT_JAMMED : JAM_OK;
  });
}

jam_status jam_modes(jam_system *sys, const jam_hessian_options *h, const jam_modes_options *o, int32_t columns,
                     double *table, size_t table_len, double *vector, size_t vector_len, size_t *needed) {
  return guard_verb(sys, [&]() -> jam_status {
    const jam_hessian_options options = take_hessian_options(h);
    jam_modes_options full = default_modes_options();
    take_options(o, full);
    full.memory_limit = std::min(full.memory_limit, CallScope::memory_limit());
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    check_modes_options(full, g);
    const size_t n = g.unknowns(), internal = n - std::min<size_t>(n, static_cast<size_t>(g.symmetries()));
    const size_t m = full.which == JAM_MODES_ALL ? n : std::min<size_t>(internal, static_cast<size_t>(full.count));
    const Table<JAM_MODE_COLUMNS> made(columns, table, table_len);
    const bool wanted = outputs_wanted(m, needed, {made.output(m), {vector, vector_len, m * n, "vector"}});
    if (m == 0) return JAM_NOT_JAMMED;
    if (!wanted) return JAM_OK;
    Modes modes;
    const jam_status status =
        find_modes(g, contact_weights(g, diameter_mean(sys->packing), options), full, sys->monitor, modes);
    if (status == JAM_CANCELLED) return status;
    put_output(modes.vector, vector, m * n);
    made.give(m, [&](size_t k, auto &row) {
      if (k >= modes.lambda.size()) return;
      row[JAM_MODE_LAMBDA] = modes.lambda[k];
      row[JAM_MODE_PARTICIPATION] = modes.participation[k];
    });
    return status;
  });
}

jam_status jam_bloch_modes(jam_system *sys, const jam_hessian_options *h, const double *wave, size_t wave_len,
                           int32_t columns, double *table, size_t table_len, double *vector, size_t vector_len,
                           size_t *rows) {
  return guard_cancellable(sys, [&]() -> jam_status {
    const jam_hessian_options options = take_hessian_options(h);
    const Packing &p = sys->packing;
    need(wave, "wave");
    if (wave_len != static_cast<size_t>(p.dim))
      fail(JAM_E_ARGUMENT, "wave has %zu numbers, it must have dim = %d", wave_len, p.dim);
    check_array_in(wave, wave_len, "wave");
    for (int c = 0; c < p.dim; ++c) {
      check_range("wave", wave[c], -limits::wave_max, limits::wave_max);
      if (!p.cell.repeats(c) && wave[c] != 0.0)
        fail(JAM_E_ARGUMENT, "wave[%d] is %g, and nothing repeats along this axis: a wall bounds it", c, wave[c]);
      if (p.model == JAM_MODEL_MK && wave[c] != 0.0)
        fail(JAM_E_ARGUMENT, "wave[%d] is %g, and Mari-Kurchan spheres have no copies: their shifts do not repeat", c,
             wave[c]);
    }
    need_network(sys);
    refuse_own_images_at(p, sys->contacts, wave);
    const RigidityMatrix g = make_rigidity_matrix(p, sys->contacts);
    const size_t n = g.unknowns();
    const Table<JAM_MODE_COLUMNS> made(columns, table, table_len);
    const bool wanted = outputs_wanted(n, rows, {made.output(n), {vector, vector_len, 2 * n * n, "vector"}});
    if (n == 0) return JAM_NOT_JAMMED;
    const CellsBack back = cells_back(p, sys->contacts);
    need_memory_for_bloch(g, back, wave);  // also of who asks for the size, before arrays are made for it
    if (!wanted) return JAM_OK;
    const Modes modes = bloch_modes(g, contact_weights(g, diameter_mean(p), options), back, wave, true);
    put_output(modes.vector, vector, 2 * n * n);
    made.give(n, [&](size_t k, auto &row) {
      row[JAM_MODE_LAMBDA] = modes.lambda[k];
      row[JAM_MODE_PARTICIPATION] = modes.participation[k];
    });
    return JAM_OK;
  });
}

jam_status jam_floppy_modes(jam_system *sys, const int64_t *contact, size_t contact_len, int32_t columns, double *table,
                            size_t table_len, double *vector, size_t vector_len, size_t *rows) {
  return guard_cancellable(sys, [&]() -> jam_status {
    const Table<JAM_FLOPPY_COLUMNS> made(columns, table, table_len);
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    const std::vector<size_t> chosen = chosen_contacts(contact, contact_len, g.contacts());
    const size_t m = chosen.size(), n = g.unknowns();
    const bool wanted = outputs_wanted(m, rows, {made.output(m), {vector, vector_len, m * n, "vector"}});
    if (g.contacts() == 0) return JAM_NOT_JAMMED;
    if (!wanted) return JAM_OK;
    std::vector<double> fields;
    const FloppyModes f = floppy_modes(sys->packing, sys->contacts, g, chosen, vector ? &fields : nullptr);
    put_output(fields, vector, m * n);
    made.give(m, [&](size_t k, auto &row) {
      row[JAM_FLOPPY_MEDIAN] = f.median[k];
      row[JAM_FLOPPY_WEIGHT] = f.weight[k];
      row[JAM_FLOPPY_S_PLUS] = f.s_plus[k];
      row[JAM_FLOPPY_S_STAR] = f.s_star[k];
      row[JAM_FLOPPY_STABILITY] = f.stability[k];
      row[JAM_FLOPPY_S_RETURN] = f.s_return[k];
    });
    return JAM_OK;
  });
}

}  // extern "C"
