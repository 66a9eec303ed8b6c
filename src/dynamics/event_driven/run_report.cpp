// What a run of event-driven dynamics reports while it runs and at its end: observers, progress, report.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/call_scope.hpp"
#include "dynamics/event_driven/run.hpp"
#include "dynamics/event_driven/velocities.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

void EventDrivenRun::attach(Observer *observer) {
  if (!observer) return;
  call_.seen_collisions = collisions();
  call_.seen_time = time();
  call_.block = sums() - observer->left;
  engine_->observe(observer);
}

void EventDrivenRun::update(Observer &observer) const {
  observer.seen += collisions() - call_.seen_collisions;
  observer.time += time() - call_.seen_time;
}

void EventDrivenRun::detach(Observer *observer) {
  if (!observer) return;
  engine_->observe(nullptr);
  update(*observer);
  observer->left = sums() - call_.block;
}

// What is due at this collision; true when the callback requests a stop.
bool EventDrivenRun::observe(const Listeners &listeners) {
  Observer &observer = *listeners.observer;
  update(observer);
  call_.seen_collisions = collisions();
  call_.seen_time = time();
  if (observer.block_due()) {
    const bool whole = observer.end_block(sums() - call_.block);
    call_.block = sums();
    if (whole) sample(observer);
  }
  if (!observer.snapshot_due()) return false;
  jam_progress q = progress();
  q.snapshot = observer.end_snapshot();
  if (listeners.on_snapshot) listeners.on_snapshot(current());
  return listeners.monitor->report(q, true);
}

double EventDrivenRun::until_histograms(const Observer *observer) const {
  return observer ? call_.seen_time + (observer->next_histograms() - observer->time) : no_limit;
}

// Between two collisions; nothing of the run changes. False: the call must stop, and the next one takes them.
bool EventDrivenRun::sample_histograms(Observer &observer, double at) const {
  Packing p = p_;
  engine_->write_state(p, at - time());
  const CancellableScope scope;
  try {
    observer.take_histograms(p);
  } catch (const Cancelled &) {
    return false;
  }
  return true;
}

void EventDrivenRun::sample(Observer &observer) const {
  std::vector<double> way(p_.position.size());
  engine_->displacements(way);
  observer.take_sample(current(), way);
}

// ---- progress and report

// Of the aim that comes first. Growth takes about equal times for equal factors of pressure.
double EventDrivenRun::fraction() const {
  double most = std::numeric_limits<double>::quiet_NaN();  // fmax leaves it out
  if (goal_ < no_limit) most = static_cast<double>(collisions()) / goal_;
  if (stage_.time < no_limit) most = std::fmax(most, time() / stage_.time);
  if (!growing()) return most;
  most = std::fmax(most, log_share(first_pressure_, pressure_, std::min(stage_.pressure, finest_pressure())));
  if (stage_.packing_fraction < no_limit)
    most = std::fmax(
        most, log_share(jam::inside::packing_fraction(p_), engine_->packing_fraction(), stage_.packing_fraction));
  return most;
}

jam_progress EventDrivenRun::progress() const {
  jam_progress q = progress_of(phase());
  q.packing_fraction = engine_->packing_fraction();
  q.pressure = pressure_;
  q.collisions = call_.report_collisions + collisions() - call_.first_collisions;
  q.fraction = fraction();
  return q;
}

// Adds to the report, so that stages run one after the other give one.
void EventDrivenRun::finish(int32_t reason) {
  report.stop_reason = reason;
  report.collisions_per_second = static_cast<double>(report.collisions) / std::max(report.seconds, 1e-9);
  report.pressure = p_.pressure;
  report.pressure_error = standard_error();
  report.packing_fraction = jam::inside::packing_fraction(p_);
  report.energy_drift = kinetic_ > 0.0 && !growing() ? std::fabs(twice_kinetic(p_) / kinetic_ - 1.0) : 0.0;
  report.max_overlap =
      std::max({report.max_overlap, before_.worst_overlap, engine_->max_overlap, engine_->worst_overlap()});
  report.growth_rate = engine_->growth();
}

// NVE: of the mean over all windows. Growing: the last window is the mean of the last four parts.
double EventDrivenRun::standard_error() const {
  if (window_.pressures.size() < (growing() ? 2 * WindowTuning::parts : WindowTuning::fewest_for_error))
    return std::numeric_limits<double>::quiet_NaN();
  double mean = 0.0, square = 0.0;
  const double m = static_cast<double>(window_.pressures.size());
  for (double p : window_.pressures) mean += p / m;
  for (double p : window_.pressures) square += (p - mean) * (p - mean) / (m - 1.0);
  return std::sqrt(square / (growing() ? static_cast<double>(WindowTuning::parts) : m));
}

// Since the beginning of the stage, or of the protocol where this call began it.
double EventDrivenRun::collisions_per_sphere() const {
  return 2.0 * static_cast<double>(std::max(collisions(), report.collisions)) / n_;
}

