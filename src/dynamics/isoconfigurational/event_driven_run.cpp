// One isoconfigurational run of event-driven dynamics.
#include <algorithm>
#include <cmath>

#include "core/create.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/velocities.hpp"
#include "dynamics/isoconfigurational/isoconfigurational.hpp"
#include "dynamics/pressure.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

void draw_run_velocities(Packing &p, int64_t run, double temperature) {
  Rng rng(p.seed, Stream::run_velocities, static_cast<uint64_t>(run) << 36);
  draw_velocities(p, rng);
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  const std::vector<double> mass = sphere_masses(p);
  double twice_kinetic = 0.0;
  for (size_t c = 0; c < d; ++c)
    for (size_t i = 0; i < n; ++i) {
      const double v = p.velocity[i * d + c];
      twice_kinetic += (mass.empty() ? 1.0 : mass[i]) * v * v;
    }
  const double factor = std::sqrt(temperature * static_cast<double>(n * d) / twice_kinetic);
  for (double &v : p.velocity) v *= factor;
}

namespace {

// Advances to the instant; NONE when it is reached. `left` is the time from the last event to the instant.
int32_t advance_to(Engine &engine, const RunPlan &plan, double instant, const RunControl &control, double &left) {
  const bool by_time = plan.options.clock == JAM_CLOCK_TIME;
  const double twice = static_cast<double>(plan.start.n());
  const int64_t goal = by_time ? std::numeric_limits<int64_t>::max() : std::llround(0.5 * instant * twice);
  left = 0.0;
  if (by_time) engine.set_time_limit(instant - engine.elapsed());
  while (engine.sums.collisions < goal) {
    const Halt halt = engine.advance(
        std::min(EnsembleTuning::collisions_between_reports, goal - engine.sums.collisions), control.monitor);
    if (halt == Halt::time) {
      left = instant - engine.elapsed();
      return JAM_STOP_NONE;
    }
    if (halt != Halt::window && halt != Halt::interrupted) return JAM_STOP_STALLED;
    if (control.stopped()) return control.monitor.why_interrupted();
  }
  return JAM_STOP_NONE;
}

}  // namespace

void run_molecular_dynamics(const RunPlan &plan, int64_t run, const RunControl &control, RunRecord &record) {
  Packing p = plan.start;
  draw_run_velocities(p, run, plan.options.temperature);
  const std::vector<double> begun = p.velocity, mass = sphere_masses(p);
  const size_t coordinates = p.position.size(), d = static_cast<size_t>(p.dim);
  Observer observer(p, default_observe_options());
  const std::unique_ptr<Engine> engine =
      make_engine_for(control, record, [&] { return make_engine(p, EngineOptions{}); });
  if (!engine) return;
  if (engine->max_overlap > std::max(overlap_of_rounding, overlap_of_long_flights(p)))
    fail(JAM_E_OVERLAP, "spheres overlap by %g of sigma at the start of the runs", engine->max_overlap);
  engine->observe(&observer);
  const double kinetic = engine->twice_kinetic();
  std::vector<double> moved(coordinates);
  for (size_t m = 0; m < plan.instants.size(); ++m) {
    double left = 0.0;
    record.stop_reason = advance_to(*engine, plan, plan.instants[m], control, left);
    if (record.stop_reason != JAM_STOP_NONE) return;
    engine->displacements(moved);
    engine->write_state(p);
    double *series = &record.series[m * isoconf_columns], product = 0.0;
    for (size_t k = 0; k < coordinates; ++k) {
      record.displacement[m * coordinates + k] = moved[k] + p.velocity[k] * left;
      product += (mass.empty() ? 1.0 : mass[k / d]) * p.velocity[k] * begun[k];
    }
    series[JAM_ISOCONF_TIME] = engine->elapsed() + left;
    series[JAM_ISOCONF_COLLISIONS] = 2.0 * static_cast<double>(engine->sums.collisions) / static_cast<double>(p.n());
    series[JAM_ISOCONF_VELOCITY] = product / kinetic;
    const PressureSums &sums = engine->sums.of_pressure;
    series[JAM_ISOCONF_PRESSURE] =
        sums.time_has_passed() ? sums.reduced_pressure(static_cast<double>(p.n()), p.container.momentum_kept()) : 1.0;
    take_moments(plan, m, record);
  }
  record.energy_drift = std::fabs(twice_kinetic(p) / kinetic - 1.0);
  record.max_overlap = std::max(engine->max_overlap, engine->worst_overlap());
}

}  // namespace jam::inside
