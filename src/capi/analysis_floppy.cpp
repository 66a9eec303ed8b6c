// Header section "analysis": floppy modes.
#include <numeric>
#include "analysis/floppy.hpp"
#include "capi/analysis.hpp"
#include "capi/table.hpp"

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

jam_status jam_floppy_modes(jam_system *sys, const int64_t *contact, size_t contact_len, int32_t columns, double *table,
                            size_t table_len, double *vector, size_t vector_len, size_t *rows) {
  return guard_cancellable(sys, [&]() -> jam_status {
    const Table<JAM_FLOPPY_COLUMNS> made(columns, table, table_len);
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    const std::vector<size_t> chosen = chosen_contacts(contact, contact_len, g.contacts());
    const size_t m = chosen.size(), n = g.unknowns();
    if (!rows && !made && !vector) fail(JAM_E_NULL, "rows is NULL and there is no output array");
    if (rows) *rows = m;
    made.check_room(m);
    check_output(vector, vector_len, m * n, "vector");
    if (g.contacts() == 0) return JAM_NOT_JAMMED;
    if (!made && !vector) return JAM_OK;
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