// Growth from touching spheres: they collide without time to move, so the pressure of the first windows is beyond any
// aim. It says nothing about the density at which they jam. Spheres that dynamics brought near jamming have velocities.
bool EventDrivenRun::touched_at_start() const {
  const bool by_pressure = report.stop_reason == JAM_STOP_PRESSURE || report.stop_reason == JAM_STOP_PRECISION ||
                           (report.stop_reason == JAM_STOP_STALLED && frozen_ > 0);
  const bool aims_at_density = stage_.packing_fraction < no_limit;
  if (!growing() || !by_pressure || (aims_at_density && packing_fraction(p_) >= stage_.packing_fraction)) return false;
  return (aims_at_density || (drawn_ && !(pressure_ < WindowTuning::touching_pressure))) &&
         collisions_per_sphere() < WindowTuning::touching_start;
}

// Growth to a density cannot begin above it.
bool EventDrivenRun::denser_than_wanted() const {
  return growing() && report.stop_reason == JAM_STOP_PACKING_FRACTION &&
         packing_fraction(p_) > stage_.packing_fraction * (1.0 + WindowTuning::same_density);
}

std::string EventDrivenRun::text() const {
  char line[300] = "";
  if (touched_at_start()) {
    char aim[40] = "";
    if (stage_.packing_fraction < no_limit) std::snprintf(aim, sizeof aim, " of %.6g", stage_.packing_fraction);
    std::snprintf(
        line, sizeof line,
        "spheres touch at the start: growth ended at pressure %.3g after %.2g collisions a sphere, at packing "
        "fraction %.6g%s; unless they are jammed, jam_scale_diameters(sys, 0.99) before growth lets them move apart",
        pressure_, collisions_per_sphere(), packing_fraction(p_), aim);
    return line;
  }
  if (denser_than_wanted()) {
    std::snprintf(line, sizeof line,
                  "the packing fraction is %.6g already, above the %.6g that is wanted: growth does not lower it, "
                  "jam_scale_diameters does",
                  packing_fraction(p_), stage_.packing_fraction);
    return line;
  }
  const auto largest = std::max_element(p_.diameter.begin(), p_.diameter.end());
  const long long sphere = largest - p_.diameter.begin();
  const double phi = jam::inside::packing_fraction(p_);
  switch (report.stop_reason) {
    case JAM_STOP_STALLED:
      if (call_.box_full && *largest > WindowTuning::as_good_as_touching * p_.cell.shortest())
        std::snprintf(line, sizeof line,
                      "sphere %lld touches its own image, nothing can grow here (packing fraction %.6g)", sphere, phi);
      else if (call_.box_full)
        std::snprintf(line, sizeof line,
                      "two unlike spheres of the largest sizes would fill the cell, nothing can grow here (packing "
                      "fraction %.6g)",
                      phi);
      else if (frozen_ > 0)
        std::snprintf(
            line, sizeof line,
            "no time passes between collisions at pressure %.4g, packing fraction %.6g: spheres are in contact or "
            "grow too fast; crunch from here",
            pressure_, phi);
      else
        std::snprintf(line, sizeof line, "no collision comes: the spheres are at rest, move as one, or never meet");
      break;
    case JAM_STOP_PRECISION:
      std::snprintf(line, sizeof line,
                    "at pressure %.4g, packing fraction %.6g, gaps are as small as coordinates resolve; crunch from "
                    "here",
                    pressure_, phi);
      break;
    case JAM_STOP_WALL_TIME:
      std::snprintf(line, sizeof line, "wall_time ended at packing fraction %.6g; resume = 1 continues", phi);
      break;
    case JAM_STOP_CANCELLED:
      std::snprintf(line, sizeof line,
                    "cancelled by jam_cancel or a callback at packing fraction %.6g; resume = 1 continues", phi);
      break;
    case JAM_STOP_TIME:
    case JAM_STOP_COLLISIONS:
      if (growing())
        std::snprintf(line, sizeof line,
                      "the limit of %s came at pressure %.4g, packing fraction %.6g; resume = 1 with a larger one goes "
                      "on",
                      report.stop_reason == JAM_STOP_TIME ? "time" : "collisions_per_particle", pressure_, phi);
      break;
    case JAM_STOP_PRESSURE:
      if (missed_density())
        std::snprintf(line, sizeof line,
                      "growth ended at pressure %.4g and packing fraction %.6g, before the packing fraction %.6g",
                      pressure_, phi, stage_.packing_fraction);
      break;
    default:
      break;
  }
  return line;
}

bool EventDrivenRun::missed_density() const {
  return stage_.then == 0.0 && stage_.packing_fraction < no_limit &&
         jam::inside::packing_fraction(p_) < stage_.packing_fraction;
}

jam_status EventDrivenRun::status_of(int32_t reason) const {
  switch (reason) {
    case JAM_STOP_PRESSURE:
      return missed_density() || touched_at_start() ? JAM_NOT_CONVERGED : JAM_OK;
    case JAM_STOP_PACKING_FRACTION:
      return denser_than_wanted() ? JAM_NOT_CONVERGED : JAM_OK;
    case JAM_STOP_TIME:
    case JAM_STOP_COLLISIONS:
      return growing() ? JAM_LIMIT : JAM_OK;
    case JAM_STOP_WALL_TIME:
      return JAM_LIMIT;
    case JAM_STOP_CANCELLED:
      return JAM_CANCELLED;
    case JAM_STOP_PRECISION:
      return JAM_PRECISION;
    default:
      return JAM_NOT_CONVERGED;
  }
}

}  // namespace jam::inside
