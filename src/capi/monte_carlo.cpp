// Header section "Monte Carlo, runs from one configuration": the single run.
#include <memory>

#include "capi/guard.hpp"
#include "core/checks.hpp"
#include "dynamics/monte_carlo/monte_carlo.hpp"

using namespace jam::inside;

extern "C" {

jam_status jam_monte_carlo_options_init(jam_monte_carlo_options *o, size_t size) {
  return init_options(o, size, default_monte_carlo_options());
}

jam_status jam_monte_carlo(jam_system *sys, const jam_monte_carlo_options *o, jam_monte_carlo_report *report) {
  return guard_reporting(sys, report, [&]() -> Answer {
    jam_monte_carlo_options full = default_monte_carlo_options();
    take_options(o, full);
    check_monte_carlo_options(full);
    std::unique_ptr<MonteCarloRun> stage;
    check_flag(full.resume, "resume");
    if (full.resume) {
      if (!sys->paused || sys->paused->phase() != JAM_PHASE_MONTE_CARLO)
        fail(JAM_E_STATE, "resume is 1 but no Monte Carlo run was stopped early on this handle");
      static_cast<const MonteCarloRun &>(*sys->paused).check_resumed(full);
      stage.reset(static_cast<MonteCarloRun *>(sys->paused.release()));
    } else {
      if (full.first_sweep < 0) full.first_sweep = sys->sweeps;
      stage = std::make_unique<MonteCarloRun>(sys->packing, full);
    }
    Limits limits;
    limits.per_particle = static_cast<double>(full.sweeps);
    limits.wall_time = full.wall_time;
    Listeners listeners;
    listeners.monitor = &sys->monitor;
    if (sys->observing) listeners.observer = sys->observer.get();
    jam_status status = JAM_OK;
    {
      const Running running(sys, stage.get());
      status = stage->run(limits, listeners);
    }
    const jam_monte_carlo_report made = stage->report();
    if (stage->begun()) {
      check_packing(stage->packing(), JAM_E_STATE);  // a stage from a file may lead anywhere
      sys->commit(stage->packing());
    } else {
      sys->crunch_paused.reset();  // a handle keeps only the last paused run
    }
    sys->sweeps = made.next_sweep;
    if (status != JAM_OK) sys->paused = std::move(stage);
    give_struct(made, report);
    return stopped_run(status, made.stop_reason);
  });
}

}  // extern "C"
