// Header section "analysis": gaps, classes, structure, correlations.
#include <algorithm>
#include <numeric>
#include "analysis/structure.hpp"
#include "capi/analysis.hpp"
#include "core/limits.hpp"
#include "core/pair_rule.hpp"

using namespace jam::inside;

namespace {

jam_correlation_options default_correlation_options() {
  jam_correlation_options o{};
  o.struct_size = sizeof o;
  o.a = o.b = -1;
  o.r_max = 4.0;
  o.bins = 200;
  return o;
}

}  // namespace

extern "C" {

jam_status jam_gaps(const jam_system *sys, double h_max, int32_t stable_only, double *gap, size_t gap_len,
                    int32_t *pair, size_t pair_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    check_flag(stable_only, "stable_only");
    if (stable_only) need_contacts(sys);
    const auto wanted = [&](size_t count) {
      return outputs_wanted(count, needed, {{gap, gap_len, count, "gap"}, {pair, pair_len, 2 * count, "pair"}});
    };
    if (!gap && !pair) {
      wanted(count_gaps(sys->packing, sys->contacts_of_any_kind(), h_max, stable_only != 0));
      return JAM_OK;
    }
    const Gaps g = find_gaps(sys->packing, sys->contacts_of_any_kind(), h_max, stable_only != 0);
    wanted(g.gap.size());
    put_output(g.gap, gap, g.gap.size());
    put_output(g.pair, pair, g.pair.size());
    return JAM_OK;
  });
}

jam_status jam_contact_classes(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    need_network(sys);
    if (!array_wanted(sys->contacts.size(), out, out_len, needed)) return JAM_OK;
    const std::vector<int32_t> flags = classify_contacts(sys->packing, sys->contacts);
    return give_array(flags.data(), flags.size(), out, out_len, needed);
  });
}

jam_status jam_sphere_structure(const jam_system *sys, int32_t weighted, double *c, size_t c_len, double *s,
                                size_t s_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    check_flag(weighted, "weighted");
    weighted ? need_network(sys) : need_contacts(sys);
    const size_t n = sys->packing.n();
    outputs_wanted(n, needed, {{c, c_len, sys->packing.position.size(), "c"}, {s, s_len, n, "s"}});
    const SphereStructure t = sphere_structure(sys->packing, sys->contacts, weighted != 0);
    put_output(t.c, c, t.c.size());
    put_output(t.s, s, t.s.size());
    return JAM_OK;
  });
}

jam_status jam_contact_dots(const jam_system *sys, int32_t weighted, double *dot, size_t dot_len, int32_t *sphere,
                            size_t sphere_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    check_flag(weighted, "weighted");
    weighted ? need_network(sys) : need_contacts(sys);
    const std::vector<size_t> of = count_contact_dots(sys->packing, sys->contacts, weighted != 0);
    const size_t count = std::accumulate(of.begin(), of.end(), size_t{0});
    if (!outputs_wanted(count, needed, {{dot, dot_len, count, "dot"}, {sphere, sphere_len, count, "sphere"}}))
      return JAM_OK;
    const ContactDots t = contact_dots(sys->packing, sys->contacts, weighted != 0);
    put_output(t.dot, dot, count);
    put_output(t.sphere, sphere, count);
    return JAM_OK;
  });
}

jam_status jam_fabric_tensor(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    need_contacts(sys);
    const std::vector<double> fabric = fabric_tensor(sys->contacts, sys->packing.dim);
    const jam_status status = give_array(fabric.data(), fabric.size(), out, out_len, needed);
    return status == JAM_OK && empty_network(sys) ? JAM_NOT_JAMMED : status;
  });
}

jam_status jam_stress(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    need_network(sys);
    const std::vector<double> stress = stress_tensor(sys->packing, sys->contacts);
    const jam_status status = give_array(stress.data(), stress.size(), out, out_len, needed);
    return status == JAM_OK && empty_network(sys) ? JAM_NOT_JAMMED : status;
  });
}

