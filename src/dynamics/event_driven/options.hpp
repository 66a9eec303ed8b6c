// Options of event-driven molecular dynamics, and one call that runs a stage from its beginning to its end.
#pragma once
#include "dynamics/dynamics.hpp"

namespace jam::inside {

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

}  // namespace jam::inside
