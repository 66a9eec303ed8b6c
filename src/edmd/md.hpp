// Event-driven molecular dynamics of hard spheres: what the C interface calls.
#pragma once
#include "core/monitor.hpp"
#include "core/packing.hpp"

namespace jam {

// One stage: whichever target or limit comes first ends it. growth == 0 is NVE.
struct MdStage {
  double growth = 0.0;  // G = d<sigma>/dt / sqrt(kT/m)
  double pressure = 0.0;
  double packing_fraction = 0.0;
  double collisions_per_particle = 0.0;
  double wall_time = 0.0;  // seconds
};

jam_run_options default_run_options();
jam_compress_options default_compress_options();
// Throw JAM_E_ARGUMENT naming the value.
void check_run_options(const jam_run_options &o);
void check_compress_options(const jam_compress_options &o);

// Runs one stage on p and fills the report (all but struct_size). On return positions, velocities and diameters belong to
// one moment, also when the status says that it stopped early.
jam_status run_stage(Packing &p, const MdStage &stage, Monitor &monitor, jam_md_report &report);
// The stages of jam_compress(sys, NULL, ..) one after the other, with one report.
jam_status run_default_protocol(Packing &p, Monitor &monitor, jam_md_report &report);

}  // namespace jam
