// Options of event-driven molecular dynamics, and the stages that they request.
#include "dynamics/event_driven/options.hpp"

#include <algorithm>

#include "core/checks.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {
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
  if (o.growth_rate != 0.0) check_positive(o.growth_rate, "growth_rate");
  if (o.growth_rate > limits::growth_rate_max)
    fail(JAM_E_ARGUMENT, "growth_rate is %g, supported are values up to %g", o.growth_rate, limits::growth_rate_max);
  if (!(o.pressure > 1.0)) fail(JAM_E_ARGUMENT, "pressure is %g, it must be greater than 1", o.pressure);
  check_positive(o.packing_fraction, "packing_fraction");
  check_positive(o.collisions_per_particle, "collisions_per_particle");
  check_positive(o.wall_time, "wall_time");
  check_positive(o.time, "time");
  if (!(o.growth_rate_end >= 0.0) || o.growth_rate_end > o.growth_rate)
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
