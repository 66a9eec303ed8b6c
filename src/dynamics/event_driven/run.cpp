#include "dynamics/event_driven/run.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "core/math.hpp"
#include "dynamics/event_driven/velocities.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

EventDrivenRun::EventDrivenRun(Packing p, const GrowthStage &stage)
    : p_(std::move(p)), stage_(stage), n_(static_cast<double>(p_.n())) {
  growth_ = stage_.growth;
  if (stage_.relative) growth_ *= diameter_mean(p_) / p_.cell.side() * math::pow(n_, 1.0 / p_.dim);
  take_limits(stage.limits());
}

// Searches for overlaps and makes the engine. A reason to stop: the next run starts again.
int32_t EventDrivenRun::begin(Monitor &monitor) {
  if (engine_) return JAM_STOP_NONE;
  drawn_ = !p_.has_velocity || (growing() && !(twice_kinetic(p_) > 0.0));
  if (drawn_) {
    Rng rng(p_.seed, Stream::velocities);
    draw_velocities(p_, rng);
    scale_velocities(p_);
  }
  // Velocities that a compression has scaled at its end stay as they are.
  const bool scaled = std::fabs(twice_kinetic(p_) / (n_ * p_.dim) - 1.0) < 1e-12;
  if (growing() && (drawn_ || !scaled)) scale_velocities(p_);
  jam_progress q = progress_of(phase());
  q.packing_fraction = packing_fraction(p_);
  monitor.expect(q);
  const CancellableScope scope;
  try {
    if (p_.overlap_allowed) refuse_overlaps(p_, overlap_of_rounding);
    engine_ = make_engine(p_, options());
  } catch (const Cancelled &) {
    return monitor.why_interrupted();
  }
  if (engine_->max_overlap > std::max(overlap_of_rounding, overlap_of_long_flights(p_)))
    fail(JAM_E_OVERLAP, "spheres overlap by %g of sigma at the start of molecular dynamics", engine_->max_overlap);
  kinetic_ = engine_->twice_kinetic();
  plan_window();
  begin_part();
  return JAM_STOP_NONE;
}

EventDrivenRun::EventDrivenRun(Packing p, Archive &from)
    : p_(std::move(p)), n_(static_cast<double>(p_.n())), from_archive_(true) {
  archive(from);
}

void EventDrivenRun::archive(Archive &a) {
  a(stage_);
  for (double *x : {&goal_, &kinetic_, &pressure_}) a(*x);
  for (PressureSums *s : {&window_.of_part, &window_.whole, &before_.sums}) a(*s);
  for (double *x : {&before_.time, &before_.worst_overlap, &cooling_.time, &first_pressure_, &growth_}) a(*x);
  for (int64_t *k : {&window_.length, &window_.part, &window_.part_goal, &window_.steady, &before_.collisions,
                     &before_.events, &cooling_.collisions, &frozen_})
    a(*k);
  a(window_.pressures);
  for (std::vector<double> *walls : {&window_.walls, &before_.walls})
    if (p_.container) {
      a(*walls);
      Archive::check(walls->empty() || walls->size() == static_cast<size_t>(p_.container.count()));
    }
  if (a.reading()) {
    Archive::check(stage_.then == 0.0 || stage_.then > 1.0);
    Archive::check(stage_.growth >= 0.0 && window_.length > 0 && window_.part >= 0 &&
                   window_.pressures.size() < 1u << 20);
    for (const int64_t k : {window_.length, window_.part, window_.part_goal, window_.steady, before_.collisions,
                            before_.events, cooling_.collisions, frozen_})
      Archive::check(k > -(int64_t{1} << 60) && k < int64_t{1} << 60);  // sums and differences are taken of them
    engine_ = make_engine(p_, a);
  } else {
    int64_t images = engine_ ? engine_->with_images() : not_begun;
    a(images);
    if (engine_) engine_->archive(a);
  }
}

void EventDrivenRun::take_limits(const Limits &limits) {
  stage_.collisions_per_particle = limits.per_particle;
  stage_.time = limits.time;
  goal_ = stage_.collisions_per_particle * n_ / 2.0;  // each collision is one for two spheres
}

EngineOptions EventDrivenRun::options() const {
  EngineOptions o;
  o.growth = growth_;
  o.relative = stage_.relative;
  if (growing()) o.target_fraction = stage_.packing_fraction;
  return o;
}

Packing EventDrivenRun::current() const {
  Packing p = p_;
  if (!engine_) return p;
  engine_->write_state(p);
  p.pressure = pressure_;
  return p;
}

jam_status EventDrivenRun::run(const Limits &limits, const Listeners &listeners) {
  const double started = now_seconds();
  listeners.monitor->limit_time(limits.wall_time);
  if (const int32_t stopped = begin(*listeners.monitor); stopped != JAM_STOP_NONE) {
    report.stop_reason = stopped;
    return status_of(stopped);
  }
  const double begin_time = time();
  const int64_t begin_events = events();
  call_.first_collisions = collisions();
  call_.report_collisions = report.collisions;
  take_limits(limits);
  listeners.monitor->expect(progress());
  engine_->set_time_limit(stage_.time - time());
  attach(listeners.observer);
  const bool there = growing() && engine_->packing_fraction() >= stage_.packing_fraction;
  int32_t reason = JAM_STOP_PACKING_FRACTION;
  if (!there) reason = time() >= stage_.time ? JAM_STOP_TIME : run_windows(listeners);
  detach(listeners.observer);
  p_ = current();
  if (from_archive_) refuse_overlaps(p_, overlap_of_rounding);  // times and places of the archive may have been changed
  if (growing() && twice_kinetic(p_) > 0.0) scale_velocities(p_);  // a run that follows starts at kT/m = 1
  if (!growing() && sums().time_has_passed()) {
    p_.pressure = reduced_pressure(sums());
    note_wall_pressure(sums(), {});
  }
  report.collisions += collisions() - call_.first_collisions;
  report.events += events() - begin_events;
  report.time += time() - begin_time;
  report.seconds += now_seconds() - started;
  finish(reason);
  return status_of(reason);
}

jam_status run_stage(Packing &p, const GrowthStage &stage, Monitor &monitor, jam_md_report &report) {
  Listeners listeners;
  listeners.monitor = &monitor;
  EventDrivenRun made(p, stage);
  made.report = report;
  const jam_status status = made.run(stage.limits(), listeners);
  p = made.packing();
  report = made.report;
  return status;
}

}  // namespace jam::inside
