// Header section "molecular dynamics": running, checkpoints, closed forms.
#include <cmath>
#include <utility>

#include "capi/make_system.hpp"
#include "core/create.hpp"
#include "core/math.hpp"
#include "core/size_laws.hpp"
#include "dynamics/event_driven/run.hpp"
#include "io/files.hpp"

using namespace jam::inside;

namespace {

// While a stage runs, callbacks may read it: jam_write_checkpoint saves its state between two events. Snapshots appear
// in the views, and then the handle has no results. If the call fails later, it gets its earlier state back.
class VisibleRun {
 public:
  VisibleRun(jam_system *sys, const Dynamics *stage, bool shows) : sys_(sys) {
    if (shows) {
      before_ = std::make_unique<Packing>(sys->packing);
      std::swap(results_, sys->results());
    }
    sys->live = stage;
  }
  ~VisibleRun() {
    sys_->live = nullptr;
    if (!before_) return;
    sys_->show(*before_);
    std::swap(results_, sys_->results());
  }
  VisibleRun(const VisibleRun &) = delete;
  VisibleRun &operator=(const VisibleRun &) = delete;

 private:
  jam_system *sys_;
  std::unique_ptr<Packing> before_;
  Results results_;
};

// Runs a stage; the handle changes only when nothing is thrown. The handle keeps a stage that was stopped early, also
// before it has begun: then nothing has moved.
Answer run_md(jam_system *sys, std::unique_ptr<EventDrivenRun> &stage, const Limits &limits, jam_md_report &report) {
  Listeners listeners;
  listeners.monitor = &sys->monitor;
  if (sys->observing) listeners.observer = sys->observer.get();
  const bool shows = listeners.observer && listeners.observer->has_snapshots();
  if (shows) listeners.on_snapshot = [sys](const Packing &p) { sys->show(p); };
  jam_status status = JAM_OK;
  {
    const VisibleRun live(sys, stage.get(), shows);
    stage->report = report;
    status = stage->run(limits, listeners);
    report = stage->report;
  }
  std::string text = stage->text();
  if (stage->begun()) {
    check_packing(stage->packing(), JAM_E_STATE);  // a stage from a file may lead anywhere
    sys->commit_measured(stage->packing());
  } else {
    sys->crunch_paused.reset();  // a handle keeps only the last paused run
  }
  if (status == JAM_CANCELLED || status == JAM_LIMIT) sys->paused = std::move(stage);
  return text.empty() ? stopped(status, report.stop_reason) : Answer(status, std::move(text));
}

std::unique_ptr<EventDrivenRun> make_stage(jam_system *sys, const GrowthStage &stage) {
  return std::make_unique<EventDrivenRun>(sys->packing, stage);
}

// The stage that the handle keeps, or a new one.
template <class Options>
std::unique_ptr<EventDrivenRun> take_stage(jam_system *sys, const Options &o, const GrowthStage &stage) {
  if (!o.resume) return make_stage(sys, stage);
  if (!sys->paused) fail(JAM_E_STATE, "resume is 1 but no stage was stopped early on this handle");
  const int32_t phase = stage.growth > 0.0 ? JAM_PHASE_COMPRESS : JAM_PHASE_RUN, paused = sys->paused->phase();
  if (paused != phase)
    fail(JAM_E_STATE, "resume is 1 but the paused stage has jam_phase %d, this call resumes %d", paused, phase);
  // The phase says that it is a EventDrivenRun.
  check_resumed(o, static_cast<const EventDrivenRun &>(*sys->paused).plan());
  // A failure from here on loses the stage, not the packing.
  return std::unique_ptr<EventDrivenRun>(static_cast<EventDrivenRun *>(sys->paused.release()));
}

// Of a stage's time and that of the one which follows: growth takes (N / G) ln p collisions. None follows where the
// packing fraction that is wanted comes before the stage's pressure: p = d / (1 - phi / phi_J) near jamming.
double part_of_protocol(const GrowthStage &stage, const Packing &p) {
  if (stage.then == 0.0) return 1.0;
  if (stage.packing_fraction < no_limit &&
      stage.packing_fraction < jammed_reach(p.dim, p.diameter).fraction * (1.0 - p.dim / stage.pressure))
    return 1.0;
  const GrowthStage next = next_stage(stage);
  const double own = math::log(stage.pressure) / stage.growth;
  return own / (own + math::log(next.pressure / stage.pressure) / next.growth);
}

// Runs a stage and those that follow it in its protocol.
Answer run_all(jam_system *sys, std::unique_ptr<EventDrivenRun> stage, Limits limits, jam_md_report &report,
               bool &moved) {
  const double wall_time = limits.wall_time;
  double part = 0.0;
  for (;;) {
    const GrowthStage plan = stage->plan();
    const double first = part;
    part += (1.0 - part) * part_of_protocol(plan, sys->packing);
    sys->monitor.span(first, part);
    limits.wall_time = wall_time - sys->monitor.seconds();
    const Answer answer = run_md(sys, stage, limits, report);
    moved = true;
    if (answer.status != JAM_OK || report.stop_reason != JAM_STOP_PRESSURE || plan.then == 0.0) return answer;
    stage = make_stage(sys, next_stage(plan));
  }
}

// The same, and one call is one change: after a failure packing and observations are those of before.
Answer run_stages(jam_system *sys, std::unique_ptr<EventDrivenRun> stage, const Limits &limits, jam_md_report &report) {
  std::unique_ptr<Packing> before;
  Results results;
  if (stage->plan().then > 0.0) before = std::make_unique<Packing>(sys->packing), results = sys->results();
  bool moved = false;
  Observations observations(sys);
  try {
    const Answer answer = run_all(sys, std::move(stage), limits, report, moved);
    observations.keep();
    return answer;
  } catch (...) {
    if (before && moved) sys->commit_measured(*before, std::move(results));
    throw;
  }
}

// A fluid that is to grow to a density alone must be able to reach it in disorder. Crystals, and growth that may end
// earlier by another target, go as far as they go.
void check_aim(const jam_system *, const jam_run_options &) {}
void check_aim(const jam_system *sys, const jam_compress_options &o) {
  const Packing &p = sys->packing;
  const bool density_alone = std::isfinite(o.packing_fraction) && o.pressure >= default_compress_options().pressure &&
                             std::isinf(o.collisions_per_particle) && std::isinf(o.time);
  if (o.resume || !density_alone || p.model == JAM_MODEL_MK || p.non_additivity != 0.0) return;
  if (sys->packing_fraction < sequential_fraction(p.dim)) check_reach(p.dim, p.diameter, o.packing_fraction);
}

template <class Options, class Check>
Answer verb(jam_system *sys, const Options *o, Options full, Check &&check, jam_md_report *report) {
  take_options(o, full);
  check(full);
  check_aim(sys, full);
  const GrowthStage stage = stage_of(full);
  jam_md_report made{};
  const Answer answer = run_stages(sys, take_stage(sys, full, stage), stage.limits(), made);
  if (made.packing_fraction == 0.0) {  // no stage has begun
    const jam_md_report bare = made;
    set_blank(*sys, made);
    made.stop_reason = bare.stop_reason, made.seconds = bare.seconds;
  }
  give_struct(made, report);
  return answer;
}

}  // namespace

