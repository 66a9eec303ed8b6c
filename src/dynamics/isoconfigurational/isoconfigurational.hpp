// Isoconfigurational ensemble (Widmer-Cooper, Harrowell and Fynewever, Phys. Rev. Lett. 93, 135701 (2004)): many runs
// from one configuration.
//
//   packing -> run k: velocities, or Metropolis trials, of its own random stream -> RunRecord: displacements at
//   instants
//   -> RunSums of the block of run numbers that k belongs to -> sums over all blocks
//
// A run depends on the packing, its seed and the run's number only. Runs enter the sums in the order of their numbers,
// and blocks begin at multiples of `block`. So any two ways to make the same blocks give the same bits.
#pragma once
#include "core/call_scope.hpp"
#include "dynamics/monte_carlo/monte_carlo.hpp"

namespace jam::inside {

// Columns of RunSums::series: sums over runs of one number a run and instant.
constexpr size_t isoconf_columns = JAM_ISOCONF_PRESSURE + 1;

// What one run gives. Lengths in units of the box side.
struct RunRecord {
  std::vector<double> displacement;  // (instants, n, d), unwrapped
  std::vector<double> series;        // (instants, isoconf_columns)
  double energy_drift = 0.0, max_overlap = 0.0, acceptance = 0.0;
  int32_t stop_reason = JAM_STOP_NONE;  // NONE: the run is whole
};

// Sums over the runs of one block, at each instant.
struct RunSums {
  int64_t runs = 0;
  std::vector<double> displacement, square;  // (instants, n, d): dr_c, dr_c^2
  std::vector<double> distance2, distance4;  // (instants, n): |dr|^2, |dr|^4
  std::vector<double> series;                // (instants, isoconf_columns)
  void start(size_t instants, size_t n, size_t dim);
  void add(const RunRecord &run, size_t dim);
  void add(const RunSums &other);
  void archive(Archive &a);
};

// What all runs share.
struct RunPlan {
  Packing start;                // diameters scaled, masses set, no velocities
  double length = 0.0;          // mean diameter of these, unit of the box side
  double fraction = 0.0;        // packing fraction of these
  jam_isoconf_options options;  // checked
  jam_monte_carlo_options monte_carlo{};
  bool metropolis = false;       // monte_carlo is used
  std::vector<double> instants;  // ascending, > 0
};

// When a run must stop. Runs poll it now and then.
struct RunControl {
  const Monitor &monitor;
  std::function<void()> report_step;  // empty on all threads except that of the caller
  bool stopped() const {
    if (report_step) report_step();
    return monitor.interrupted();
  }
};

// An engine, whose searches for pairs may be left: then null, and the record says why.
template <class Make>
auto make_engine_for(const RunControl &control, RunRecord &record, Make &&make) -> decltype(make()) {
  const CancellableScope scope;
  try {
    return make();
  } catch (const Cancelled &) {
    record.stop_reason = control.monitor.why_interrupted();
    return nullptr;
  }
}

// Sets what depends on displacements alone: the MSD, F_s and overlap columns of instant m.
void take_moments(const RunPlan &plan, size_t m, RunRecord &record);
// One run of event-driven dynamics.
void run_molecular_dynamics(const RunPlan &plan, int64_t run, const RunControl &control, RunRecord &record);
// One Metropolis run.
void run_metropolis(const RunPlan &plan, int64_t run, const RunControl &control, RunRecord &record);
// Maxwell-Boltzmann velocities of run k: zero total momentum, twice the kinetic energy exactly d n T.
void draw_run_velocities(Packing &p, int64_t run, double temperature);

jam_isoconf_options default_isoconf_options();
void check_isoconf_options(const jam_isoconf_options &o);

class Isoconfigurational final : public Dynamics {
 public:
  // Checks everything, the memory that `o.runs` runs will take among it. jammed: p is known to be at its jamming point.
  Isoconfigurational(const Packing &p, bool jammed, const jam_isoconf_options &o, const jam_monte_carlo_options *mc,
                     std::vector<double> instants, std::vector<int32_t> kept);
  Isoconfigurational(const Packing &p, Archive &from);

  // To resume: the packing, instants and options but runs, threads, memory_limit and wall_time must be the same.
  void continue_with(const Packing &p, const jam_isoconf_options &o, const jam_monte_carlo_options *mc,
                     const std::vector<double> &instants, const std::vector<int32_t> &kept);

  int32_t phase() const override { return JAM_PHASE_ISOCONF; }
  // Until options.runs runs are made; of the limits wall_time counts.
  jam_status run(const Limits &limits, const Listeners &listeners) override;
  const Packing &packing() const override { return packing_; }  // as given: the runs do not change it
  Packing current() const override { return packing_; }
  void archive(Archive &a) override;

  const jam_isoconf_report &report() const { return report_; }
  bool complete() const { return report_.runs >= plan_.options.runs; }
  // Sums of one block, or of all in their order for block = -1.
  RunSums sums(int64_t block) const;
  // Whole displacement sets (runs, n, d) of instant m, which must have been kept.
  const std::vector<double> &kept(int32_t m) const;
  double box() const { return packing_.cell.side(); }

 private:
  void take_diameters();
  size_t n() const { return packing_.n(); }
  size_t dim() const { return static_cast<size_t>(packing_.dim); }
  void check_memory() const;
  void check_resolution(bool jammed) const;
  void report_step(Monitor &monitor) const;
  struct Queue;
  bool take(Queue &queue, int64_t &run, RunRecord &record) const;
  void hand_in(Queue &queue, int64_t run, RunRecord &record, const Monitor &monitor);
  void work(Queue &queue, const RunControl &control);
  void fold(int64_t run, const RunRecord &record);
  jam_status finish(int32_t reason, double begin);
  Packing packing_;
  RunPlan plan_;
  StepTuner tuner_;
  uint64_t mark_ = 0;  // of positions and diameters that the runs begin from
  std::vector<int32_t> kept_instants_;
  std::vector<std::vector<double>> kept_;
  std::vector<RunSums> blocks_;
  jam_isoconf_report report_{};
};

}  // namespace jam::inside
