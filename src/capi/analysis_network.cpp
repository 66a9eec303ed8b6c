// Header section "analysis": the network from geometry, states of self-stress.
#include "capi/analysis.hpp"
#include "capi/table.hpp"
#include "crunch/crunch.hpp"
#include "network/contacts_from_geometry.hpp"

using namespace jam;

extern "C" {

jam_status jam_geometry_options_init(jam_geometry_options *o, size_t size) {
  return init_options(o, size, default_geometry_options());
}

jam_status jam_contacts_from_geometry(jam_system *sys, const jam_geometry_options *o, jam_geometry_report *report) {
  return guard_cancellable(sys, [&](const CancellationPoint &cancel_point) -> jam_status {
    check_out_struct(report, "report");
    jam_geometry_options full = default_geometry_options();
    take_options(o, full);
    GeometryResult result = contacts_from_geometry(sys->packing, full, cancel_point);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    jam_crunch_report r{};
    certify(sys->packing, result.network, r);
    report_verdict(result.verdict, sys->packing.dim, r);
    r.stop_reason = JAM_STOP_NONE;
    r.gain = r.max_step = r.gamma_residual = r.duality_gap = nan;
    r.seconds = sys->monitor.seconds();
    sys->contacts = std::move(result.network);
    sys->report = r;
    sys->has_report = true;
    give_struct(result.report, report);
    return result.status;
  });
}

jam_status jam_contact_candidates(const jam_system *sys, double window, double *table, size_t table_len,
                                  size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    constexpr size_t columns = JAM_CANDIDATE_EXCESS + 1;
    const ContactCandidates c = contact_candidates(sys->packing, window);
    if (!table_wanted(c.limit.size(), columns, table, table_len, needed)) return JAM_OK;
    put_column(c.limit, JAM_CANDIDATE_LIMIT, columns, table);
    put_column(c.jump, JAM_CANDIDATE_JUMP, columns, table);
    put_column(c.contacts, JAM_CANDIDATE_CONTACTS, columns, table);
    put_column(c.excess, JAM_CANDIDATE_EXCESS, columns, table);
    return JAM_OK;
  });
}

jam_status jam_stress_states(jam_system *sys, double *force, size_t force_len, double *basis, size_t basis_len,
                             double *residual, size_t *needed) {
  return guard_cancellable(sys, [&](const CancellationPoint &cancel_point) -> jam_status {
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    check_output(force, force_len, g.contacts(), "force");
    if (!basis && basis_len != 0) fail(JAM_E_NULL, "basis is NULL but its length is %zu", basis_len);
    if (!needed && !force && !basis && !residual) fail(JAM_E_NULL, "needed is NULL and there is no output array");
    const StressStates s = find_stress(g, basis != nullptr, cancel_point);
    if (needed) *needed = static_cast<size_t>(s.dimension);
    check_output(basis, basis_len, s.basis.size(), "basis");
    put_output(s.force, force, s.force.size());
    put_output(s.basis, basis, s.basis.size());
    if (residual) *residual = s.residual;
    return !s.positive ? JAM_NOT_JAMMED : s.dimension > 1 ? JAM_AMBIGUOUS : JAM_OK;
  });
}

}  // extern "C"
