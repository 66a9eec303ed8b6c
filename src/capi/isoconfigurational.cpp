// Header section "Monte Carlo, runs from one configuration".
#include <algorithm>

#include "capi/table.hpp"
#include "core/limits.hpp"
#include "dynamics/isoconfigurational/isoconfigurational.hpp"

using namespace jam::inside;

namespace {

template <class F>
jam_status with_runs(const jam_system *sys, F &&f) noexcept {
  return guard_read(sys, [&]() -> jam_status {
    if (!sys->runs) fail(JAM_E_STATE, "there are no runs: call jam_isoconf first");
    return f(*sys->runs);
  });
}

// In the user's unit; NULL leaves it out.
void give_scaled(const std::vector<double> &data, double unit, double *out) {
  for (size_t k = 0; out && k < data.size(); ++k) out[k] = data[k] * unit;
}

// Without any run its measured numbers are unknown.
jam_isoconf_report report_of(const Isoconfigurational &runs) {
  jam_isoconf_report r = runs.report();
  if (r.runs == 0) r.energy_drift = r.max_overlap = r.acceptance = NAN;
  return r;
}

size_t instants_of(const RunSums &sums) { return sums.series.size() / isoconf_columns; }

// Runs have numbers, instants and limits of their own: an option that would be without effect is refused.
void take_monte_carlo_options(const jam_monte_carlo_options *m, jam_monte_carlo_options &full) {
  const jam_monte_carlo_options usual = full;
  take_options(m, full);
  check_monte_carlo_options(full);
  const auto refuse = [&](bool given, const char *name, const char *instead) {
    if (given) fail(JAM_E_ARGUMENT, "the Monte Carlo option %s has no effect on these runs: use %s", name, instead);
  };
  refuse(full.sweeps != usual.sweeps, "sweeps", "instant");
  refuse(full.run != usual.run, "run", "first_run");
  refuse(full.first_sweep != usual.first_sweep, "first_sweep", "first_run");
  refuse(full.resume != usual.resume, "resume", "resume of the runs");
  refuse(full.wall_time != usual.wall_time, "wall_time", "wall_time of the runs");
}

}  // namespace

