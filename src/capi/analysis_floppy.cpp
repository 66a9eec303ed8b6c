// Header section "analysis": floppy modes.
#include "analysis/floppy.hpp"
#include "capi/analysis.hpp"

using namespace jam;

extern "C" {

jam_status jam_floppy_mode(jam_system *sys, int64_t contact, double *out, size_t out_len, size_t *needed) {
  return guard_verb(sys, [&]() -> jam_status {
    need_network(sys);
    const StableGraph g = make_graph(sys->packing, sys->contacts);
    if (contact < 0 || static_cast<size_t>(contact) >= g.contacts())
      fail(JAM_E_ARGUMENT, "contact is %lld, it must be in 0..%zu", static_cast<long long>(contact), g.contacts() ? g.contacts() - 1 : 0);
    std::vector<double> dr(g.unknowns());
    if (out && out_len >= dr.size()) FloppySolver(sys->packing, sys->contacts, g).fields(static_cast<size_t>(contact), 1, dr);
    return give_array(dr.data(), dr.size(), out, out_len, needed);
  });
}

jam_status jam_floppy_modes(jam_system *sys, double *median, size_t median_len, double *s_plus, size_t s_plus_len, double *s_star,
                            size_t s_star_len, size_t *needed) {
  return guard_verb(sys, [&]() -> jam_status {
    need_network(sys);
    const StableGraph g = make_graph(sys->packing, sys->contacts);
    const size_t m = g.contacts();
    if (!needed && !median && !s_plus && !s_star) fail(JAM_E_NULL, "needed is NULL and there is no output array");
    if (needed) *needed = m;
    check_output(median, median_len, m, "median");
    check_output(s_plus, s_plus_len, m, "s_plus");
    check_output(s_star, s_star_len, m, "s_star");
    if (m == 0) return JAM_NOT_JAMMED;
    if (!median && !s_plus && !s_star) return JAM_OK;
    FloppyModes f;
    const jam_status status = all_floppy_modes(sys->packing, sys->contacts, g, sys->monitor, f);
    if (status == JAM_CANCELLED) return status;
    put_output(f.median, median, m);
    put_output(f.s_plus, s_plus, m);
    put_output(f.s_star, s_star, m);
    return status;
  });
}

}  // extern "C"
