// A run of event-driven dynamics: windows of pressure, at whose ends it cools, slows down or ends.
#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/math.hpp"
#include "dynamics/event_driven/run.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {
namespace {

int32_t reason_of(Halt halt, const Monitor &monitor) {
  switch (halt) {
    case Halt::packing_fraction:
      return JAM_STOP_PACKING_FRACTION;
    case Halt::interrupted:
      return monitor.why_interrupted();
    case Halt::time:
      return JAM_STOP_TIME;
    default:
      return JAM_STOP_STALLED;
  }
}

}  // namespace

// A window is long enough for small noise and short enough that p changes little: d ln p = G sqrt(pi) / d a collision.
void EventDrivenRun::plan_window() {
  using Tuning = WindowTuning;
  double most = std::min(goal_ / Tuning::windows, Tuning::longest * n_), fewest = Tuning::fewest;
  if (growing()) {
    most =
        std::min(Tuning::longest_growing, std::max(Tuning::shortest_growing, Tuning::growth_in_window / growth_)) * n_;
    fewest = Tuning::fewest_growing;
  }
  window_.length = static_cast<int64_t>(std::max(fewest, most));
}

void EventDrivenRun::begin_part() {
  window_.part_goal = collisions() + std::max<int64_t>(1, window_.length / parts());
  // Sums start from zero: at p = 1e14 the sum over the stage would lose what a part adds.
  before_.sums = sums();
  engine_->sums.of_pressure = window_.of_part = PressureSums();
}

void EventDrivenRun::end_part() {
  const PressureSums ended = part_sums();
  window_.steady =
      window_.steady && ended.time_has_passed() && reduced_pressure(ended) > WindowTuning::steady * stage_.pressure;
  if (ended.time_has_passed()) {
    window_.pressures.push_back(reduced_pressure(ended));
    if (growing() && window_.pressures.size() > WindowTuning::kept_parts)
      window_.pressures.erase(window_.pressures.begin());
    else if (window_.pressures.size() == WindowTuning::kept_windows)
      merge_windows();
  }
  window_.whole += ended;
  ++window_.part;
}

// A long run has windows of twice the length from here on: no more of them than its error needs.
void EventDrivenRun::merge_windows() {
  std::vector<double> &p = window_.pressures;
  for (size_t k = 0; 2 * k < p.size(); ++k) p[k] = 0.5 * (p[2 * k] + p[2 * k + 1]);
  p.resize(p.size() / 2);
  window_.length *= 2;
}

// Runs to the end of the part or of the stage, or to a limit. JAM_STOP_NONE: the part has ended.
int32_t EventDrivenRun::advance_part(const Listeners &listeners) {
  const double most = std::min(goal_, 9e18);
  while (collisions() < window_.part_goal) {
    if (static_cast<double>(collisions()) >= most) return JAM_STOP_COLLISIONS;
    int64_t stop = std::min(window_.part_goal, static_cast<int64_t>(std::ceil(most)));
    Observer *observer = listeners.observer;
    if (observer && observer->next_stop() < std::numeric_limits<int64_t>::max())
      stop = std::min(stop, std::max(collisions() + 1, observer->next_stop() - observer->seen + call_.seen_collisions));
    const double histograms = until_histograms(observer);
    if (observer) engine_->set_time_limit(std::min(stage_.time, histograms) - time());
    const Halt halt = engine_->advance(stop - collisions(), *listeners.monitor);
    if (halt == Halt::needs_images)
      change_engine(observer);
    else if (halt == Halt::time && histograms <= stage_.time) {
      if (!sample_histograms(*observer, histograms)) return listeners.monitor->why_interrupted();
    } else if (halt != Halt::window) {
      call_.box_full = halt == Halt::box_full;
      return reason_of(halt, *listeners.monitor);
    }
    if (halt == Halt::window && observer && observe(listeners)) return JAM_STOP_CANCELLED;
  }
  return JAM_STOP_NONE;
}

// Why a part came back, as the report has it; a stage that ends within a part has a pressure from what there is.
int32_t EventDrivenRun::end_of_part(int32_t reason) {
  // Collisions at contact, in which no time has passed, are no run.
  if (reason == JAM_STOP_COLLISIONS && !sums().time_has_passed() && sums().virial > 0.0) {
    ++frozen_;
    reason = JAM_STOP_STALLED;
  }
  if (reason == JAM_STOP_PACKING_FRACTION ||
      ((reason == JAM_STOP_COLLISIONS || reason == JAM_STOP_TIME) && std::isnan(pressure_))) {
    const PressureSums last = window_.whole + window_.of_part + engine_->sums.of_pressure;
    if (last.time_has_passed()) pressure_ = reduced_pressure(last);
    note_wall_pressure(last, window_.walls);
  }
  return reason;
}

int32_t EventDrivenRun::run_windows(const Listeners &listeners) {
  for (;;) {
    if (window_.part < parts()) {
      const int32_t reason = end_of_part(advance_part(listeners));
      if (reason != JAM_STOP_NONE) return reason;
      end_part();
    }  // else it continues from a checkpoint of the callback at the end of a window, which is made again
    bool stop = false;
    if (window_.part >= parts()) {
      if (window_.whole.time_has_passed()) pressure_ = reduced_pressure(window_.whole);
      note_wall_pressure(window_.whole, window_.walls);
      stop = listeners.monitor->report(progress());
      const int32_t end = reason_to_end();
      if (end != JAM_STOP_NONE) return end;
      window_.walls = wall_momentum();
      thermostat();
      slow_down();
      window_.part = 0;
      window_.steady = 1;
      window_.whole = PressureSums();
    }
    begin_part();
    if (stop) return JAM_STOP_CANCELLED;
  }
}

