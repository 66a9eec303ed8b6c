// One run of event-driven dynamics, at constant volume or growing: windows of pressure, thermostat, limits, report. It
// can stop between any two events and continue to the same bits, in this process or another. So every value that a
// decision uses is in archive().
#pragma once
#include "dynamics/dynamics.hpp"
#include "dynamics/event_driven/engine.hpp"

namespace jam::inside {

// Options of event-driven molecular dynamics, and one call that runs a stage from its beginning to its end.

// One stage: whichever target or limit comes first ends it. growth == 0 is NVE.
struct GrowthStage {
  double growth = 0.0;  // G = d<sigma>/dt / sqrt(kT/m), or with `relative` d ln<sigma>/dt in units of n^(1/d) / box
  double pressure = 0.0;
  double packing_fraction = 0.0;
  double collisions_per_particle = 0.0;  // from the beginning of the stage, also when it is resumed
  double wall_time = 0.0;                // seconds, of one call
  double time = no_limit;                // simulated, from the beginning of the stage
  double growth_end = 0.0;               // > 0: growth falls as a power of p, to this at the target pressure
  int64_t relative = 0;                  // 1: constant relative rate of growth
  double then = 0.0;                     // > 0: the protocol continues after this stage, up to this pressure
  Limits limits() const { return {collisions_per_particle, time, wall_time}; }
};

jam_run_options default_run_options();
jam_compress_options default_compress_options();
// Throw JAM_E_ARGUMENT naming the value.
void check_run_options(const jam_run_options &o);
void check_compress_options(const jam_compress_options &o);
GrowthStage stage_of(const jam_run_options &o);
GrowthStage stage_of(const jam_compress_options &o);  // the first one of the protocol without a growth rate
GrowthStage next_stage(const GrowthStage &stage);     // of the protocol: stage.then > 0
// Of a stage that was stopped: options beside limits are its own, or the defaults.
void check_resumed(const jam_run_options &o, const GrowthStage &stopped);
void check_resumed(const jam_compress_options &o, const GrowthStage &stopped);

// Begins a stage, runs it and takes its packing: for tests and benchmarks.
jam_status run_stage(Packing &p, const GrowthStage &stage, Monitor &monitor, jam_md_report &report);

// The current window and its parts, each with a pressure of its own.
struct PressureWindow {
  int64_t length = 1;  // collisions of a whole window
  int64_t part = 0, part_goal = 0;
  PressureSums of_part, whole;    // of this part before an engine with images took over; of the parts before it
  int64_t steady = 1;             // no part of the window is far below the target pressure
  std::vector<double> pressures;  // of parts; at constant volume of all windows, or of pairs of them and so on
  std::vector<double> walls;      // momentum that each wall had received before the window
};

// Sums and counts before this part (`sums`), and before the engine of now (the others).
struct BeforeEngine {
  PressureSums sums;
  double time = 0.0, worst_overlap = 0.0;
  std::vector<double> walls;  // momentum that each wall received
  int64_t collisions = 0, events = 0;
};

// When velocities were scaled last.
struct Cooling {
  double time = 0.0;
  int64_t collisions = 0;
};

// What was seen in this call; not in the archive.
struct ThisCall {
  bool box_full = false;
  PressureSums block;  // at the beginning of the observer's block
  double seen_time = 0.0;
  int64_t seen_collisions = 0, first_collisions = 0, report_collisions = 0;
};

class EventDrivenRun final : public Dynamics {
 public:
  EventDrivenRun(Packing p, const GrowthStage &stage);  // the engine is made by the first run(), which may be stopped
  EventDrivenRun(Packing p, Archive &from);

  int32_t phase() const override { return growing() ? JAM_PHASE_COMPRESS : JAM_PHASE_RUN; }
  jam_status run(const Limits &limits, const Listeners &listeners) override;
  const Packing &packing() const override { return p_; }
  Packing current() const override;
  const GrowthStage &plan() const { return stage_; }
  void archive(Archive &a) override;
  bool begun() const { return engine_ != nullptr; }
  // Why the last run ended before its aim, in a sentence; empty where it did not.
  std::string text() const;
  // Summed over run() calls, so that a protocol of several stages has one report. Not part of the archive.
  jam_md_report report{};

 private:
  bool growing() const { return stage_.growth > 0.0; }
  int64_t parts() const;  // of a window
  void take_limits(const Limits &limits);
  EngineOptions options() const;
  int32_t begin(Monitor &monitor);
  void finish(int32_t reason);
  double standard_error() const;
  jam_status status_of(int32_t reason) const;
  double collisions_per_sphere() const;
  bool touched_at_start() const;
  bool denser_than_wanted() const;
  bool missed_density() const;  // the stage, and none follows, ended below the packing fraction that is wanted

  // -- windows.cpp
  int32_t run_windows(const Listeners &listeners);
  int32_t advance_part(const Listeners &listeners);
  int32_t end_of_part(int32_t reason);
  void begin_part();
  void end_part();
  void merge_windows();
  void plan_window();
  int32_t reason_to_end();
  double finest_pressure() const;
  void thermostat();
  void slow_down();
  void change_engine(Observer *observer);

  // -- run_report.cpp
  void attach(Observer *observer);
  void detach(Observer *observer);
  void update(Observer &observer) const;
  bool observe(const Listeners &listeners);
  void sample(Observer &observer) const;
  double until_histograms(const Observer *observer) const;  // as time() will be then
  bool sample_histograms(Observer &observer, double at) const;
  double fraction() const;
  jam_progress progress() const;

  int64_t collisions() const { return before_.collisions + engine_->sums.collisions; }
  int64_t events() const { return before_.events + engine_->sums.events; }
  double time() const { return before_.time + engine_->elapsed(); }
  PressureSums sums() const { return before_.sums + engine_->sums.of_pressure; }  // over the run
  double reduced_pressure(const PressureSums &s) const { return s.reduced_pressure(n_, p_.container.momentum_kept()); }
  std::vector<double> wall_momentum() const;  // over the run
  void note_wall_pressure(const PressureSums &time, const std::vector<double> &before);
  PressureSums part_sums() const { return window_.of_part + engine_->sums.of_pressure; }

  Packing p_;
  GrowthStage stage_;
  double n_;
  bool from_archive_ = false;
  bool drawn_ = false;  // velocities, by the stage
  std::unique_ptr<Engine> engine_;
  double goal_ = 0.0;                                                                  // collisions
  double kinetic_ = 0.0;                                                               // sum of m v^2 at the beginning
  double pressure_ = std::numeric_limits<double>::quiet_NaN(), first_pressure_ = 0.0;  // of the last, the first window
  double growth_ = 0.0;                                                                // the rate at which it grows
  int64_t frozen_ = 0;  // windows in which no time passed or gaps were noise
  PressureWindow window_;
  BeforeEngine before_;
  Cooling cooling_;
  ThisCall call_;
};

}  // namespace jam::inside
