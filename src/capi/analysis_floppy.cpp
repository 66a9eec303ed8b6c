// Header section "analysis": floppy modes.
#include "analysis/floppy.hpp"
#include "capi/analysis.hpp"

using namespace jam;

extern "C" {

jam_status jam_floppy_mode(jam_system *sys, int64_t contact, double *out, size_t out_len, size_t *needed) {
  return guard_cancellable(sys, [&](const CancellationPoint &cancel_point) -> jam_status {
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    if (contact < 0 || static_cast<size_t>(contact) >= g.contacts())
      fail(JAM_E_ARGUMENT, "contact is %lld, it must be in 0..%zu", static_cast<long long>(contact),
           g.contacts() ? g.contacts() - 1 : 0);
    std::vector<double> dr(g.unknowns());
    if (out && out_len >= dr.size())
      FloppySolver(sys->packing, sys->contacts, g, cancel_point).fields(static_cast<size_t>(contact), 1, dr);
    return give_array(dr.data(), dr.size(), out, out_len, needed);
  });
}

jam_status jam_floppy_modes(jam_system *sys, double *median, size_t median_len, double *weight, size_t weight_len,
                            double *s_plus, size_t s_plus_len, double *s_star, size_t s_star_len, double *stability,
                            size_t stability_len, size_t *needed) {
  return guard_cancellable(sys, [&](const CancellationPoint &cancel_point) -> jam_status {
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    const size_t m = g.contacts();
    const bool none = !median && !weight && !s_plus && !s_star && !stability;
    if (!needed && none) fail(JAM_E_NULL, "needed is NULL and there is no output array");
    if (needed) *needed = m;
    check_output(median, median_len, m, "median");
    check_output(weight, weight_len, m, "weight");
    check_output(s_plus, s_plus_len, m, "s_plus");
    check_output(s_star, s_star_len, m, "s_star");
    check_output(stability, stability_len, m, "stability");
    if (m == 0) return JAM_NOT_JAMMED;
    if (none) return JAM_OK;
    const FloppyModes f = all_floppy_modes(sys->packing, sys->contacts, g, cancel_point);
    put_output(f.median, median, m);
    put_output(f.weight, weight, m);
    put_output(f.s_plus, s_plus, m);
    put_output(f.s_star, s_star, m);
    put_output(f.stability, stability, m);
    return JAM_OK;
  });
}

}  // extern "C"
