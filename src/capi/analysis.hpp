// What the analysis entry points share.
#pragma once
#include <limits>
#include "capi/table.hpp"
#include "network/rigidity_matrix.hpp"
#include "verdict/text.hpp"

namespace jam::inside {

// One whose forces balance.
inline void need_network(const jam_system *sys) {
  if (sys->by_distance())
    fail(JAM_E_STATE,
         "the contacts are those within a gap of %g (jam_contacts_by_distance), which have no forces: "
         "jam_contacts_from_geometry or jam_crunch gives a network that balances",
         sys->contact_gap);
  if (sys->has_report && !sys->known_contacts())
    fail(JAM_E_STATE,
         "the crunch stopped before its contacts were known: crunch to the end, or call jam_contacts_from_geometry");
  if (!sys->has_report)
    fail(JAM_E_STATE,
         "there is no contact network: call jam_crunch or jam_contacts_from_geometry first, or "
         "jam_contacts_by_distance for contacts without forces");
}
// One that may be of contacts by distance, which have no forces.
inline void need_contacts(const jam_system *sys) {
  if (!sys->by_distance()) need_network(sys);
}
// A verb whose work is left by Cancelled when the monitor says so; nothing has been written then.
template <class F>
jam_status guard_cancellable(jam_system *sys, F &&f) {
  return guard_verb(sys, [&]() -> Answer {
    const CancellableScope scope;
    try {
      return f();
    } catch (const Cancelled &) {
      return {JAM_CANCELLED, "jam_cancel or a callback stopped the call; it has changed and written nothing"};
    }
  });
}
// The same with a report, which is `unknown` where the call was left.
template <class Report, class F>
jam_status guard_cancellable(jam_system *sys, Report unknown, Report *report, F &&f) {
  return guard_cancellable(sys, [&]() -> Answer {
    check_out_struct(report, "report");
    try {
      return f();
    } catch (const Cancelled &) {
      unknown.struct_size = sizeof unknown;
      give_struct(unknown, report);
      throw;
    }
  });
}
// The report of a network that no crunch has made.
inline jam_crunch_report network_certificate(const Packing &p, const ContactNetwork &net, const PackingVerdict &verdict,
                                             const Monitor &monitor, bool free_cell = false) {
  jam_crunch_report r{};
  certify(p, net, r, free_cell);
  report_verdict(verdict, r);
  r.stop_reason = JAM_STOP_NONE;
  r.gain = r.max_step = r.gamma_residual = r.duality_gap = std::numeric_limits<double>::quiet_NaN();
  r.seconds = monitor.seconds();
  return r;
}
inline bool empty_network(const jam_system *sys) { return sys->contacts.size() == 0; }

inline jam_hessian_options take_hessian_options(const jam_hessian_options *h) {
  jam_hessian_options full = default_hessian_options();
  take_options(h, full);
  check_hessian_options(full);
  return full;
}

}  // namespace jam::inside
