#include "dynamics/event_driven/run.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "core/math.hpp"
#include "core/rng.hpp"
#include "dynamics/pressure.hpp"

namespace jam {

double twice_kinetic(const Packing &p) {
  std::vector<double> mass = sphere_masses(p);
  if (mass.empty()) mass.assign(p.n(), 1.0);
  const size_t d = static_cast<size_t>(p.dim);
  double sum = 0.0, drift = 0.0;
  for (size_t k = 0; k < p.velocity.size(); ++k) sum += mass[k / d] * p.velocity[k] * p.velocity[k];
  for (size_t c = 0; c < d && p.n() > 1; ++c) {
    double momentum = 0.0;
    for (size_t i = 0; i < p.n(); ++i) momentum += mass[i] * p.velocity[i * d + c];
    drift += momentum * momentum / static_cast<double>(p.n());  // masses have mean 1
  }
  return sum - drift;
}

namespace {

void scale_velocities(Packing &p) {
  const double factor = std::sqrt(static_cast<double>(p.velocity.size()) / twice_kinetic(p));
  for (double &v : p.velocity) v *= factor;
}

// Maxwell-Boltzmann with zero total momentum and exactly kT/m = 1, m the mean mass.
void draw_velocities(Packing &p) {
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  std::vector<double> mass = sphere_masses(p);
  if (mass.empty()) mass.assign(n, 1.0);
  Rng rng(p.seed, Stream::velocities);
  for (size_t k = 0; k < n * d; ++k) p.velocity[k] = rng.normal() / std::sqrt(mass[k / d]);
  if (n > 1)
    for (size_t c = 0; c < d; ++c) {
      double mean = 0.0;
      for (size_t i = 0; i < n; ++i) mean += mass[i] * p.velocity[i * d + c];
      mean /= static_cast<double>(n);
      for (size_t i = 0; i < n; ++i) p.velocity[i * d + c] -= mean;
    }
  scale_velocities(p);
  p.has_velocity = true;
}

int32_t reason_of(Halt halt) {
  switch (halt) {
    case Halt::packing_fraction:
      return JAM_STOP_PACKING_FRACTION;
    case Halt::cancelled:
      return JAM_STOP_CANCELLED;
    case Halt::wall_time:
      return JAM_STOP_WALL_TIME;
    case Halt::time:
      return JAM_STOP_TIME;
    default:
      return JAM_STOP_STALLED;
  }
}

}  // namespace

Stage::Stage(Packing p, const MdStage &stage) : p_(std::move(p)), stage_(stage), n_(static_cast<double>(p_.n())) {
  growth_ = stage_.growth;
  if (stage_.relative) growth_ *= diameter_mean(p_) / p_.cell.side() * math::pow(n_, 1.0 / p_.dim);
  take_limits(stage.limits());
}

// Searches for overlaps and makes the engine. A reason to stop: the next run begins anew.
int32_t Stage::begin(Monitor &monitor) {
  if (engine_) return JAM_STOP_NONE;
  const bool drawn = !p_.has_velocity || (growing() && !(twice_kinetic(p_) > 0.0));
  if (drawn) draw_velocities(p_);
  // Velocities that a compression has scaled at its end stay as they are.
  const bool scaled = std::fabs(twice_kinetic(p_) / (n_ * p_.dim) - 1.0) < 1e-12;
  if (growing() && (drawn || !scaled)) scale_velocities(p_);
  jam_progress q = progress_of(phase());
  q.packing_fraction = packing_fraction(p_);
  monitor.expect(q);
  const LeavingScope scope;
  try {
    if (p_.overlap_allowed) refuse_overlaps(p_, 1e-10);
    engine_ = make_engine(p_, options());
  } catch (const Cancelled &) {
    return monitor.cancelled() ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME;
  }
  if (engine_->max_overlap > 1e-10)
    fail(JAM_E_OVERLAP, "spheres overlap by %g of sigma at the start of molecular dynamics", engine_->max_overlap);
  kinetic_ = engine_->twice_kinetic();
  plan_window();
  begin_part();
  return JAM_STOP_NONE;
}

Stage::Stage(Packing p, Archive &from) : p_(std::move(p)), n_(static_cast<double>(p_.n())) { archive(from); }

void Stage::archive(Archive &a) {
  a(stage_);
  for (double *x : {&goal_, &kinetic_, &pressure_, &part_virial_, &part_kinetic_integral_, &window_virial_,
                    &window_kinetic_integral_, &old_virial_, &old_kinetic_integral_, &old_time_, &worst_, &cooled_,
                    &first_pressure_, &growth_})
    a(*x);
  for (int64_t *k :
       {&window_, &part_, &part_goal_, &steady_, &old_collisions_, &old_events_, &cooled_collisions_, &frozen_})
    a(*k);
  a(windows_);
  if (a.reading()) {
    Archive::check(stage_.then == 0.0 || stage_.then > 1.0);
    Archive::check(stage_.growth >= 0.0 && window_ > 0 && part_ >= 0 && windows_.size() < 1u << 20);
    for (const int64_t k :
         {window_, part_, part_goal_, steady_, old_collisions_, old_events_, cooled_collisions_, frozen_})
      Archive::check(k > -(int64_t{1} << 60) && k < int64_t{1} << 60);  // sums and differences are taken of them
    engine_ = make_engine(p_, a);
  } else {
    int64_t images = engine_ ? engine_->with_images() : not_begun;
    a(images);
    if (engine_) engine_->archive(a);
  }
}

void Stage::take_limits(const Limits &limits) {
  stage_.collisions_per_particle = limits.per_particle;
  stage_.time = limits.time;
  goal_ = stage_.collisions_per_particle * n_ / 2.0;  // each collision is one for two spheres
}

EngineOptions Stage::options() const {
  EngineOptions o;
  o.growth = growth_;
  o.relative = stage_.relative;
  if (growing()) o.target_fraction = stage_.packing_fraction;
  return o;
}

// ---- windows

// A window is long enough for small noise and short enough that p changes little: d ln p = G / 1.63 a collision.
void Stage::plan_window() {
  const double most =
      growing() ? std::min(2.0, std::max(0.25, 0.03 / growth_)) * n_ : std::min(goal_ / 20.0, 20.0 * n_);
  window_ = static_cast<int64_t>(std::max(growing() ? 32.0 : 4.0, most));
}

void Stage::begin_part() {
  part_goal_ = collisions() + std::max<int64_t>(1, window_ / (growing() ? 4 : 1));
  // Sums start from zero: at p = 1e14 the sum over the stage would lose what a part adds.
  old_virial_ += engine_->sums.virial;
  old_kinetic_integral_ += engine_->sums.kinetic_integral;
  engine_->sums.virial = engine_->sums.kinetic_integral = part_virial_ = part_kinetic_integral_ = 0.0;
}

void Stage::end_part() {
  const double v = part_virial_ + engine_->sums.virial, a = part_kinetic_integral_ + engine_->sums.kinetic_integral;
  steady_ = steady_ && a > 0.0 && reduced_pressure(v, a, n_) > 0.25 * stage_.pressure;
  if (a > 0.0) {
    windows_.push_back(reduced_pressure(v, a, n_));
    if (growing() && windows_.size() > 16) windows_.erase(windows_.begin());
  }
  window_virial_ += v;
  window_kinetic_integral_ += a;
  ++part_;
}

// Runs to the end of the part or of the stage, or to a limit. JAM_STOP_NONE: the part has ended.
int32_t Stage::advance_part(const Listeners &listeners, double wall_end) {
  const double most = std::min(goal_, 9e18);
  while (collisions() < part_goal_) {
    if (static_cast<double>(collisions()) >= most) return JAM_STOP_COLLISIONS;
    int64_t stop = std::min(part_goal_, static_cast<int64_t>(std::ceil(most)));
    Observer *observer = listeners.observer;
    if (observer && observer->next_stop() < std::numeric_limits<int64_t>::max())
      stop = std::min(stop, std::max(collisions() + 1, observer->next_stop() - observer->seen + seen_collisions_));
    const double histograms = until_histograms(observer);
    if (observer) engine_->set_time_limit(std::min(stage_.time, histograms) - time());
    const Halt halt = engine_->advance(stop - collisions(), *listeners.monitor, wall_end);
    if (halt == Halt::needs_images)
      change_engine(observer);
    else if (halt == Halt::time && histograms <= stage_.time) {
      if (!sample_histograms(*observer, histograms))
        return listeners.monitor->cancelled() ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME;
    } else if (halt != Halt::window) {
      box_full_ = halt == Halt::box_full;
      return reason_of(halt);
    }
    if (halt == Halt::window && observer && observe(listeners)) return JAM_STOP_CANCELLED;
  }
  return JAM_STOP_NONE;
}

int32_t Stage::go_on(const Listeners &listeners, double wall_end) {
  for (;;) {
    int32_t reason = advance_part(listeners, wall_end);
    // Collisions at contact, in which no time has passed, are no run.
    if (reason == JAM_STOP_COLLISIONS && !(kinetic_integral() > 0.0) && virial() > 0.0) {
      ++frozen_;
      reason = JAM_STOP_STALLED;
    }
    if (reason == JAM_STOP_PACKING_FRACTION || (reason == JAM_STOP_COLLISIONS && std::isnan(pressure_))) {
      const double v = window_virial_ + part_virial_ + engine_->sums.virial,
                   a = window_kinetic_integral_ + part_kinetic_integral_ + engine_->sums.kinetic_integral;
      if (a > 0.0) pressure_ = reduced_pressure(v, a, n_);
    }
    if (reason != JAM_STOP_NONE) return reason;
    end_part();
    const bool whole = part_ == (growing() ? 4 : 1);
    bool stop = false;
    if (whole) {
      if (window_kinetic_integral_ > 0.0) pressure_ = reduced_pressure(window_virial_, window_kinetic_integral_, n_);
      stop = listeners.monitor->report(progress());
      const int32_t end = judge();
      if (end != JAM_STOP_NONE) return end;
      thermostat();
      slow_down();
      part_ = 0;
      steady_ = 1;
      window_virial_ = window_kinetic_integral_ = 0.0;
    }
    begin_part();
    if (stop) return JAM_STOP_CANCELLED;
  }
}

// Gaps are about sigma / p. Below 40 units of the coordinates they are noise.
double Stage::finest_pressure() const { return engine_->mean_diameter() / (40.0 * engine_->resolution()); }

// At the end of a window: the reason why the stage ends here, or JAM_STOP_NONE. Limits are checked in advance_part,
// which leaves a stage that can go on.
int32_t Stage::judge() {
  if (window_kinetic_integral_ <= 0.0 && window_virial_ > 0.0) return ++frozen_ > 20 ? JAM_STOP_STALLED : JAM_STOP_NONE;
  if (growing() && steady_ && pressure_ >= stage_.pressure) return JAM_STOP_PRESSURE;
  if (pressure_ > 1.0 && pressure_ > finest_pressure()) {
    if (growing()) return JAM_STOP_PRECISION;
    ++frozen_;
    return JAM_STOP_STALLED;
  }
  return JAM_STOP_NONE;
}

// Scales velocities to kT/m = 1 when growth has heated the spheres by 5 %. When they grow faster than they fly, it
// waits until they have grown by a per cent or collided many times: cooling at every window would let no time pass.
void Stage::thermostat() {
  if (!growing() || std::fabs(engine_->twice_kinetic() / (n_ * p_.dim) - 1.0) < 0.05) return;
  if (growth_ > 0.5 && (time() - cooled_) * growth_ < 0.01 * engine_->mean_diameter() &&
      collisions() - cooled_collisions_ < static_cast<int64_t>(50.0 * n_))
    return;
  cooled_ = time();
  cooled_collisions_ = collisions();
  engine_->thermalise();
}

// The quasi-static mode: G = growth (p / p_0)^-a from the first window on, with a such that G = growth_end at the
// target.
void Stage::slow_down() {
  if (!(pressure_ > 1.0)) return;
  if (first_pressure_ == 0.0) first_pressure_ = pressure_;
  if (!(stage_.growth_end > 0.0)) return;
  if (stage_.pressure <= first_pressure_) return;
  const double part = std::min(
      1.0, std::max(0.0, math::log(pressure_ / first_pressure_) / math::log(stage_.pressure / first_pressure_)));
  double wanted = stage_.growth * math::pow(stage_.growth_end / stage_.growth, part);
  if (stage_.relative) wanted *= engine_->mean_diameter() * math::pow(n_, 1.0 / p_.dim);
  if (std::fabs(wanted / engine_->growth() - 1.0) < 0.02) return;  // a change by noise alone
  growth_ = wanted;
  engine_->set_growth(wanted);
  plan_window();
}

void Stage::change_engine(Observer *observer) {
  if (observer) engine_->observe(nullptr);
  engine_->write_state(p_);
  old_collisions_ += engine_->sums.collisions;
  old_events_ += engine_->sums.events;
  old_time_ += engine_->elapsed();
  old_virial_ += engine_->sums.virial;
  old_kinetic_integral_ += engine_->sums.kinetic_integral;
  part_virial_ += engine_->sums.virial;
  part_kinetic_integral_ += engine_->sums.kinetic_integral;
  worst_ = std::max(worst_, engine_->max_overlap);
  EngineOptions o = options();
  o.growth = engine_->growth();
  engine_ = make_engine(p_, o);
  engine_->set_time_limit(stage_.time - old_time_);
  if (observer) engine_->observe(observer);
}

// ---- the stage as a whole

Packing Stage::current() const {
  Packing p = p_;
  if (!engine_) return p;
  engine_->write_state(p);
  p.pressure = pressure_;
  return p;
}

jam_status Stage::run(const Limits &limits, const Listeners &listeners) {
  const double started = now_seconds(), wall_end = started + limits.wall_time;
  listeners.monitor->wall_time = listeners.monitor->seconds() + limits.wall_time;  // for searches for pairs
  if (const int32_t stopped = begin(*listeners.monitor); stopped != JAM_STOP_NONE) {
    report.stop_reason = stopped;
    return status_of(stopped);
  }
  const double begin_time = time();
  const int64_t begin_events = events();
  call_collisions_ = collisions();
  report_collisions_ = report.collisions;
  take_limits(limits);
  listeners.monitor->expect(progress());
  engine_->set_time_limit(stage_.time - time());
  attach(listeners.observer);
  const bool there = growing() && engine_->packing_fraction() >= stage_.packing_fraction;
  int32_t reason = JAM_STOP_PACKING_FRACTION;
  if (!there) reason = time() >= stage_.time ? JAM_STOP_TIME : go_on(listeners, wall_end);
  detach(listeners.observer);
  p_ = current();
  if (growing() && twice_kinetic(p_) > 0.0) scale_velocities(p_);  // a run that follows starts at kT/m = 1
  if (!growing() && kinetic_integral() > 0.0) p_.pressure = reduced_pressure(virial(), kinetic_integral(), n_);
  report.collisions += collisions() - call_collisions_;
  report.events += events() - begin_events;
  report.time += time() - begin_time;
  report.seconds += now_seconds() - started;
  finish(reason);
  return status_of(reason);
}

jam_status run_stage(Packing &p, const MdStage &stage, Monitor &monitor, jam_md_report &report) {
  Listeners listeners;
  listeners.monitor = &monitor;
  Stage made(p, stage);
  made.report = report;
  const jam_status status = made.run(stage.limits(), listeners);
  p = made.packing();
  report = made.report;
  return status;
}

}  // namespace jam
