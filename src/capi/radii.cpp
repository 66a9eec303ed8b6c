// Header section "radii as unknowns".
#include <utility>

#include "capi/analysis.hpp"
#include "radii/maximise.hpp"
#include "radii/options.hpp"

using namespace jam::inside;

extern "C" {

jam_status jam_radii_options_init(jam_radii_options *o, size_t size) {
  return init_options(o, size, default_radii_options());
}

jam_status jam_maximise_radii(jam_system *sys, const jam_radii_options *o, const double *weights, size_t weights_len,
                              jam_radii_report *report) {
  return guard_reporting(sys, report, [&]() -> Answer {
    jam_radii_options full = default_radii_options();
    take_options(o, full);
    sys->packing.container.know("jam_maximise_radii");
    check_array_in(weights, weights_len, "weights");
    check_radii(sys->packing, full, weights, weights_len);
    RadiiResult result = maximise_radii(sys->packing, full, weights_len ? weights : nullptr, sys->monitor);
    check_packing(result.packing, JAM_E_SOLVER);  // else all stays as before
    Results found;
    if (result.report.maximum) {
      found.report = network_certificate(result.packing, result.contacts,
                                         test_packing(result.packing, &result.contacts, Jamming::collective),
                                         sys->monitor, full.strain != JAM_STRAIN_NONE);
      if (full.strain == JAM_STRAIN_FREE)
        found.report.strictly_jammed =
            verdict_code(test_packing(result.packing, &result.contacts, Jamming::strict).jammed);
      found.report.status = found.report.jammed ? JAM_OK : JAM_NOT_JAMMED;
      found.contacts = std::move(result.contacts);
      found.has_report = true;
    }
    sys->commit(result.packing, std::move(found));
    if (sys->notes.text().find(result.notes.text()) == std::string::npos) sys->notes.append(result.notes);
    give_struct(result.report, report);
    if (result.status > 0 && !result.text.empty()) return {result.status, result.text};
    return stopped(result.status, result.report.stop_reason);
  });
}

}  // extern "C"