extern "C" {

jam_status jam_run_options_init(jam_run_options *o, size_t size) {
  return init_options(o, size, default_run_options());
}
jam_status jam_compress_options_init(jam_compress_options *o, size_t size) {
  return init_options(o, size, default_compress_options());
}

jam_status jam_run(jam_system *sys, const jam_run_options *o, jam_md_report *report) {
  return guard_reporting(sys, report, [&] { return verb(sys, o, default_run_options(), check_run_options, report); });
}

jam_status jam_compress(jam_system *sys, const jam_compress_options *o, jam_md_report *report) {
  return guard_reporting(sys, report,
                         [&] { return verb(sys, o, default_compress_options(), check_compress_options, report); });
}

jam_status jam_write_checkpoint(const jam_system *sys, const char *path) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    Moving moving;
    if (sys->live != sys->runs.get()) moving.dynamics = sys->live;  // the runs from one configuration do not move it
    if (sys->crunching) moving.crunch = &sys->crunching->stage;
    const Packing now = sys->crunching    ? sys->crunching->reached()
                        : moving.dynamics ? moving.dynamics->current()
                                          : sys->packing;
    write_checkpoint(now, archive_beside(*sys, moving, now), path);
    return JAM_OK;
  });
}

jam_status jam_read_checkpoint(const char *path, jam_progress_fn callback, void *user, jam_system **out) {
  return guard([&]() -> Answer {
    need(path, "path");
    need(out, "out");
    return make_system(default_create_options(), callback, user, out, [&](jam_system &sys) {
      std::string beside;
      sys.packing = read_checkpoint(path, beside);
      apply_overlap_policy(sys.packing, sys.packing.overlap_allowed ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
      read_beside(sys, std::move(beside));
    });
  });
}

}  // extern "C"
