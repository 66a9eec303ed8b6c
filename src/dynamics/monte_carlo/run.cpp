// A Monte Carlo run in progress: samples, progress, report.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/cell_reduction.hpp"
#include "core/create.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "core/with_dimension.hpp"
#include "dynamics/monte_carlo/monte_carlo.hpp"
#include "dynamics/observer.hpp"

namespace jam::inside {

MonteCarloRun::MonteCarloRun(const Packing &p, const jam_monte_carlo_options &o)
    : p_(p), options_(o), means_(p, o), seen_(p.position.size(), 0.0) {
  check_monte_carlo(p_, options_);
}

// Tunes the step if it is 0, and makes lists. false: the call must stop; making lists starts again in the next run.
bool MonteCarloRun::begin(Monitor &monitor) {
  if (engine_) return true;
  jam_progress q = progress_of(phase());
  q.packing_fraction = packing_fraction(p_);
  monitor.expect(q);
  try {
    if (options_.step == 0.0 && !tuner_.tune(p_, options_, monitor)) return false;
    const CancellableScope scope;
    check_monte_carlo(p_, options_);
    engine_ = make_monte_carlo(p_, options_, options_.run);
    // Velocities of before belong to another state.
    p_.has_velocity = false;
    if (options_.alpha > 0.0) p_.overlap_allowed = true;  // soft spheres leave overlaps: calls for hard ones must look
    std::fill(p_.velocity.begin(), p_.velocity.end(), 0.0);
  } catch (const Cancelled &) {
    return false;
  }
  return true;
}

MonteCarloRun::MonteCarloRun(const Packing &p, Archive &from)
    : p_(p), options_(default_monte_carlo_options()), means_(p, options_) {
  archive(from);
}

void MonteCarloRun::archive(Archive &a) {
  int64_t done = engine_ ? done_ : not_begun;
  a(options_);
  a(done);
  a(stop_reason_);
  a(seen_);
  means_.archive(a);
  if (a.reading()) {
    check_monte_carlo_options(options_);
    Archive::check(done >= not_begun && seen_.size() == p_.position.size());
    check_monte_carlo(p_, options_);
    done_ = std::max<int64_t>(done, 0);
  }
  if (options_.step == 0.0) tuner_.archive(a, p_, options_);
  if (a.reading() && done != not_begun) {
    Archive::check(options_.step > 0.0);
    engine_ = make_monte_carlo(p_, options_, options_.run);
  }
  if (engine_) engine_->archive(a);
}

// -1: the first sweep has no number yet.
static void check_sweep_numbers(int64_t first, int64_t sweeps) {
  constexpr int64_t last = std::numeric_limits<int64_t>::max();
  if (first < -1 || first > last - sweeps)
    fail(JAM_E_ARGUMENT, "%lld sweeps from number %lld on: numbers go from 0 to %lld", static_cast<long long>(sweeps),
         static_cast<long long>(first), static_cast<long long>(last));
}

void MonteCarloRun::check_resumed(const jam_monte_carlo_options &o) const {
  const jam_monte_carlo_options usual = default_monte_carlo_options();
  const auto look = [&](const char *name, auto member) {
    if (o.*member != usual.*member && o.*member != options_.*member)
      fail(JAM_E_ARGUMENT, "resume: %s is %g, but the run that was stopped has %g", name,
           static_cast<double>(o.*member), static_cast<double>(options_.*member));
  };
  using Options = jam_monte_carlo_options;
  look("energy_unit", &Options::energy_unit), look("alpha", &Options::alpha);
  look("energy_scale", &Options::energy_scale), look("temperature", &Options::temperature);
  look("step", &Options::step), look("acceptance", &Options::acceptance), look("swap_share", &Options::swap_share);
  look("run", &Options::run), look("first_sweep", &Options::first_sweep);
  check_sweep_numbers(options_.first_sweep, o.sweeps);
}

Packing MonteCarloRun::current() const {
  Packing p = p_;
  if (!engine_) return p;
  engine_->write_state(p);
  return p;
}

void MonteCarloRun::take_displacement(Observer *observer) {
  const std::vector<double> &moved = engine_->displacement();
  const size_t d = static_cast<size_t>(p_.dim);
  if (observer)
    for (size_t k = 0; k < moved.size(); ++k)
      observer->travel(static_cast<int32_t>(k / d))[k % d] += moved[k] - seen_[k];
  seen_ = moved;
}

jam_status MonteCarloRun::run(const Limits &limits, const Listeners &listeners) {
  const double started = now_seconds();
  listeners.monitor->limit_time(limits.wall_time);
  if (!begin(*listeners.monitor)) {
    stop_reason_ = listeners.monitor->why_interrupted();
    return stop_reason_ == JAM_STOP_CANCELLED ? JAM_CANCELLED : JAM_LIMIT;
  }
  // No callback inside a sweep: what it stores must be whole.
  const CallScope quiet(CallScope::memory_limit());
  const int64_t goal = static_cast<int64_t>(std::min(limits.per_particle, 9e15)), before = done_;
  jam_progress q = progress_of(phase());
  q.packing_fraction = packing_fraction(p_);
  stop_reason_ = JAM_STOP_COLLISIONS;
  while (done_ < goal) {
    engine_->sweep(options_.first_sweep + done_++);
    if (done_ % SampleTuning::sweeps == 0) means_.sample(*engine_);
    if (done_ == goal) break;
    q.fraction = static_cast<double>(done_) / static_cast<double>(goal);
    q.steps = done_;
    listeners.monitor->report(q);
    if (!listeners.monitor->interrupted()) continue;
    stop_reason_ = listeners.monitor->why_interrupted();
    break;
  }
  take_displacement(listeners.observer);
  engine_->write_state(p_);
  seconds_ = now_seconds() - started;
  trials_ = static_cast<double>(done_ - before) * static_cast<double>(p_.n());
  p_.pressure = report().pressure;
  if (stop_reason_ == JAM_STOP_CANCELLED) return JAM_CANCELLED;
  return stop_reason_ == JAM_STOP_WALL_TIME ? JAM_LIMIT : JAM_OK;
}

jam_monte_carlo_report MonteCarloRun::report() const {
  jam_monte_carlo_report r{};
  r.struct_size = sizeof r;
  r.stop_reason = stop_reason_;
  r.step = options_.step;
  r.next_sweep = options_.first_sweep;
  if (!engine_) {  // nothing was measured
    if (r.step == 0.0) r.step = NAN;
    r.acceptance = r.swap_acceptance = r.energy = r.energy_error = r.pressure = r.pressure_error = r.trials_per_second =
        NAN;
    return r;
  }
  double msd = 0.0;
  for (const double x : engine_->displacement()) msd += x * x;
  r.msd = msd / static_cast<double>(p_.n()) * p_.cell.side() * p_.cell.side();
  r.sweeps = done_;
  r.next_sweep = options_.first_sweep + done_;
  r.acceptance = engine_->counts.acceptance();
  r.swap_acceptance = engine_->counts.swap_acceptance();
  means_.give(r);
  r.seconds = seconds_;
  r.trials_per_second = trials_ / std::max(seconds_, 1e-9);
  return r;
}

// Monte Carlo: the choice of an engine, and options.

// Compiled by copies of trials.cpp.in.
template <int D>
std::unique_ptr<MonteCarlo> make_monte_carlo_of(const Packing &p, const jam_monte_carlo_options &o, int64_t run);

double largest_monte_carlo_step(const Packing &p) {
  // Along a cell vector a step in a cube of that half side goes no farther than the share of it.
  const double far = p.cell.cube() ? 1.0 : std::sqrt(static_cast<double>(p.dim));
  return MonteCarloTuning::longest_step * search_cell(p).height_min() / far / diameter_mean(p);
}

std::unique_ptr<MonteCarlo> make_monte_carlo(const Packing &p, const jam_monte_carlo_options &o, int64_t run) {
  return with_dimension(p.dim, [&](auto d) { return make_monte_carlo_of<d>(p, o, run); });
}

// ---- options

jam_monte_carlo_options default_monte_carlo_options() {
  jam_monte_carlo_options o{};
  o.struct_size = sizeof o;
  o.energy_scale = o.temperature = 1.0;
  o.acceptance = 0.45;
  o.sweeps = 1000;
  o.first_sweep = -1;
  o.wall_time = std::numeric_limits<double>::infinity();
  return o;
}

void check_monte_carlo_options(const jam_monte_carlo_options &o) {
  if (o.alpha != 0.0 && !(o.alpha > 1.0 && o.alpha <= limits::exponent_max))
    fail(JAM_E_ARGUMENT, "alpha is %g, it must be 0 (hard spheres), or more than 1 and at most %g", o.alpha,
         limits::exponent_max);
  check_enum(o.energy_unit, JAM_ENERGY_LENGTH, JAM_ENERGY_RELATIVE, "energy_unit", "jam_energy_unit");
  check_range("energy_scale", o.energy_scale, limits::energy_min, limits::energy_max);
  check_range("temperature", o.temperature, limits::energy_min, limits::energy_max);
  if (!(o.step >= 0.0) || std::isinf(o.step)) fail(JAM_E_ARGUMENT, "step is %g, it must be 0 or positive", o.step);
  if (!(o.acceptance > 0.0 && o.acceptance < 1.0))
    fail(JAM_E_ARGUMENT, "acceptance is %g, it must be in (0, 1)", o.acceptance);
  if (!(o.swap_share >= 0.0 && o.swap_share < 1.0))
    fail(JAM_E_ARGUMENT, "swap_share is %g, it must be in [0, 1)", o.swap_share);
  check_at_least(o.sweeps, 1, "sweeps");
  check_at_least(o.run, 0, "run");
  check_sweep_numbers(o.first_sweep, o.sweeps);
  check_positive(o.wall_time, "wall_time");
}

// Where the energy is still larger than the temperature by more, those of the accepted overlaps underflow.
static void check_energies(const Packing &p, const jam_monte_carlo_options &o) {
  const double overlap = o.energy_unit == JAM_ENERGY_RELATIVE ? 1.0 : contact_distance_max(p);
  const double energy = o.energy_scale * math::pow(overlap, o.alpha);
  check_energy("energy_scale", o.energy_scale, energy);
  if (!(energy <= limits::energy_max * o.temperature))
    fail(JAM_E_ARGUMENT, "temperature is %g: two spheres at one place have the energy %g, at most %g times as much",
         o.temperature, energy, limits::energy_max);
}

void check_monte_carlo(const Packing &p, const jam_monte_carlo_options &o) {
  if (p.model != JAM_MODEL_EUCLID) fail(JAM_E_UNSUPPORTED, "Monte Carlo has no quenched shifts (JAM_MODEL_MK)");
  const double largest = largest_monte_carlo_step(p);
  if (o.step > largest)
    fail(JAM_E_ARGUMENT, "step is %g mean diameters; in this cell the largest is %g", o.step, largest);
  const double least = limits::move_min * p.cell.side() / diameter_mean(p);
  if (o.step > 0.0 && o.step < least)
    fail(JAM_E_ARGUMENT, "step is %g mean diameters; places in this cell resolve steps from %g on", o.step, least);
  if (o.alpha != 0.0) check_energies(p, o);
  if (o.alpha == 0.0 && p.overlap_allowed) refuse_overlaps(p, overlap_of_rounding);
}

}  // namespace jam::inside
