#include "dynamics/event_driven/run.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/limits.hpp"
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
  // Velocities that a compression has scaled at its end stay as they are. So do those of a stage that was stopped here.
  const auto scaled = [this] { return std::fabs(twice_kinetic(p_) / (n_ * p_.dim) - 1.0) < 1e-12; };
  const bool draws = !p_.has_velocity || (growing() && !scaled() && !take_drift(p_));
  if (draws) {
    drawn_ = true;
    Rng rng(p_.seed, Stream::velocities);
    draw_velocities(p_, rng);
    scale_velocities(p_);
  }
  if (growing() && (draws || !scaled())) scale_velocities(p_);
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
  a(drawn_);
  a(window_.pressures);
  for (std::vector<double> *walls : {&window_.walls, &before_.walls})
    if (p_.container) {
      a(*walls);
      Archive::check(walls->empty() || walls->size() == static_cast<size_t>(p_.container.count()));
    }
  if (a.reading()) {
    Archive::check(stage_.then == 0.0 || stage_.then > 1.0);
    for (const double rate : {stage_.growth, stage_.growth_end})
      Archive::check(rate == 0.0 || (rate >= limits::growth_rate_min && rate <= limits::growth_rate_max));
    Archive::check(window_.length > 0 && window_.part >= 0 && window_.pressures.size() < WindowTuning::kept_windows);
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

// Options of event-driven molecular dynamics, and the stages that they request.
jam_run_options default_run_options() {
  jam_run_options o{};
  o.struct_size = sizeof o;
  o.collisions_per_particle = 100.0;
  o.wall_time = o.time = no_limit;
  return o;
}

jam_compress_options default_compress_options() {
  jam_compress_options o{};
  o.struct_size = sizeof o;
  o.pressure = 1e6;
  o.packing_fraction = o.collisions_per_particle = o.wall_time = o.time = no_limit;
  return o;
}

void check_run_options(const jam_run_options &o) {
  check_flag(o.resume, "resume");
  check_positive(o.collisions_per_particle, "collisions_per_particle");
  check_positive(o.wall_time, "wall_time");
  check_positive(o.time, "time");
  if (o.collisions_per_particle == no_limit && o.wall_time == no_limit && o.time == no_limit)
    fail(JAM_E_ARGUMENT, "collisions_per_particle, time and wall_time are all infinite: the run would not end");
}

void check_compress_options(const jam_compress_options &o) {
  check_flag(o.resume, "resume");
  for (const auto &[rate, name] : {std::pair(o.growth_rate, "growth_rate"), {o.growth_rate_end, "growth_rate_end"}})
    if (rate != 0.0) check_range(name, rate, limits::growth_rate_min, limits::growth_rate_max);
  if (!(o.pressure > 1.0)) fail(JAM_E_ARGUMENT, "pressure is %g, it must be greater than 1", o.pressure);
  check_positive(o.packing_fraction, "packing_fraction");
  check_positive(o.collisions_per_particle, "collisions_per_particle");
  check_positive(o.wall_time, "wall_time");
  check_positive(o.time, "time");
  if (o.growth_rate_end > o.growth_rate)
    fail(JAM_E_ARGUMENT, "growth_rate_end is %g, it must be 0 or at most growth_rate, which is %g", o.growth_rate_end,
         o.growth_rate);
  if (o.growth_rate_end > 0.0 && o.pressure == no_limit)
    fail(JAM_E_ARGUMENT, "growth_rate_end needs a finite pressure to be reached at");
  check_enum(o.growth_law, JAM_GROWTH_DIAMETER, JAM_GROWTH_DENSITY, "growth_law", "jam_growth_law");
}

GrowthStage stage_of(const jam_run_options &o) {
  GrowthStage s;
  s.collisions_per_particle = o.collisions_per_particle;
  s.wall_time = o.wall_time;
  s.time = o.time;
  return s;
}

GrowthStage stage_of(const jam_compress_options &o) {
  GrowthStage s{o.growth_rate, o.pressure, o.packing_fraction, o.collisions_per_particle, o.wall_time};
  if (o.growth_rate == 0.0) {
    s.growth = ProtocolTuning::first_rate;
    s.pressure = std::min(o.pressure, ProtocolTuning::first_pressure);
    s.then = o.pressure > ProtocolTuning::first_pressure ? o.pressure : 0.0;
  }
  s.time = o.time;
  s.growth_end = o.growth_rate_end;
  s.relative = o.growth_law == JAM_GROWTH_DENSITY;
  return s;
}

GrowthStage next_stage(const GrowthStage &stage) {
  GrowthStage next = stage;
  next.growth = ProtocolTuning::last_rate;
  next.pressure = stage.then;
  next.then = 0.0;
  return next;
}

void check_resumed(const jam_run_options &, const GrowthStage &) {}
void check_resumed(const jam_compress_options &o, const GrowthStage &stopped) {
  const jam_compress_options usual = default_compress_options();
  const auto look = [](const char *name, double given, double by_default, double own) {
    if (given != by_default && given != own)
      fail(JAM_E_ARGUMENT, "resume: %s is %g, but the stage that was stopped has %g", name, given, own);
  };
  look("growth_rate", o.growth_rate, usual.growth_rate, stopped.growth);
  look("growth_rate_end", o.growth_rate_end, usual.growth_rate_end, stopped.growth_end);
  look("growth_law", o.growth_law, usual.growth_law, static_cast<double>(stopped.relative));
  look("pressure", o.pressure, usual.pressure, stopped.then > 0.0 ? stopped.then : stopped.pressure);
  look("packing_fraction", o.packing_fraction, usual.packing_fraction, stopped.packing_fraction);
}

}  // namespace jam::inside
