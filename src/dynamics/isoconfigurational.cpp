// Isoconfigurational ensemble: checks, runs in the order of their numbers, threads, what resumes.
#include "dynamics/isoconfigurational.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "linalg/two_threads.hpp"

namespace jam {

namespace {

// Runs between two joins of the threads. One waits for the other at the end, for half a run in the mean: 3 % of the
// time.
constexpr size_t batch_of_two = 32;

uint64_t mark_of(const Packing &p) {
  uint64_t mark = mix64(p.n() ^ static_cast<uint64_t>(p.seed));
  for (const std::vector<double> *list : {&p.position, &p.diameter})
    for (const double x : *list) {
      uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      mark = mix64(mark ^ bits);
    }
  return mark;
}

}  // namespace

Isoconfigurational::Isoconfigurational(const Packing &p, bool jammed, const jam_isoconf_options &o,
                                       const jam_monte_carlo_options *mc, std::vector<double> instants,
                                       std::vector<int32_t> kept)
    : packing_(p), mark_(mark_of(p)), kept_instants_(std::move(kept)) {
  plan_.start = p;
  plan_.options = o;
  plan_.instants = std::move(instants);
  if (plan_.instants.empty()) fail(JAM_E_ARGUMENT, "there are no instants");
  for (size_t m = 0; m < plan_.instants.size(); ++m) {
    const double before = m ? plan_.instants[m - 1] : 0.0;
    if (!(plan_.instants[m] > before) || std::isinf(plan_.instants[m]))
      fail(JAM_E_ARGUMENT, "instants must be positive and ascending: instant[%zu] is %g after %g", m, plan_.instants[m],
           before);
  }
  for (const int32_t m : kept_instants_)
    if (m < 0 || static_cast<size_t>(m) >= plan_.instants.size() ||
        std::count(kept_instants_.begin(), kept_instants_.end(), m) > 1)
      fail(JAM_E_ARGUMENT, "kept instant %d is none of the %zu instants, or there twice", m, plan_.instants.size());
  scale_diameters();
  check_memory();
  if (!mc || mc->alpha == 0.0) check_resolution(jammed);
  if (mc) {
    plan_.metropolis = true;
    plan_.monte_carlo = *mc;
    if (plan_.monte_carlo.step == 0.0) plan_.monte_carlo.step = tuned_step(plan_.start, plan_.monte_carlo);
    check_monte_carlo(plan_.start, plan_.monte_carlo);
  }
  kept_.resize(kept_instants_.size());
  report_.struct_size = sizeof report_;
  report_.first_run = o.first_run;
  report_.instants = static_cast<int64_t>(plan_.instants.size());
  report_.step = plan_.metropolis ? plan_.monte_carlo.step : 0.0;
}

void Isoconfigurational::scale_diameters() {
  if (plan_.options.density_ratio == 1.0) return;
  const double factor = std::pow(plan_.options.density_ratio, 1.0 / plan_.start.dim);
  for (double &s : plan_.start.diameter) s *= factor;
}

// What all runs asked for will take; said before anything is run.
void Isoconfigurational::check_memory() const {
  const double spheres = static_cast<double>(n()), d = static_cast<double>(dim()),
               m = static_cast<double>(plan_.instants.size());
  const jam_isoconf_options &o = plan_.options;
  const double blocks = static_cast<double>((o.first_run + o.runs - 1) / o.block - o.first_run / o.block + 1);
  const double sums = 8.0 * m * spheres * (2.0 * d + 2.0) * (blocks + 1.0);
  const double sets = 8.0 * spheres * d * static_cast<double>(o.runs) * static_cast<double>(kept_instants_.size());
  const double records = 8.0 * m * spheres * d * (o.threads == 2 ? static_cast<double>(batch_of_two) : 1.0);
  if (sums + sets + records > o.memory_limit)
    fail(JAM_E_MEMORY, "%.3g bytes are needed (sums of %g blocks %.3g, displacement sets %.3g), memory_limit is %.3g",
         sums + sets + records, blocks, sums, sets, o.memory_limit);
}

// Positions are doubles, so a contact is closed to a few 1e-16 of the box. Gaps opened by less than some hundred times
// that would be rounding.
void Isoconfigurational::check_resolution(bool jammed) const {
  constexpr double safety = 100.0;
  const double ratio = plan_.options.density_ratio;
  const double smallest = *std::min_element(plan_.start.diameter.begin(), plan_.start.diameter.end());
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * plan_.start.cell.side() / smallest;
  const double opened = (1.0 - ratio) / static_cast<double>(dim());
  if ((jammed || ratio < 1.0) && opened < safety * rounding)
    fail(
        JAM_E_ARGUMENT,
        "density_ratio 1 - %.3g opens contacts by %.3g; at least %.3g is needed, as positions are rounded to %.1g of a "
        "diameter",
        1.0 - ratio, opened, safety * rounding, rounding);
}

void Isoconfigurational::continue_with(const Packing &p, const jam_isoconf_options &o,
                                       const jam_monte_carlo_options *mc, const std::vector<double> &instants,
                                       const std::vector<int32_t> &kept) {
  const jam_isoconf_options &mine = plan_.options;
  const jam_monte_carlo_options &own = plan_.monte_carlo;
  const bool same_dynamics = (mc != nullptr) == plan_.metropolis &&
                             (!mc || (mc->alpha == own.alpha && mc->energy_scale == own.energy_scale &&
                                      mc->energy_unit == own.energy_unit && mc->temperature == own.temperature &&
                                      (mc->step == own.step || mc->step == 0.0) && mc->swap_share == own.swap_share));
  if (mark_of(p) != mark_) fail(JAM_E_STATE, "resume is 1 but the packing is not the one that the runs began from");
  if (instants != plan_.instants || kept != kept_instants_ || o.clock != mine.clock || o.first_run != mine.first_run ||
      o.block != mine.block || o.density_ratio != mine.density_ratio || o.temperature != mine.temperature ||
      o.wave_number != mine.wave_number || o.overlap_length != mine.overlap_length || !same_dynamics)
    fail(JAM_E_STATE, "resume is 1 but instants or options are not those that the runs began with");
  const jam_isoconf_options before = plan_.options;
  plan_.options.runs = o.runs;
  plan_.options.threads = o.threads;
  plan_.options.memory_limit = o.memory_limit;
  try {
    check_memory();
  } catch (...) {
    plan_.options = before;
    throw;
  }
}

// ---- runs

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

// Tells the progress callback; true: stop.
bool Isoconfigurational::tick(Monitor &monitor) const {
  jam_progress p{};
  p.phase = phase();
  p.packing_fraction = packing_fraction(plan_.start);
  p.pressure = p.gain = p.max_step = std::numeric_limits<double>::quiet_NaN();
  p.fraction = static_cast<double>(report_.runs) / static_cast<double>(plan_.options.runs);
  p.steps = report_.runs;
  return monitor.report(p);
}

// Makes the runs first, first + 1, ... on one or two threads, each the next one that waits. An error of any is thrown.
void Isoconfigurational::make(int64_t first, std::vector<RunRecord> &records, const Monitor &monitor, double wall_end,
                              const Tick &tick) {
  std::vector<std::exception_ptr> errors(records.size());
  std::atomic<size_t> next{0};
  const auto work = [&](int thread) {
    const RunControl control{monitor, wall_end, thread == 0 ? tick : Tick()};
    for (size_t k; (k = next++) < records.size();) {
      try {
        records[k].displacement.resize(plan_.instants.size() * n() * dim());
        records[k].series.assign(plan_.instants.size() * isoconf_columns, 0.0);
        const auto one = plan_.metropolis ? run_metropolis : run_molecular_dynamics;
        one(plan_, first + static_cast<int64_t>(k), control, records[k]);
      } catch (...) {
        errors[k] = std::current_exception();
      }
    }
  };
  if (plan_.options.threads == 2)
    on_two_threads(work);
  else
    work(0);
  for (const std::exception_ptr &error : errors)
    if (error) std::rethrow_exception(error);
}

jam_status Isoconfigurational::run(const Limits &limits, const Listeners &listeners) {
  Monitor &monitor = *listeners.monitor;
  const double begin = now_seconds(), wall_end = begin + limits.wall_time;
  const Tick tell = [&] { return tick(monitor); };
  const int64_t runs = plan_.options.runs;
  // All memory of the sets now: no run is lost for want of it.
  for (std::vector<double> &set : kept_) set.reserve(static_cast<size_t>(runs) * n() * dim());
  while (report_.runs < runs) {
    const int64_t first = plan_.options.first_run + report_.runs;
    std::vector<RunRecord> records(
        std::min(static_cast<size_t>(runs - report_.runs), plan_.options.threads == 2 ? batch_of_two : 1));
    make(first, records, monitor, wall_end, tell);
    for (size_t k = 0; k < records.size(); ++k) {
      if (records[k].stop_reason != JAM_STOP_NONE) return finish(records[k].stop_reason, begin);
      fold(first + static_cast<int64_t>(k), records[k]);
    }
    if (tell()) return finish(JAM_STOP_CANCELLED, begin);
    if (report_.runs < runs && now_seconds() > wall_end) return finish(JAM_STOP_WALL_TIME, begin);
  }
  return finish(JAM_STOP_COLLISIONS, begin);
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

// ---- results, archive

RunSums Isoconfigurational::sums(int64_t block) const {
  if (block < -1 || block >= static_cast<int64_t>(blocks_.size()))
    fail(JAM_E_ARGUMENT, "block is %lld, there are %zu; -1 is all of them", static_cast<long long>(block),
         blocks_.size());
  if (block >= 0) return blocks_[static_cast<size_t>(block)];
  RunSums all;
  all.start(plan_.instants.size(), n(), dim());
  for (const RunSums &one : blocks_) all.add(one);
  return all;
}

const std::vector<double> &Isoconfigurational::kept(int32_t m) const {
  for (size_t k = 0; k < kept_.size(); ++k)
    if (kept_instants_[k] == m) return kept_[k];
  fail(JAM_E_STATE, "displacements of instant %d were not kept", m);
}

Isoconfigurational::Isoconfigurational(const Packing &p, Archive &from) : packing_(p) {
  plan_.start = p;
  archive(from);
}

void Isoconfigurational::archive(Archive &a) {
  a(plan_.options);
  a(plan_.monte_carlo);
  a(plan_.metropolis);
  a(plan_.instants);
  a(mark_);
  a(kept_instants_);
  a(report_);
  uint64_t blocks = blocks_.size(), sets = kept_.size();
  a(blocks);
  a(sets);
  if (a.reading()) {
    Archive::check(blocks < 1u << 24 && sets == kept_instants_.size());
    check_isoconf_options(plan_.options);
    if (plan_.metropolis) {
      check_monte_carlo_options(plan_.monte_carlo);
      check_monte_carlo(plan_.start, plan_.monte_carlo);
      Archive::check(plan_.monte_carlo.step > 0.0);
    }
    Archive::check(!plan_.instants.empty() && plan_.instants[0] > 0.0 &&
                   std::is_sorted(plan_.instants.begin(), plan_.instants.end()));
    for (const int32_t m : kept_instants_) Archive::check(m >= 0 && static_cast<size_t>(m) < plan_.instants.size());
    blocks_.resize(blocks);
    kept_.resize(sets);
    scale_diameters();
  }
  for (RunSums &block : blocks_) block.archive(a);
  for (std::vector<double> &set : kept_) a(set);
  if (!a.reading()) return;
  const size_t spheres = plan_.instants.size() * n();
  int64_t runs = 0;
  for (const RunSums &block : blocks_) {
    Archive::check(block.distance2.size() == spheres && block.distance4.size() == spheres &&
                   block.displacement.size() == spheres * dim() && block.square.size() == spheres * dim() &&
                   block.series.size() == plan_.instants.size() * isoconf_columns && block.runs > 0);
    runs += block.runs;
  }
  Archive::check(runs == report_.runs);
  for (const std::vector<double> &set : kept_)
    Archive::check(set.size() == static_cast<size_t>(report_.runs) * n() * dim());
}

}  // namespace jam
