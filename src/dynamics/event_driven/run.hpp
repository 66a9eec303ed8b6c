// One stage of molecular dynamics: windows of pressure, thermostat, limits, report. It can stop between any two events
// and go on to the same bits, in this process or another. So every value that a decision uses is in archive().
#pragma once
#include <string>

#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/options.hpp"
#include "dynamics/observer.hpp"

namespace jam {

// Sum of m v^2 about the centre of mass.
double twice_kinetic(const Packing &p);

class Stage final : public Dynamics {
 public:
  Stage(Packing p, const MdStage &stage);  // the engine is made by the first run, which may be stopped meanwhile
  Stage(Packing p, Archive &from);

  int32_t phase() const override { return growing() ? JAM_PHASE_COMPRESS : JAM_PHASE_RUN; }
  jam_status run(const Limits &limits, const Listeners &listeners) override;
  const Packing &packing() const override { return p_; }
  Packing current() const override;
  const MdStage &plan() const { return stage_; }
  void archive(Archive &a) override;
  bool begun() const { return engine_ != nullptr; }
  // Why the last run ended before its aim, in a sentence; empty where it did not.
  std::string text() const;
  // Each run adds to it, so that stages that follow each other give one report. Not part of the archive.
  jam_md_report report{};

 private:
  bool growing() const { return stage_.growth > 0.0; }
  void take_limits(const Limits &limits);
  EngineOptions options() const;
  int32_t begin(Monitor &monitor);
  int32_t go_on(const Listeners &listeners, double wall_end);
  int32_t advance_part(const Listeners &listeners, double wall_end);
  void begin_part();
  void end_part();
  void plan_window();
  int32_t judge();
  double finest_pressure() const;
  void thermostat();
  void slow_down();
  void change_engine(Observer *observer);

  void attach(Observer *observer);
  void detach(Observer *observer);
  void update(Observer &observer) const;
  bool observe(const Listeners &listeners);
  void sample(Observer &observer) const;
  double until_histograms(const Observer *observer) const;  // as time() will be then
  bool sample_histograms(Observer &observer, double at) const;
  double fraction() const;
  jam_progress progress() const;

  void finish(int32_t reason);
  double standard_error() const;
  jam_status status_of(int32_t reason) const;
  int64_t collisions() const { return old_collisions_ + engine_->sums.collisions; }
  int64_t events() const { return old_events_ + engine_->sums.events; }
  double time() const { return old_time_ + engine_->elapsed(); }
  // Sums of virial and kinetic_integral over the stage.
  double virial() const { return old_virial_ + engine_->sums.virial; }
  double kinetic_integral() const { return old_kinetic_integral_ + engine_->sums.kinetic_integral; }

  Packing p_;
  MdStage stage_;
  double n_;
  std::unique_ptr<EngineBase> engine_;
  double goal_ = 0.0, kinetic_ = 0.0, pressure_ = std::numeric_limits<double>::quiet_NaN();
  int64_t window_ = 1;

  // the current window: its parts, each with its own pressure
  int64_t part_ = 0, part_goal_ = 0;
  double part_virial_ = 0.0, part_kinetic_integral_ = 0.0, window_virial_ = 0.0, window_kinetic_integral_ = 0.0;
  int64_t steady_ = 1;           // no part of the window is far below the target pressure
  std::vector<double> windows_;  // pressures of parts

  // sums before this part; part_... above: of this part before an engine with images took over
  double old_virial_ = 0.0, old_kinetic_integral_ = 0.0, old_time_ = 0.0, worst_ = 0.0;
  int64_t old_collisions_ = 0, old_events_ = 0;

  double cooled_ = 0.0, first_pressure_ = 0.0, growth_ = 0.0;
  int64_t cooled_collisions_ = 0, frozen_ = 0;

  // of this call, not in the archive
  bool box_full_ = false;
  double block_virial_ = 0.0, block_kinetic_integral_ = 0.0, seen_time_ = 0.0;
  int64_t seen_collisions_ = 0, call_collisions_ = 0, report_collisions_ = 0;
};

}  // namespace jam
