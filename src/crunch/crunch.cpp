#include "crunch/crunch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "core/call_scope.hpp"
#include "core/error.hpp"
#include "core/pairs.hpp"
#include "crunch/approach/lp_step.hpp"
#include "crunch/control.hpp"
#include "crunch/estimate.hpp"
#include "crunch/phases.hpp"
#include "crunch/report.hpp"

namespace jam::inside {

CrunchState::CrunchState(const Packing &packing_of_call, const jam_crunch_options &options, Monitor &monitor_of_call,
                         History &history_of_call, const CrunchHooks &hooks_of_call)
    : start(packing_of_call),
      o(options),
      tuning(hooks_of_call.tuning),
      monitor(monitor_of_call),
      history(history_of_call),
      hooks(hooks_of_call) {
  out.packing = start;
  out.contacts.coordination.assign(start.n(), 0);
  out.report.struct_size = sizeof out.report;
  next.gain_tolerance = o.gain_tolerance;
  history.begin(start, o.steps != 0, o.keep_steps);
}

// The phase at which a stopped crunch continues. With options of another method it begins again.
static Phase first_phase(CrunchState &s) {
  CrunchStage &stage = s.history.stage;
  const bool path = s.o.method == JAM_CRUNCH_BARRIER_PATH;
  const uint8_t decompressions = stage.decompressions;
  if (!path || (stage.cell_free && s.o.strain == JAM_STRAIN_NONE)) stage = CrunchStage();
  stage.decompressions = decompressions;  // slices of a crunch make as many as one call
  const CrunchStage from = stage;
  if (from.cell_free) free_cell(s);
  stage.path_taken = from.path_taken;
  return from.path.mu > 0.0 ? Phase::barrier_path : Phase::approach;
}

// True if the only contacts are spheres with their own images. In a fixed cell no diameter can then grow.
static bool fills_cell(CrunchState &s) {
  const Packing &p = s.out.packing;
  if (p.container || s.o.strain != JAM_STRAIN_NONE || diameter_max(p) < p.cell.shortest() * (1.0 - contact_gap_limit))
    return false;
  const PairList touching = find_pairs(p, 0.0, 1.0 + contact_gap_limit);
  for (size_t k = 0; k < touching.size(); ++k)
    if (!touching.own_image(k)) return false;
  stop(s, JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
  give_verdict(s, {});
  if (s.found.verdict.jammed == Verdict::yes) stop(s, JAM_STOP_CONVERGED, JAM_OK);  // their images hold them
  return true;
}

// Searches for pairs and factorisations may throw Cancelled here.
static void run_phases(CrunchState &s) {
  jam_progress begun = progress_of(JAM_PHASE_CRUNCH);
  begun.packing_fraction = packing_fraction(s.out.packing);
  s.monitor.expect(begun);
  const CancellableScope scope(CallScope::memory_limit(), &s.monitor);
  if (fills_cell(s)) return;
  s.next.bound = first_bound(s.out.packing, s.o, s.tuning);
  for (Phase phase = first_phase(s); phase != Phase::done;) {
    switch (phase) {
      case Phase::approach:
        phase = approach(s);
        break;
      case Phase::barrier_path:
        phase = follow_path(s);
        break;
      case Phase::identify:
        phase = identify(s);
        break;
      case Phase::narrow_lps:
        phase = narrow_lps(s);
        break;
      case Phase::done:
        break;
    }
  }
}

// Logs the estimate before the first factorisation, and refuses what surely exceeds the memory of the call. Small
// systems fit at any density.
static void check_estimate(const Packing &start, const jam_crunch_options &o, Monitor &monitor) {
  const bool logs = monitor.log_fn && monitor.log_level >= JAM_LOG_INFO;
  const double unknowns = static_cast<double>(start.position.size()), full_matrix = 8.0 * unknowns * unknowns;
  if (!logs && full_matrix < CallScope::memory_limit()) return;
  const jam_estimate_report e = estimate(start, o);
  if (logs)
    monitor.log(JAM_LOG_INFO, "estimate: %s, %lld pairs, %.3g flops a factorisation, about %.3g s for %.0f of them",
                bytes_text(e.bytes).c_str(), static_cast<long long>(e.pairs), e.flops, e.seconds, e.factorisations);
  // An estimate may be too high: between this and the limit each matrix decides before it is factorised.
  if (e.bytes > EstimateTuning::too_high * CallScope::memory_limit())
    CallScope::need_memory(e.bytes, "the linear programs of this packing, as jam_estimate_crunch gives it,");
}

static jam_crunch_options with_usable_tolerance(jam_crunch_options o, const Monitor &monitor) {
  if (o.lp_tolerance <= Tuning::lp_rounding) return o;
  monitor.log(JAM_LOG_WARNING, "lp_tolerance is %g: LPs are solved to %g, the loosest that a crunch can use",
              o.lp_tolerance, Tuning::lp_rounding);
  o.lp_tolerance = Tuning::lp_rounding;
  return o;
}

CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history,
                    const CrunchHooks *hooks) {
  check_options(start, o);
  const TimeLimit limit(monitor, o.wall_time);
  History own_history;
  const CrunchHooks no_hooks;
  const CrunchHooks &used = hooks ? *hooks : no_hooks;
  CrunchState s(start, with_usable_tolerance(o, monitor), monitor, history ? *history : own_history, used);
  Touching touching;
  try {
    const CancellableScope scope(CallScope::memory_limit(), &monitor);
    check_estimate(start, o, monitor);
  } catch (const Cancelled &) {
    stop_if_interrupted(s);
    report_failure(s);
    return std::move(s.out);
  }
  try {
    {
      const CancellableScope scope(CallScope::memory_limit(), &monitor);
      touching = find_touching(start);
    }
    run_phases(s);
    report_end(s);
  } catch (const Cancelled &) {  // in a search for pairs, or a factorisation
    stop_if_interrupted(s);
    report_failure(s);
  } catch (const Error &e) {
    stop(s, JAM_STOP_SOLVER, e.code());
    s.out.text = e.what();
    report_failure(s);
  } catch (const std::bad_alloc &) {
    s.out.text.clear();
    stop(s, JAM_STOP_SOLVER, JAM_E_MEMORY);
    report_failure(s);
  }
  report_changes(std::move(touching), packing_fraction(start), s);
  return std::move(s.out);
}

}  // namespace jam::inside
