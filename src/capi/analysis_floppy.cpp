// Header section "analysis": floppy modes.
#include "analysis/floppy.hpp"
#include "capi/analysis.hpp"
#include "capi/table.hpp"

using namespace jam::inside;

extern "C" {

jam_status jam_floppy_mode(jam_system *sys, int64_t contact, double *out, size_t out_len, size_t *needed) {
  return guard_cancellable(sys, [&]() -> jam_status {
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    if (contact < 0 || static_cast<size_t>(contact) >= g.contacts())
      fail(JAM_E_ARGUMENT, "contact is %lld, it must be in 0..%zu", static_cast<long long>(contact),
           g.contacts() ? g.contacts() - 1 : 0);
    std::vector<double> dr(g.unknowns());
    if (out && out_len >= dr.size())
      FloppySolver(sys->packing, sys->contacts, g).fields(static_cast<size_t>(contact), 1, dr);
    return give_array(dr.data(), dr.size(), out, out_len, needed);
  });
}

jam_status jam_floppy_modes(jam_system *sys, int32_t columns, double *table, size_t table_len, size_t *needed) {
  return guard_cancellable(sys, [&]() -> jam_status {
    const Table<JAM_FLOPPY_COLUMNS> made(columns, table, table_len);
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    const bool wanted = made.wanted(g.contacts(), needed);
    if (g.contacts() == 0) return JAM_NOT_JAMMED;
    if (!wanted) return JAM_OK;
    const FloppyModes f = all_floppy_modes(sys->packing, sys->contacts, g);
    made.give(g.contacts(), [&](size_t k, auto &row) {
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