jam_status jam_local_values(const jam_system *sys, int32_t quantity, int32_t population, double *out, size_t out_len,
                            size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    need_network(sys);
    const size_t count = count_local_values(sys->packing, sys->contacts, quantity, population);
    if (!array_wanted(count, out, out_len, needed)) return JAM_OK;
    const std::vector<double> v = local_values(sys->packing, sys->contacts, quantity, population);
    return give_array(v.data(), v.size(), out, out_len, needed);
  });
}

jam_status jam_correlation_options_init(jam_correlation_options *o, size_t size) {
  return init_options(o, size, default_correlation_options());
}
jam_status jam_pair_correlation(const jam_system *sys, const jam_correlation_options *o, const int32_t *kind,
                                size_t kind_len, double *out, size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    jam_correlation_options full = default_correlation_options();
    take_options(o, full);
    if (kind_len) need(kind, "kind");
    check_pair_correlation(sys->packing, kind_len, full.r_max, full.bins);
    const auto bins = static_cast<size_t>(full.bins);
    if (!array_wanted(bins, out, out_len, needed)) return JAM_OK;
    const std::vector<double> g = pair_correlation(sys->packing, kind, kind_len, full.a, full.b, full.r_max, bins);
    return give_array(g.data(), g.size(), out, out_len, needed);
  });
}

jam_status jam_mk_shifts(const jam_system *sys, const int32_t *pair, size_t pair_len, double *out, size_t out_len,
                         size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    const Packing &p = sys->packing;
    if (p.model != JAM_MODEL_MK) fail(JAM_E_UNSUPPORTED, "only spheres of the Mari-Kurchan model have shifts");
    if (pair_len) need(pair, "pair");
    if (pair_len % 2) fail(JAM_E_ARGUMENT, "pair has %zu numbers, pairs have two spheres each", pair_len);
    const MkShifts quenched(p);
    const auto n = static_cast<int32_t>(p.n());
    std::vector<double> found(pair_len / 2 * p.dim, 0.0);
    for (size_t k = 0; k < pair_len / 2; ++k) {
      const int32_t i = pair[2 * k], j = pair[2 * k + 1];
      if (i < 0 || j < 0 || i >= n || j >= n)
        fail(JAM_E_ARGUMENT, "pair %zu is (%d, %d), spheres are 0..%d", k, i, j, n - 1);
      if (i == j) continue;  // an image of the sphere itself: not shifted
      Cell::Vector shift{};
      quenched.get(i, j, shift.data());
      p.cell.combine(shift.data(), shift.data());
      std::copy_n(shift.data(), p.dim, &found[k * p.dim]);
    }
    return give_array(found.data(), found.size(), out, out_len, needed);
  });
}

jam_status jam_structure_factor(jam_system *sys, double q_max, int32_t columns, double *table, size_t table_len,
                                size_t *needed) {
  return guard_cancellable(sys, [&]() -> jam_status {
    if (!needed && !table) fail(JAM_E_NULL, "needed is NULL and there is no output array");
    const Table<JAM_STRUCTURE_COLUMNS> made(columns, table, table_len);
    const StructureFactor f = structure_factor(sys->packing, q_max, !table);
    if (!made.wanted(f.q.size(), needed)) return JAM_OK;
    made.give(f.q.size(), [&](size_t k, auto &row) {
      row[JAM_STRUCTURE_Q] = f.q[k];
      row[JAM_STRUCTURE_S] = f.s[k];
    });
    return JAM_OK;
  });
}

jam_status jam_bond_order(const jam_system *sys, int32_t l, double cutoff, double *out, size_t out_len,
                          size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    check_bond_order(l, cutoff);
    if (!array_wanted(sys->packing.n(), out, out_len, needed)) return JAM_OK;
    const std::vector<double> q = bond_order(sys->packing, l, cutoff);
    return give_array(q.data(), q.size(), out, out_len, needed);
  });
}

jam_status jam_local_fraction(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    check_local_fractions(sys->packing);
    if (!array_wanted(sys->packing.n(), out, out_len, needed)) return JAM_OK;
    const std::vector<double> phi = local_fractions(sys->packing);
    return give_array(phi.data(), phi.size(), out, out_len, needed);
  });
}

}  // extern "C"
