// Header section "jammed or not": the verdict on a packing as it is.
#include <cstdio>

#include "capi/analysis.hpp"
#include "capi/proof.hpp"
#include "core/checks.hpp"
#include "crunch/crunch.hpp"
#include "verdict/check.hpp"
#include "verdict/text.hpp"

using namespace jam::inside;

namespace {

jam_check_options default_check_options() {
  jam_check_options o{};
  o.struct_size = sizeof o;
  o.crunch = 1;
  o.wall_time = std::numeric_limits<double>::infinity();
  return o;
}

// What a crunch does to an undecided packing. Where it fails, or does not end in time, the report says that no crunch
// ran.
void crunch_copy(const Packing &tested, double wall_time, Monitor &monitor, jam_check_report &r) {
  jam_crunch_options o = default_crunch_options();
  o.wall_time = monitor.seconds() + wall_time;
  try {
    const CrunchResult c = crunch(tested, o, monitor);
    if (monitor.cancelled()) throw Cancelled();
    if (c.status < 0 || c.report.stop_reason == JAM_STOP_WALL_TIME) return;
    r.crunch_jammed = c.report.jammed ? JAM_VERDICT_YES : JAM_VERDICT_UNDECIDED;
    r.crunch_contacts = c.report.contacts;
    r.crunch_packing_fraction = c.report.packing_fraction;
    r.crunch_displacement_max = c.report.displacement_max_stable;
    r.crunch_displacement_rms = c.report.displacement_rms_stable;
  } catch (const Cancelled &) {  // by the limit of the crunch, which is over
    if (monitor.cancelled()) throw;
  } catch (const Error &e) {
    monitor.log(JAM_LOG_WARNING, "check: no crunch of the copy: %s", e.what());
  }
}

// Mari-Kurchan shifts are no cell vectors: there nothing is proved.
void prove_tested(const CheckResult &result, jam_check_report &r) {
  if (r.jammed == JAM_VERDICT_YES && result.tested.packing.model == JAM_MODEL_EUCLID)
    take_proof(result.tested.packing, result.carrying, r);
}

std::string paragraph(const jam_check_report &r) {
  const bool tried = r.theorem != JAM_THEOREM_NONE || r.proof_cause != JAM_CAUSE_NONE;
  if (!tried) return text_of(r);
  return text_of(r) +
         (r.strictly_jammed == JAM_VERDICT_YES ? " Despite rounding, in the fixed cell: " : " Despite rounding: ") +
         proof_text(r.theorem, r.proof_cause, r.proof_radius, r.proof_value, r.proof_bound) + ".";
}

}  // namespace

extern "C" {

jam_status jam_check_options_init(jam_check_options *o, size_t size) {
  return init_options(o, size, default_check_options());
}

jam_status jam_check_packing(jam_system *sys, const jam_check_options *o, jam_check_report *report) {
  return guard_cancellable(sys, blank_report(), report, [&]() -> Answer {
    jam_check_options full = default_check_options();
    take_options(o, full);
    check_flag(full.crunch, "crunch");
    check_flag(full.prove, "prove");
    if (full.prove) sys->packing.container.know("a proof");
    if (!(full.wall_time > 0.0)) fail(JAM_E_ARGUMENT, "wall_time is %g, it must be > 0", full.wall_time);
    CheckResult result = check_as_it_is(sys->packing, sys->known_contacts());
    jam_check_report &r = result.report;
    r.struct_size = sizeof r;
    without_proof(r);
    if (full.prove) prove_tested(result, r);
    if (full.crunch && r.jammed == JAM_VERDICT_UNDECIDED)
      crunch_copy(result.tested.packing, full.wall_time, sys->monitor, r);
    give_struct(r, report);
    if (r.jammed == JAM_VERDICT_YES) return JAM_OK;
    return {r.jammed == JAM_VERDICT_NO ? JAM_NOT_JAMMED : JAM_AMBIGUOUS, paragraph(r)};
  });
}

const char *jam_check_text(const jam_check_report *report) {
  static thread_local char text[2048];
  text[0] = '\0';
  guard([&]() -> jam_status {
    if (!report) return JAM_OK;
    check_out_struct(report, "report");
    jam_check_report full = blank_report();  // what an older program does not know
    std::memcpy(&full, report, std::min<size_t>(report->struct_size, sizeof full));
    std::snprintf(text, sizeof text, "%s", paragraph(full).c_str());
    return JAM_OK;
  });
  return text;
}

}  // extern "C"
