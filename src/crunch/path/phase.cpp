#include <algorithm>
#include <cmath>
#include <utility>

#include "crunch/approach/lp_step.hpp"
#include "crunch/control.hpp"
#include "crunch/path/barrier_path.hpp"
#include "crunch/phases.hpp"

namespace jam::inside {
namespace {

void add_history_row(CrunchState &s, double gap, size_t pairs, const PathPoint &at) {
  s.history.stage.path = at;
  HistoryRow &row = record_step(s, JAM_STEP_PATH);
  row[JAM_HISTORY_DUALITY_GAP] = gap;
  row[JAM_HISTORY_PAIRS] = static_cast<double>(pairs);
  if (s.history.details()) report_step(s, JAM_PHASE_CRUNCH, gap, row[JAM_HISTORY_STEP_MAX]);
}

}  // namespace

Phase follow_path(CrunchState &s) {
  s.history.stage.path_taken = true;
  s.last.active = ActiveSet();  // of the state before: an interrupted path leaves no contacts
  BarrierPathControl control;
  control.tuning = s.tuning;
  // Opens the gaps that the LP's own gain and the curvature of its step would close.
  control.opening = std::max({0.5 * s.out.report.gain, s.tuning.opening * s.out.report.max_step * s.out.report.max_step,
                              s.tuning.min_opening});
  control.strain = s.next.strain;
  control.least_gap = frees_cell(s) ? s.tuning.free_gap : s.o.duality_gap / s.tuning.lp_to_path_gap;
  if (s.next.strain.count() > 0) control.opening = s.tuning.free_opening;
  control.threads = s.o.threads;
  control.lps = s.out.report.lp_solves;
  control.from = s.history.stage.path;
  control.done = [&s](double part) { return part_done(s, part, 0.0); };
  control.on_step = [&s](double gap, size_t pairs, const PathPoint &at) { add_history_row(s, gap, pairs, at); };
  BarrierPathResult path = follow_barrier_path(s.out.packing, control, s.system, s.monitor);
  // Forces do not balance at every point of the path: then it continues to a smaller gap.
  while (path.reached && path.gap > s.tuning.path_end(s.out.packing) && s.o.duality_gap > 0.0 &&
         !stop_if_interrupted(s)) {
    if (ends_at_gap(s, path.multipliers)) return Phase::done;
    control.from = s.history.stage.path;
    control.least_gap = s.tuning.reduction * path.gap;
    path = follow_barrier_path(s.out.packing, control, s.system, s.monitor);
  }
  if (s.history.behind(s.out.packing)) add_history_row(s, path.gap, 0, PathPoint());
  if (stop_if_interrupted(s)) return Phase::identify;
  s.history.stage.path = PathPoint();
  s.monitor.log(JAM_LOG_INFO, "path: %s duality gap %.2e after %d factorisations, %d saddles, phi %.12f",
                path.reached ? "reached" : "stopped at", path.gap, path.factorisations, path.increases,
                packing_fraction(s.out.packing));
  if (path.reached && frees_cell(s)) return free_cell(s), Phase::barrier_path;
  s.next.bound = path.reached && s.o.step_bound == 0.0 ? s.tuning.min_bound : first_bound(s.out.packing, s.o, s.tuning);
  s.next.multipliers = std::move(path.multipliers);
  s.last.at_bound = 0;
  s.next.moved = path.reached ? 0.0 : 1.0;
  return Phase::approach;
}

}  // namespace jam::inside
