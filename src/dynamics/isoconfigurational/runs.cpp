// Isoconfigurational ensemble: each thread of the call takes the next run when it is free, and the runs are added to
// the sums in the order of their numbers.
#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>

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

}  // namespace jam::inside
