// Phase 2: when LPs hand over to the barrier path, and where LPs go on after it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "crunch/barrier_path.hpp"
#include "crunch/state.hpp"

namespace jam {
namespace {

void add_history_row(CrunchState &s, double gap, size_t pairs, const PathPoint &at) {
  s.history.stage.path = at;
  HistoryRow &row = s.history.moved(s.out.packing, JAM_STEP_PATH, s.monitor.seconds(), s.system.factorisations);
  row[JAM_HISTORY_DUALITY_GAP] = gap;
  row[JAM_HISTORY_PAIRS] = static_cast<double>(pairs);
  if (s.history.details()) s.show(JAM_PHASE_CRUNCH, gap, row[JAM_HISTORY_STEP_MAX]);
}

}  // namespace

// LPs finish at once what is all but jammed. Before it the density rises along a curved valley, where the path needs
// fewer factorisations. One path at most: a second one after saddles gains nothing.
bool path_is_shorter(const CrunchState &s, double gain, double step) {
  const Tuning &t = s.tuning;
  if (s.o.method != JAM_CRUNCH_BARRIER_PATH || s.path_taken) return false;
  if (gain < t.crystal_gap && hyperstatic(s.answer.y, s.lp.dim * static_cast<double>(s.lp.n), t)) return false;
  return step > t.long_step || step * step > std::max(t.curvature_ratio * gain, t.min_opening);
}

Phase follow_path(CrunchState &s) {
  s.path_taken = s.history.stage.path_taken = true;
  s.active = ActiveSet();  // of the state before: an interrupted path leaves no contacts
  BarrierPathControl control;
  control.tuning = s.tuning;
  // Opens the gaps that the LP's own gain and the curvature of its step would close.
  control.opening =
      std::max({0.5 * s.out.report.gain, 0.1 * s.out.report.max_step * s.out.report.max_step, s.tuning.min_opening});
  control.strain = s.strain;
  control.least_gap = frees_cell(s) ? s.tuning.free_gap : s.o.duality_gap / s.tuning.lp_over_path;
  if (s.strain.count() > 0) control.opening = s.tuning.free_opening;
  control.threads = s.o.threads;
  control.lps = s.out.report.lp_solves;
  control.from = s.history.stage.path;
  control.done = [&s](double part) { return s.done(part, 0.0); };
  control.on_step = [&s](double gap, size_t pairs, const PathPoint &at) { add_history_row(s, gap, pairs, at); };
  BarrierPathResult path = follow_barrier_path(s.out.packing, control, s.system, s.monitor);
  // Forces do not balance at every point of the path: then it goes on to a smaller gap.
  while (path.reached && path.gap > s.tuning.path_end(s.out.packing) && s.o.duality_gap > 0.0 && !s.interrupted()) {
    if (ends_at_gap(s, path.multipliers)) return Phase::done;
    control.from = s.history.stage.path;
    control.least_gap = s.tuning.reduction * path.gap;
    path = follow_barrier_path(s.out.packing, control, s.system, s.monitor);
  }
  if (s.history.behind(s.out.packing)) add_history_row(s, path.gap, 0, PathPoint());
  if (s.interrupted()) return Phase::identify;
  s.history.stage.path = PathPoint();
  s.monitor.log(JAM_LOG_INFO, "path: %s duality gap %.2e after %d factorisations, %d saddles, phi %.12f",
                path.reached ? "reached" : "stopped at", path.gap, path.factorisations, path.increases,
                packing_fraction(s.out.packing));
  if (path.reached && frees_cell(s)) return free_cell(s), Phase::barrier_path;
  s.bound = path.reached && s.o.step_bound == 0.0 ? s.tuning.min_bound : first_bound(s.out.packing, s.o, s.tuning);
  s.multipliers = std::move(path.multipliers);
  s.at_bound = 0;
  s.moved = path.reached ? 0.0 : 1.0;
  return Phase::approach;
}

}  // namespace jam
