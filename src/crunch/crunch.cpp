#include "crunch/crunch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "core/call_scope.hpp"
#include "core/error.hpp"
#include "core/math.hpp"
#include "core/pairs.hpp"
#include "crunch/state.hpp"

namespace jam {

double jammed_fraction(int dim) { return dim == 2 ? 0.84 : 0.64 * math::pow(0.7, dim - 3); }

double free_spacing(const Packing &p) {
  return std::max(0.0, math::pow(packing_fraction(p), -1.0 / p.dim) - math::pow(jammed_fraction(p.dim), -1.0 / p.dim));
}

CrunchState::CrunchState(const Packing &start, const jam_crunch_options &options, Monitor &monitor_in,
                         History &history_in, const CrunchHooks &hooks_in)
    : o(options), tuning(hooks_in.tuning), monitor(monitor_in), history(history_in), hooks(hooks_in) {
  out.packing = start;
  gain_tolerance = o.gain_tolerance;
  out.contacts.coordination.assign(start.n(), 0);
  out.report.struct_size = sizeof out.report;
  history.begin(start, o.steps != 0, o.keep_steps);
}

bool CrunchState::interrupted() {
  if (monitor.cancelled()) return stop(JAM_STOP_CANCELLED, JAM_CANCELLED), true;
  if (monitor.interrupted()) return stop(JAM_STOP_WALL_TIME, JAM_LIMIT), true;
  return false;
}

// An estimate for progress bars. The first decades of mu on a path take the longest, so the root of their share.
// Decades of gain in sequential LPs take about equal times.
double CrunchState::done(double path, double gain) {
  const Tuning &t = tuning;
  if (first_gain == 0.0) first_gain = gain;
  double part = path_taken ? 1.0 : 0.0;
  if (!std::isnan(path))
    part = t.part_before_path + (1.0 - t.part_before_path) * std::sqrt(path);
  else if (o.method == JAM_CRUNCH_SEQUENTIAL_LP && !std::isnan(log_share(first_gain, gain, gain_tolerance)))
    part = log_share(first_gain, gain, gain_tolerance);
  const double rounds = o.strain == JAM_STRAIN_NONE ? 1.0 : 2.0, begun = strain.count() > 0 ? 1.0 : 0.0;
  return (begun + t.part_before_verdict * part) / rounds;
}

bool CrunchState::show(jam_phase phase, double gain, double step, bool finished) {
  jam_progress progress = progress_of(phase);
  progress.packing_fraction = packing_fraction(out.packing);
  progress.fraction = done(std::numeric_limits<double>::quiet_NaN(), gain);
  progress.gain = gain;
  progress.max_step = step;
  progress.steps = out.report.lp_solves;
  progress.factorisations = system.factorisations;
  history.step().shown = finished && history.details();
  const bool stopped = monitor.report(progress, true);
  history.step().shown = false;
  return stopped;
}

// Where the stage of a crunch that was stopped leads. Options that ask for another way begin anew.
static Phase first_phase(CrunchState &s) {
  CrunchStage &stage = s.history.stage;
  const bool path = s.o.method == JAM_CRUNCH_BARRIER_PATH;
  if (!path || (stage.cell_free && s.o.strain == JAM_STRAIN_NONE)) stage = CrunchStage();
  const CrunchStage from = stage;
  if (from.cell_free) free_cell(s);
  s.path_taken = stage.path_taken = from.path_taken;
  return from.path.mu > 0.0 ? Phase::barrier_path : Phase::approach;
}

// Nothing touches but spheres their own images: at fixed cell no diameter can grow, and no LP is needed to see it.
static bool fills_cell(CrunchState &s) {
  const Packing &p = s.out.packing;
  if (s.o.strain != JAM_STRAIN_NONE || diameter_max(p) < p.cell.shortest() * (1.0 - contact_gap_limit)) return false;
  const PairList touching = find_pairs(p, 0.0, 1.0 + contact_gap_limit);
  for (size_t k = 0; k < touching.size(); ++k)
    if (!touching.own_image(k)) return false;
  s.stop(JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
  return true;
}

// What stands behind a status above 0.
static void explain(CrunchState &s) {
  const Packing &p = s.out.packing;
  const auto largest = std::max_element(p.diameter.begin(), p.diameter.end());
  if (s.out.status <= 0 || s.o.strain != JAM_STRAIN_NONE || *largest < p.cell.shortest() * (1.0 - contact_gap_limit))
    return;
  s.out.text = "sphere " + std::to_string(largest - p.diameter.begin()) +
               " touches its own image, nothing can grow here; a free cell (strain) gives way";
  s.monitor.log(JAM_LOG_WARNING, "%s", s.out.text.c_str());
}

// Searches for pairs and factorisations may throw Cancelled here.
static void run_phases(CrunchState &s) {
  jam_progress begun = progress_of(JAM_PHASE_CRUNCH);
  begun.packing_fraction = packing_fraction(s.out.packing);
  s.monitor.expect(begun);
  const LeavingScope scope(CallScope::memory_limit(), &s.monitor);
  if (fills_cell(s)) return;
  s.bound = first_bound(s.out.packing, s.o, s.tuning);
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
      case Phase::exact_vertex:
        phase = exact_vertex(s);
        break;
      case Phase::done:
        break;
    }
  }
}

