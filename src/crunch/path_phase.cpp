// Where the chain leaves the LPs for the barrier path: the curved valley between dilute and all but jammed.
#include <algorithm>
#include <cmath>

#include "crunch/barrier_path.hpp"
#include "crunch/barrier_schedule.hpp"
#include "crunch/sequential_lp.hpp"

namespace jam {
namespace {

// An LP that gains more than this strides through dilute space. Steps longer than the second (mean diameters) are a
// valley; below the third, forces of the last LP are where the path starts.
constexpr double strides = 3e-3, long_step = 1e-2, same_forces = 5e-3;
// Gaps that the path opens to at least: two digits above where rounding of coordinates blurs the barrier.
constexpr double least_room = 1e-10;
// A step l opens contacts by l^2. Where that is more than so many gains, and more than the path would open, LPs go
// round the valley's bend in steps that each win back what the last one opened.
constexpr double bend = 10.0;
constexpr int most_paths = 5;
// Of so many spheres a saddle at the end takes longer to leave than the LPs that tell which contacts it lacks; of 16384
// it does not.
constexpr size_t very_many = 32768;

}  // namespace

// The free spacing of a dilute start, down to a tenth of a diameter near jamming and less where gaps h are closed:
// floppy motion goes some tens of sqrt(h).
double SequentialLp::first_bound() const {
  if (o_.step_bound > 0.0) return o_.step_bound;
  return std::min(0.1 + 0.6 * free_spacing(out_.packing), std::max(1e-3, 100.0 * std::sqrt(contact_gap(out_.packing))));
}

// LPs take a dilute start in a few long strides, and finish at once what is all but jammed. Between the two lies a
// curved valley, where the barrier path needs fewer factorisations.
bool SequentialLp::in_valley(double gain, double step) const {
  return o_.method == JAM_CRUNCH_BARRIER_PATH && paths_ < most_paths && gain <= strides &&
         (step > long_step || step * step > std::max(bend * gain, least_room));
}

// Down the barrier path to where a few LPs finish. Where the path wanders the chain goes on from the state reached.
void SequentialLp::follow_path() {
  ++paths_;
  network_ = Network();  // was that of the state before: a path that is interrupted leaves no contacts
  BarrierPathControl control;
  // Gaps to be gained further on: a contact across a step of length l opens by l^2. Where the LP's forces hold, that
  // and the slack which it was left with are room enough.
  const bool holds = moved_ < same_forces;
  if (holds) control.start = &known_;
  control.room =
      std::max({holds ? 0.0 : 0.5 * out_.report.gain, 0.1 * out_.report.max_step * out_.report.max_step, least_room});
  control.threads = o_.threads;
  control.saddle_ends = out_.packing.n() >= very_many;
  control.on_step = [this](double gap, size_t pairs) { path_step(gap, pairs); };
  BarrierPathResult path = follow_barrier_path(out_.packing, control, system_, monitor_);
  if (history_.behind(out_.packing)) path_step(path.gap, 0);
  if (cut_off()) return;
  monitor_.log(JAM_LOG_INFO, "path: %s duality gap %.2e after %d factorisations, %d saddles, phi %.12f",
               path.reached ? "reached" : "stopped at", path.gap, path.factorisations, path.reheats,
               packing_fraction(out_.packing));
  bound_ = first_bound();
  const bool near_end = path.gap * BarrierSchedule::shrink <= control.target;
  if (near_end && o_.step_bound == 0.0)
    bound_ = std::min(1e-3, std::max(10.0 * std::sqrt(path.gap), 100.0 * narrowest));
  known_ = std::move(path.multipliers);
  held_ = 0;
  moved_ = path.reached ? 0.0 : 1.0;
  if (near_end) last_gain_ = path.gap;
}

void SequentialLp::path_step(double gap, size_t pairs) {
  HistoryRow &row = history_.moved(out_.packing, JAM_STEP_PATH, monitor_.seconds(), system_.factorisations);
  row[JAM_HISTORY_DUALITY_GAP] = gap;
  row[JAM_HISTORY_PAIRS] = static_cast<double>(pairs);
  if (history_.details()) show(JAM_PHASE_CRUNCH, gap, row[JAM_HISTORY_STEP_MAX]);
}

}  // namespace jam