std::vector<double> EventDrivenRun::wall_momentum() const {
  std::vector<double> all = engine_->wall_momentum();
  for (size_t w = 0; w < before_.walls.size(); ++w) all[w] += before_.walls[w];
  return all;
}

// beta P V / N on each wall, from the momentum since `before` (empty: since the beginning) and the time of these sums.
void EventDrivenRun::note_wall_pressure(const PressureSums &time, const std::vector<double> &before) {
  if (!p_.container || !time.time_has_passed()) return;
  p_.wall_pressure = wall_momentum();
  const double degrees = p_.dim * (n_ - p_.container.momentum_kept());  // kT = sum m v^2 / degrees
  const double side = p_.cell.side();                                   // the unit of the engine
  for (size_t w = 0; w < p_.wall_pressure.size(); ++w) {
    const double momentum = p_.wall_pressure[w] - (before.empty() ? 0.0 : before[w]);
    const double height = p_.container.volume() / p_.container[static_cast<int>(w)].area() / side;
    p_.wall_pressure[w] = momentum * height * degrees / (n_ * time.kinetic_integral);
  }
}

int64_t EventDrivenRun::parts() const { return growing() ? WindowTuning::parts : 1; }

// Gaps are about sigma / p. Below some units of the coordinates they are noise.
double EventDrivenRun::finest_pressure() const {
  return engine_->mean_diameter() / (WindowTuning::units_of_gap * engine_->resolution());
}

// At the end of a window: the reason why the stage ends here, or JAM_STOP_NONE. Limits are checked in advance_part,
// which leaves a stage that can continue.
int32_t EventDrivenRun::reason_to_end() {
  if (!window_.whole.time_has_passed() && window_.whole.virial > 0.0)
    return ++frozen_ > WindowTuning::frozen ? JAM_STOP_STALLED : JAM_STOP_NONE;
  if (growing() && window_.steady && pressure_ >= stage_.pressure) return JAM_STOP_PRESSURE;
  if (pressure_ > 1.0 && pressure_ > finest_pressure()) {
    if (growing()) return JAM_STOP_PRECISION;
    ++frozen_;
    return JAM_STOP_STALLED;
  }
  return JAM_STOP_NONE;
}

// Scales velocities to kT/m = 1 when growth has heated the spheres. When they grow faster than they fly, it waits until
// they have grown by a per cent or collided many times: cooling at every window would let no time pass.
void EventDrivenRun::thermostat() {
  using Tuning = ThermostatTuning;
  if (!growing() || std::fabs(engine_->twice_kinetic() / (n_ * p_.dim) - 1.0) < Tuning::heat) return;
  if (growth_ > Tuning::fast && (time() - cooling_.time) * growth_ < Tuning::grown * engine_->mean_diameter() &&
      collisions() - cooling_.collisions < static_cast<int64_t>(Tuning::collisions * n_))
    return;
  cooling_.time = time();
  cooling_.collisions = collisions();
  engine_->thermalise();
}

// The quasi-static mode: G = growth (p / p_0)^-a from the first window on, with a such that G = growth_end at the
// target.
void EventDrivenRun::slow_down() {
  if (!(pressure_ > 1.0)) return;
  if (first_pressure_ == 0.0) first_pressure_ = pressure_;
  if (!(stage_.growth_end > 0.0)) return;
  if (stage_.pressure <= first_pressure_) return;
  const double part = std::min(
      1.0, std::max(0.0, math::log(pressure_ / first_pressure_) / math::log(stage_.pressure / first_pressure_)));
  double wanted = stage_.growth * math::pow(stage_.growth_end / stage_.growth, part);
  if (stage_.relative) wanted *= engine_->mean_diameter() * math::pow(n_, 1.0 / p_.dim);
  if (std::fabs(wanted / engine_->growth() - 1.0) < WindowTuning::growth_noise) return;
  growth_ = wanted;
  engine_->set_growth(wanted);
  plan_window();
}

void EventDrivenRun::change_engine(Observer *observer) {
  const CallScope quiet(CallScope::memory_limit());  // a callback would store sums of the new engine beside the old one
  if (observer) engine_->observe(nullptr);
  engine_->write_state(p_);
  before_.collisions += engine_->sums.collisions;
  before_.events += engine_->sums.events;
  before_.time += engine_->elapsed();
  before_.sums = sums();
  before_.walls = wall_momentum();
  window_.of_part = part_sums();
  before_.worst_overlap = std::max(before_.worst_overlap, engine_->max_overlap);
  if (from_archive_) refuse_overlaps(p_, overlap_of_rounding);  // as at the end of a run
  EngineOptions o = options();
  o.growth = engine_->growth();
  engine_ = make_engine(p_, o);
  engine_->set_time_limit(stage_.time - before_.time);
  if (observer) engine_->observe(observer);
}

}  // namespace jam::inside
