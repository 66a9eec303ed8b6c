// Event-driven molecular dynamics of hard spheres: what the C interface calls.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "dynamics/observer.hpp"

namespace jam {

constexpr double no_limit = std::numeric_limits<double>::infinity();

// One stage: whichever target or limit comes first ends it. growth == 0 is NVE.
struct MdStage {
  double growth = 0.0;  // G = d<sigma>/dt / sqrt(kT/m), or with `relative` d ln<sigma>/dt in units of n^(1/d) / box
  double pressure = 0.0;
  double packing_fraction = 0.0;
  double collisions_per_particle = 0.0;  // from the beginning of the stage, also when it is resumed
  double wall_time = 0.0;                // seconds, of one call
  double time = no_limit;                // simulated, from the beginning of the stage
  double growth_end = 0.0;               // > 0: growth falls as a power of p, to this at the target pressure
  int64_t relative = 0;                  // 1: constant relative rate of growth
};

// A stage that has begun and not ended; holds the engine. Made by begin_stage or read_stage.
class Stage;
struct StageDeleter {
  void operator()(Stage *stage) const;
};
using StagePtr = std::unique_ptr<Stage, StageDeleter>;

// What a run tells while it goes on; observer and the functions may be empty.
struct MdListeners {
  Monitor *monitor = nullptr;
  Observer *observer = nullptr;
  std::function<void(const Packing &)> show;  // before a snapshot is reported
};

jam_run_options default_run_options();
jam_compress_options default_compress_options();
// Throw JAM_E_ARGUMENT naming the value.
void check_run_options(const jam_run_options &o);
void check_compress_options(const jam_compress_options &o);
MdStage stage_of(const jam_run_options &o);
MdStage stage_of(const jam_compress_options &o);

StagePtr begin_stage(Packing p, const MdStage &stage);
// Takes limits (collisions, time, wall time) from `limits`, all else is as the stage began. Adds to the report, so that
// stages run one after the other give one. On return packing_of(stage) is of one moment, also when the status says
// stopped early.
jam_status run(Stage &stage, const MdStage &limits, const MdListeners &listeners, jam_md_report &report);
const Packing &packing_of(const Stage &stage);
bool growing(const Stage &stage);
// The state of this moment, between two events; bytes that read_stage turns into a stage with the same future.
Packing current(const Stage &stage);
std::string write_stage(const Stage &stage);
StagePtr read_stage(const Packing &p, std::string bytes);

// Begin, run, take the packing: for tests and benchmarks.
jam_status run_stage(Packing &p, const MdStage &stage, Monitor &monitor, jam_md_report &report);
// The stages of jam_compress(sys, NULL, ..).
extern const MdStage default_protocol[2];

}  // namespace jam