// What is known before the first factorisation: the log says it, and what surely exceeds the memory of the call is
// refused.
// Small systems fit at any density.
static void look_ahead(const Packing &start, const jam_crunch_options &o, Monitor &monitor) {
  const bool logs = monitor.log_fn && monitor.log_level >= JAM_LOG_INFO;
  const double unknowns = static_cast<double>(start.position.size()), full_matrix = 8.0 * unknowns * unknowns;
  if (!logs && full_matrix < CallScope::memory_limit()) return;
  const jam_estimate e = estimate(start, o);
  if (logs)
    monitor.log(JAM_LOG_INFO,
                "estimate: %.3g MB, %lld pairs, %.3g flops a factorisation, about %.3g s for %.0f of them",
                e.bytes / 1e6, static_cast<long long>(e.pairs), e.flops, e.seconds, e.factorisations);
  // An estimate may be too high: between this and the limit each matrix decides before it is factorised.
  if (e.bytes > Tuning().estimate_too_high * CallScope::memory_limit())
    CallScope::need_memory(e.bytes, "the linear programs of this packing, as jam_estimate_crunch gives it,");
}

CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history,
                    const CrunchHooks *hooks) {
  check_options(start, o);
  const TimeLimit limit(monitor, o.wall_time);
  History own_history;
  const CrunchHooks no_hooks;
  CrunchState s(start, o, monitor, history ? *history : own_history, hooks ? *hooks : no_hooks);
  Touching touching;
  try {
    const LeavingScope scope(CallScope::memory_limit(), &monitor);
    look_ahead(start, o, monitor);
  } catch (const Cancelled &) {
    s.interrupted();
    finish_failed(s);
    return std::move(s.out);
  }
  try {
    {
      const LeavingScope scope(CallScope::memory_limit(), &monitor);
      touching = find_touching(start, o.strain != JAM_STRAIN_NONE);
    }
    run_phases(s);
    finish(s);
    explain(s);
  } catch (const Cancelled &) {  // in a search for pairs, or a factorisation
    s.interrupted();
    finish_failed(s);
  } catch (const Error &e) {
    s.stop(JAM_STOP_SOLVER, e.code());
    s.out.text = e.what();
    finish_failed(s);
  } catch (const std::bad_alloc &) {
    s.out.text.clear();
    s.stop(JAM_STOP_SOLVER, JAM_E_MEMORY);
    finish_failed(s);
  }
  report_changes(std::move(touching), packing_fraction(start), s);
  return std::move(s.out);
}

}  // namespace jam
