// Isoconfigurational ensemble: each thread of the call takes the next run when it is free, and the runs are added to
// the sums in the order of their numbers.
#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>

#include "core/create.hpp"
#include "core/error.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/velocities.hpp"
#include "dynamics/isoconfigurational/isoconfigurational.hpp"
#include "dynamics/tuning.hpp"
#include "linalg/workers.hpp"

namespace jam::inside {

// What the threads share. A thread takes the next number, makes the run, and hands its record in. The thread that
// delivers the next run in order adds it to the sums, with all later runs that wait.
struct Isoconfigurational::Queue {
  std::mutex mutex;  // of all below, of the sums and of the report
  std::condition_variable moved;
  int64_t next = 0;                      // number to be taken
  std::map<int64_t, RunRecord> waiting;  // made, but not those before them
  std::vector<RunRecord> spare;          // their memory is used again
  bool stopped = false;                  // no more runs begin
  int32_t reason = JAM_STOP_COLLISIONS;
  std::exception_ptr error;
  void stop(int32_t why) {
    stopped = true;
    reason = why;
  }
};

void Isoconfigurational::fold(int64_t run, const RunRecord &record) {
  const size_t block = static_cast<size_t>(run / plan_.options.block - plan_.options.first_run / plan_.options.block);
  const size_t coordinates = n() * dim();
  if (blocks_.size() <= block) {
    RunSums empty;
    empty.start(plan_.instants.size(), n(), dim());
    blocks_.push_back(std::move(empty));
    report_.blocks = static_cast<int64_t>(blocks_.size());
  }
  blocks_[block].add(record, dim());
  for (size_t k = 0; k < kept_.size(); ++k) {
    const auto from = record.displacement.begin() + static_cast<std::ptrdiff_t>(kept_instants_[k] * coordinates);
    kept_[k].insert(kept_[k].end(), from, from + static_cast<std::ptrdiff_t>(coordinates));
  }
  ++report_.runs;
  report_.energy_drift = std::max(report_.energy_drift, record.energy_drift);
  report_.max_overlap = std::max(report_.max_overlap, record.max_overlap);
  report_.acceptance += (record.acceptance - report_.acceptance) / static_cast<double>(report_.runs);
}

void Isoconfigurational::report_step(Monitor &monitor) const {
  jam_progress p = progress_of(phase());
  p.packing_fraction = plan_.fraction;
  p.fraction = static_cast<double>(report_.runs) / static_cast<double>(plan_.options.runs);
  p.steps = report_.runs;
  monitor.report(p);
}

// Gives a run number, and memory for its record. False: no more.
bool Isoconfigurational::take(Queue &queue, int64_t &run, RunRecord &record) const {
  std::unique_lock<std::mutex> lock(queue.mutex);
  const int64_t first = plan_.options.first_run;
  queue.moved.wait(lock,
                   [&] { return queue.stopped || queue.next < first + report_.runs + EnsembleTuning::runs_ahead; });
  if (queue.stopped || queue.next >= first + plan_.options.runs) return false;
  run = queue.next++;
  if (!queue.spare.empty()) {
    record = std::move(queue.spare.back());
    queue.spare.pop_back();
  }
  record.displacement.resize(plan_.instants.size() * n() * dim());
  record.series.assign(plan_.instants.size() * isoconf_columns, 0.0);
  record.stop_reason = JAM_STOP_NONE;
  return true;
}

// Takes a record, and folds all that are next.
void Isoconfigurational::hand_in(Queue &queue, int64_t run, RunRecord &record, const Monitor &monitor) {
  const std::lock_guard<std::mutex> lock(queue.mutex);
  if (record.stop_reason != JAM_STOP_NONE) queue.stopped = true;
  queue.waiting.emplace(run, std::move(record));
  for (auto at = queue.waiting.begin();
       at != queue.waiting.end() && at->first == plan_.options.first_run + report_.runs;) {
    if (at->second.stop_reason != JAM_STOP_NONE) return queue.stop(at->second.stop_reason);
    fold(at->first, at->second);
    queue.spare.push_back(std::move(at->second));
    at = queue.waiting.erase(at);
  }
  if (report_.runs < plan_.options.runs && monitor.interrupted()) queue.stop(monitor.why_interrupted());
}

void Isoconfigurational::work(Queue &queue, const RunControl &control) {
  const auto one = plan_.metropolis ? run_metropolis : run_molecular_dynamics;
  int64_t run = 0;
  try {
    for (RunRecord record; take(queue, run, record);) {
      one(plan_, run, control, record);
      hand_in(queue, run, record, control.monitor);
      queue.moved.notify_all();
      if (!control.report_step) continue;
      control.report_step();
      if (!control.monitor.cancelled()) continue;
      const std::lock_guard<std::mutex> lock(queue.mutex);
      queue.stop(JAM_STOP_CANCELLED);
    }
  } catch (...) {
    const std::lock_guard<std::mutex> lock(queue.mutex);
    queue.stopped = true;
    queue.error = std::current_exception();
  }
  queue.moved.notify_all();
}

jam_status Isoconfigurational::run(const Limits &limits, const Listeners &listeners) {
  Monitor &monitor = *listeners.monitor;
  const double begin = now_seconds();
  monitor.limit_time(limits.wall_time);
  if (plan_.metropolis && plan_.monte_carlo.step == 0.0) {
    if (!tuner_.tune(plan_.start, plan_.monte_carlo, monitor)) return finish(monitor.why_interrupted(), begin);
    report_.step = plan_.monte_carlo.step;
  }
  // All memory of the sets now: no run is lost for want of it.
  for (std::vector<double> &set : kept_) set.reserve(static_cast<size_t>(plan_.options.runs) * n() * dim());
  Queue queue;
  queue.next = plan_.options.first_run + report_.runs;
  // The callback may read the sums: they rest meanwhile.
  const std::function<void()> report = [&] {
    const std::lock_guard<std::mutex> lock(queue.mutex);
    report_step(monitor);
  };
  const double memory_limit = CallScope::memory_limit();
  Workers workers(plan_.options.threads);
  workers.run(plan_.options.threads, [&](int, int worker) {
    const CallScope scope(memory_limit, worker == 0 ? &monitor : nullptr, &queue.mutex);
    work(queue, RunControl{monitor, worker == 0 ? report : nullptr});
  });
  if (queue.error) std::rethrow_exception(queue.error);
  return finish(queue.reason, begin);
}

jam_status Isoconfigurational::finish(int32_t reason, double begin) {
  report_.stop_reason = reason;
  report_.seconds += now_seconds() - begin;
  switch (reason) {
    case JAM_STOP_COLLISIONS:
      return JAM_OK;
    case JAM_STOP_CANCELLED:
      return JAM_CANCELLED;
    case JAM_STOP_WALL_TIME:
      return JAM_LIMIT;
    default:
      return JAM_NOT_CONVERGED;
  }
}

// One isoconfigurational run of event-driven dynamics.

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

// Collisions or sweeps of an instant; of one that no run comes to, so many that none comes to them either.
int64_t whole_number(double count) { return std::llround(std::min(count, 9e18)); }

// Advances to the instant; NONE when it is reached. `left` is the time from the last event to the instant.
int32_t advance_to(Engine &engine, const RunPlan &plan, double instant, const RunControl &control, double &left) {
  const bool by_time = plan.options.clock == JAM_CLOCK_TIME;
  const double twice = static_cast<double>(plan.start.n());
  const int64_t goal = by_time ? std::numeric_limits<int64_t>::max() : whole_number(0.5 * instant * twice);
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

// One isoconfigurational run of Metropolis Monte Carlo.
void run_metropolis(const RunPlan &plan, int64_t run, const RunControl &control, RunRecord &record) {
  const std::unique_ptr<MonteCarlo> mc =
      make_engine_for(control, record, [&] { return make_monte_carlo(plan.start, plan.monte_carlo, run); });
  if (!mc) return;
  const double n = static_cast<double>(plan.start.n()), d = plan.start.dim;
  const size_t coordinates = plan.start.position.size();
  int64_t sweep = 0;
  for (size_t m = 0; m < plan.instants.size(); ++m) {
    for (const int64_t goal = whole_number(plan.instants[m]); sweep < goal; ++sweep) {
      mc->sweep(sweep);
      if (!control.stopped()) continue;
      record.stop_reason = control.monitor.why_interrupted();
      return;
    }
    std::copy(mc->displacement().begin(), mc->displacement().end(),
              record.displacement.begin() + static_cast<std::ptrdiff_t>(m * coordinates));
    double *series = &record.series[m * isoconf_columns];
    series[JAM_ISOCONF_TIME] = static_cast<double>(sweep);
    const double energy = mc->energy() / n;
    series[JAM_ISOCONF_ENERGY] = energy;
    series[JAM_ISOCONF_ENERGY2] = energy * energy;
    series[JAM_ISOCONF_PRESSURE] = plan.monte_carlo.alpha > 0.0
                                       ? 1.0 + mc->virial() / (d * n * plan.monte_carlo.temperature)
                                       : std::numeric_limits<double>::quiet_NaN();
    take_moments(plan, m, record);
  }
  record.acceptance = mc->counts.acceptance();
}

}  // namespace jam::inside