extern "C" {

jam_status jam_isoconf_options_init(jam_isoconf_options *o, size_t size) {
  return init_options(o, size, default_isoconf_options());
}

jam_status jam_isoconf(jam_system *sys, const jam_isoconf_options *o, const jam_monte_carlo_options *m,
                       const double *instant, size_t instant_len, const int32_t *kept, size_t kept_len,
                       jam_isoconf_report *report) {
  return guard_reporting(sys, report, [&]() -> Answer {
    jam_isoconf_options full = default_isoconf_options();
    jam_monte_carlo_options monte_carlo = default_monte_carlo_options();
    take_options(o, full);
    check_isoconf_options(full);
    sys->monitor.wall_time = full.wall_time;
    if (m) take_monte_carlo_options(m, monte_carlo);
    check_array_in(instant, instant_len, "instant");
    if (kept_len && !kept) fail(JAM_E_NULL, "kept is NULL but its length is %zu", kept_len);
    std::vector<double> instants(instant, instant + instant_len);
    std::vector<int32_t> sets(kept, kept + kept_len);
    const jam_monte_carlo_options *chosen = m ? &monte_carlo : nullptr;
    if (full.resume) {
      if (!sys->runs) fail(JAM_E_STATE, "resume is 1 but there are no runs on this handle");
      sys->runs->continue_with(sys->packing, full, chosen, instants, sets);
    } else {
      const bool jammed = sys->has_report && sys->report.jammed;
      sys->runs = std::make_unique<Isoconfigurational>(sys->packing, jammed, full, chosen, std::move(instants),
                                                       std::move(sets));
    }
    Limits limits;
    limits.wall_time = full.wall_time;
    Listeners listeners;
    listeners.monitor = &sys->monitor;
    const Running running(sys, sys->runs.get());
    const jam_status status = sys->runs->run(limits, listeners);
    give_struct(report_of(*sys->runs), report);
    return stopped_run(status, sys->runs->report().stop_reason);
  });
}

jam_status jam_get_isoconf_report(const jam_system *sys, jam_isoconf_report *report) {
  return with_runs(sys, [&](const Isoconfigurational &runs) -> jam_status {
    need(report, "report");
    check_out_struct(report, "report");
    give_struct(report_of(runs), report);
    return JAM_OK;
  });
}

jam_status jam_isoconf_displacements(const jam_system *sys, int64_t block, double *displacement,
                                     size_t displacement_len, double *square, size_t square_len, size_t *rows) {
  return with_runs(sys, [&](const Isoconfigurational &made) -> jam_status {
    const RunSums sums = made.sums(block);
    const double box = made.box();
    outputs_wanted(instants_of(sums), rows,
                   {{displacement, displacement_len, sums.displacement.size(), "displacement"},
                    {square, square_len, sums.square.size(), "square"}});
    give_scaled(sums.displacement, box, displacement);
    give_scaled(sums.square, box * box, square);
    return JAM_OK;
  });
}

jam_status jam_isoconf_distances(const jam_system *sys, int64_t block, double *distance2, size_t distance2_len,
                                 double *distance4, size_t distance4_len, size_t *rows) {
  return with_runs(sys, [&](const Isoconfigurational &made) -> jam_status {
    const RunSums sums = made.sums(block);
    const double box = made.box();
    outputs_wanted(instants_of(sums), rows,
                   {{distance2, distance2_len, sums.distance2.size(), "distance2"},
                    {distance4, distance4_len, sums.distance4.size(), "distance4"}});
    give_scaled(sums.distance2, box * box, distance2);
    give_scaled(sums.distance4, box * box * box * box, distance4);
    return JAM_OK;
  });
}

jam_status jam_isoconf_series(const jam_system *sys, int64_t block, int32_t columns, double *table, size_t table_len,
                              size_t *needed) {
  return with_runs(sys, [&](const Isoconfigurational &made) -> jam_status {
    static_assert(JAM_ISOCONF_RUNS == isoconf_columns, "the sums of the runs, and their number");
    const Table<JAM_ISOCONF_COLUMNS> made_table(columns, table, table_len);
    const RunSums sums = made.sums(block);
    const size_t instants = instants_of(sums);
    if (!made_table.wanted(instants, needed)) return JAM_OK;
    const double box = made.box();
    made_table.give(instants, [&](size_t k, auto &row) {
      std::copy_n(sums.series.begin() + static_cast<ptrdiff_t>(k * isoconf_columns), isoconf_columns, row.begin());
      row[JAM_ISOCONF_MSD] *= box * box;
      row[JAM_ISOCONF_MSD2] *= box * box * box * box;
      row[JAM_ISOCONF_RUNS] = static_cast<double>(sums.runs);
    });
    return JAM_OK;
  });
}

jam_status jam_isoconf_kept(const jam_system *sys, int32_t instant, double *out, size_t out_len, size_t *needed) {
  return with_runs(sys, [&](const Isoconfigurational &made) -> jam_status {
    const std::vector<double> &set = made.kept(instant);
    const jam_status status = give_array(set.data(), set.size(), out, out_len, needed);
    if (out)
      for (size_t k = 0; k < set.size(); ++k) out[k] *= made.box();
    return status;
  });
}

jam_status jam_monte_carlo_options_init(jam_monte_carlo_options *o, size_t size) {
  return init_options(o, size, default_monte_carlo_options());
}

jam_status jam_monte_carlo(jam_system *sys, const jam_monte_carlo_options *o, jam_monte_carlo_report *report) {
  return guard_reporting(sys, report, [&]() -> Answer {
    jam_monte_carlo_options full = default_monte_carlo_options();
    take_options(o, full);
    check_flag(full.resume, "resume");
    if (!full.resume && full.first_sweep == -1) full.first_sweep = sys->sweeps;
    check_monte_carlo_options(full);
    std::unique_ptr<MonteCarloRun> stage;
    if (full.resume) {
      if (!sys->paused || sys->paused->phase() != JAM_PHASE_MONTE_CARLO)
        fail(JAM_E_STATE, "resume is 1 but no Monte Carlo run was stopped early on this handle");
      static_cast<const MonteCarloRun &>(*sys->paused).check_resumed(full);
      stage.reset(static_cast<MonteCarloRun *>(sys->paused.release()));
    } else {
      stage = std::make_unique<MonteCarloRun>(sys->packing, full);
    }
    Limits limits;
    limits.per_particle = static_cast<double>(full.sweeps);
    limits.wall_time = full.wall_time;
    Listeners listeners;
    listeners.monitor = &sys->monitor;
    if (sys->observing) listeners.observer = sys->observer.get();
    Observations observations(sys);
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
    observations.keep();
    sys->sweeps = made.next_sweep;
    if (status != JAM_OK) sys->paused = std::move(stage);
    give_struct(made, report);
    return stopped_run(status, made.stop_reason);
  });
}

}  // extern "C"
