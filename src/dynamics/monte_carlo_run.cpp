// Runs of the Metropolis engine: options, tuning of the step, means, one run of the ensemble, the verb.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "dynamics/isoconfigurational.hpp"
#include "dynamics/monte_carlo.hpp"
#include "dynamics/observer.hpp"

namespace jam {

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
  const auto positive = [](double value, const char *name) {
    if (!(value > 0.0) || std::isinf(value))
      fail(JAM_E_ARGUMENT, "%s is %g, it must be positive and finite", name, value);
  };
  if (o.alpha != 0.0 && !(o.alpha > 1.0 && std::isfinite(o.alpha)))
    fail(JAM_E_ARGUMENT, "alpha is %g, it must be 0 (hard spheres) or more than 1", o.alpha);
  if (o.energy_unit != JAM_ENERGY_LENGTH && o.energy_unit != JAM_ENERGY_RELATIVE)
    fail(JAM_E_ARGUMENT, "energy_unit is %d, not a jam_energy_unit", o.energy_unit);
  positive(o.energy_scale, "energy_scale");
  positive(o.temperature, "temperature");
  if (!(o.step >= 0.0) || std::isinf(o.step)) fail(JAM_E_ARGUMENT, "step is %g, it must be 0 or positive", o.step);
  if (!(o.acceptance > 0.0 && o.acceptance < 1.0))
    fail(JAM_E_ARGUMENT, "acceptance is %g, it must be in (0, 1)", o.acceptance);
  if (!(o.swap_share >= 0.0 && o.swap_share < 1.0))
    fail(JAM_E_ARGUMENT, "swap_share is %g, it must be in [0, 1)", o.swap_share);
  if (o.sweeps < 1) fail(JAM_E_ARGUMENT, "sweeps is %lld, it must be at least 1", static_cast<long long>(o.sweeps));
  if (o.run < 0) fail(JAM_E_ARGUMENT, "run is %lld, it must not be negative", static_cast<long long>(o.run));
  if (o.first_sweep < -1) fail(JAM_E_ARGUMENT, "first_sweep is %lld", static_cast<long long>(o.first_sweep));
  if (!(o.wall_time > 0.0)) fail(JAM_E_ARGUMENT, "wall_time is %g, it must be positive", o.wall_time);
}

void check_monte_carlo(const Packing &p, const jam_monte_carlo_options &o) {
  if (p.model != JAM_MODEL_EUCLID) fail(JAM_E_UNSUPPORTED, "Monte Carlo has no quenched shifts (JAM_MODEL_MK)");
  const double largest = largest_monte_carlo_step(p);
  if (!(largest > 0.0))
    fail(JAM_E_UNSUPPORTED, "the largest contact distance, %g, is too near half the box side, %g",
         contact_distance_max(p), 0.5 * p.cell.side());
  if (o.step > largest)
    fail(JAM_E_ARGUMENT, "step is %g mean diameters; in this box the largest is %g", o.step, largest);
}

// ---- tuning

double tuned_step(const Packing &p, const jam_monte_carlo_options &given) {
  constexpr int coarse = 60, fine = 20, coarse_sweeps = 4, fine_sweeps = 12;  // 480 sweeps, 0.1 s at n = 1024
  constexpr double smallest = 1e-12;
  jam_monte_carlo_options o = given;
  check_monte_carlo(p, o);
  const double largest = largest_monte_carlo_step(p), length = diameter_mean(p) / p.cell.side();
  double step = std::min(0.1, largest), mean_log = 0.0;
  o.step = step;
  const std::unique_ptr<MonteCarlo> mc = make_monte_carlo(p, o, -1);  // no run has this number
  int64_t number = 0;
  for (int k = 0; k < coarse + fine; ++k) {
    const MonteCarloCounts before = mc->counts;
    for (int s = 0; s < (k < coarse ? coarse_sweeps : fine_sweeps); ++s) mc->sweep(number++);
    const int64_t tried = mc->counts.moves - before.moves;
    const double share =
        tried ? static_cast<double>(mc->counts.moved - before.moved) / static_cast<double>(tried) : 1.0;
    // Acceptance falls about exponentially with the step.
    const double factor = std::log(std::max(share, 1e-3)) / std::log(o.acceptance);
    step = std::min(largest,
                    step * std::min(2.0, std::max(0.3, std::pow(std::max(factor, 1e-3), k < coarse ? -1.0 : -0.5))));
    if (step < smallest)
      fail(JAM_E_ARGUMENT, "no step above %g mean diameters is accepted: the spheres are in contact", smallest);
    mc->set_step(step * length);
    if (k >= coarse) mean_log += std::log(step) / fine;
  }
  return std::min(largest, std::exp(mean_log));
}

// ---- means

MonteCarloMeans::MonteCarloMeans(const Packing &p, const jam_monte_carlo_options &o)
    : n_(static_cast<double>(p.n())), dim_(p.dim), temperature_(o.temperature), hard_(o.alpha == 0.0) {}

void MonteCarloMeans::sample(MonteCarlo &mc) {
  if (!hard_) {
    energy_.push_back(mc.energy() / n_);
    pressure_.push_back(1.0 + mc.virial() / (dim_ * n_ * temperature_));
    return;
  }
  if (h_max_ == 0.0) {
    // Gaps up to about 1/(4 p): three quarters of a pair a sphere lie there.
    std::vector<double> all(4096, 0.0);
    const double range = mc.gap_range();
    mc.count_gaps(range, all);
    double sum = 0.0;
    size_t k = 0;
    while (k < all.size() && sum < 0.25 * dim_ * n_) sum += all[k++];
    h_max_ = range * static_cast<double>(k) / static_cast<double>(all.size());
  }
  std::vector<double> now(bins, 0.0);
  mc.count_gaps(h_max_, now);
  gaps_.insert(gaps_.end(), now.begin(), now.end());
}

namespace {

// Density of pairs at h = 0 from counts in bins: ln(count) = a + b h + c h^2 by least squares, weights count.
double density_at_contact(const std::vector<double> &count, double h_max) {
  double m[3][4] = {};
  const double width = h_max / static_cast<double>(count.size());
  for (size_t k = 0; k < count.size(); ++k) {
    if (!(count[k] > 0.0)) continue;
    const double h = (static_cast<double>(k) + 0.5) / static_cast<double>(count.size());
    const double basis[3] = {1.0, h, h * h}, y = std::log(count[k] / width);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) m[a][b] += count[k] * basis[a] * basis[b];
      m[a][3] += count[k] * basis[a] * y;
    }
  }
  for (int a = 0; a < 3; ++a) {
    if (!(m[a][a] > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    for (int b = 0; b < 3; ++b) {
      if (b == a) continue;
      const double factor = m[b][a] / m[a][a];
      for (int c = 0; c < 4; ++c) m[b][c] -= factor * m[a][c];
    }
  }
  return std::exp(m[0][3] / m[0][0]);
}

constexpr size_t parts = 20;  // of a run, for the errors of its means

void mean_of(const std::vector<double> &x, double &mean, double &error) {
  mean = error = std::numeric_limits<double>::quiet_NaN();
  if (x.empty()) return;
  mean = 0.0;
  for (const double v : x) mean += v / static_cast<double>(x.size());
  if (x.size() < 2 * parts) return;
  double square = 0.0;
  for (size_t b = 0; b < parts; ++b) {
    double sum = 0.0;
    const size_t begin = b * x.size() / parts, end = (b + 1) * x.size() / parts;
    for (size_t k = begin; k < end; ++k) sum += x[k];
    const double off = sum / static_cast<double>(end - begin) - mean;
    square += off * off;
  }
  error = std::sqrt(square / static_cast<double>(parts * (parts - 1)));
}

}  // namespace

// p = 1 + n(0) / (d N), n(h) the number of pairs a unit of h: a uniform compression by h brings n(0) h pairs in
// contact.
void MonteCarloMeans::give_hard(jam_monte_carlo_report &report) const {
  if (gaps_.empty()) return;
  const size_t samples_made = gaps_.size() / bins;
  const auto pressure = [&](size_t from, size_t to) {  // without samples from .. to
    std::vector<double> sum(bins, 0.0);
    double samples = 0.0;
    for (size_t k = 0; k < samples_made; ++k) {
      if (k >= from && k < to) continue;
      ++samples;
      for (size_t b = 0; b < sum.size(); ++b) sum[b] += gaps_[k * bins + b];
    }
    return 1.0 + density_at_contact(sum, h_max_) / samples / (dim_ * n_);
  };
  report.pressure = pressure(0, 0);
  if (samples_made < 2 * parts) return;
  double mean = 0.0, square = 0.0;
  std::vector<double> without;
  for (size_t b = 0; b < parts; ++b)
    without.push_back(pressure(b * samples_made / parts, (b + 1) * samples_made / parts)),
        mean += without.back() / parts;
  for (const double v : without) square += (v - mean) * (v - mean);
  report.pressure_error = std::sqrt(square * (parts - 1.0) / parts);
}

void MonteCarloMeans::give(jam_monte_carlo_report &report) const {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  report.energy = report.energy_error = report.pressure = report.pressure_error = nan;
  if (hard_) {
    report.energy = report.energy_error = 0.0;
    give_hard(report);
    return;
  }
  mean_of(energy_, report.energy, report.energy_error);
  mean_of(pressure_, report.pressure, report.pressure_error);
}

void MonteCarloMeans::archive(Archive &a) {
  for (double *x : {&n_, &dim_, &temperature_, &h_max_}) a(*x);
  a(hard_);
  for (std::vector<double> *v : {&energy_, &pressure_, &gaps_}) a(*v);
  if (a.reading()) Archive::check(gaps_.size() % bins == 0 && energy_.size() == pressure_.size());
}

// ---- one run of the ensemble

namespace {

double share(int64_t part, int64_t all) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void run_metropolis(const RunPlan &plan, int64_t run, const RunControl &control, RunRecord &record) {
  constexpr int64_t sweeps_between_looks = 16;
  const std::unique_ptr<MonteCarlo> mc = make_monte_carlo(plan.start, plan.monte_carlo, run);
  const double n = static_cast<double>(plan.start.n()), d = plan.start.dim;
  const size_t coordinates = plan.start.position.size();
  int64_t sweep = 0;
  for (size_t m = 0; m < plan.instants.size(); ++m) {
    for (const int64_t goal = std::llround(plan.instants[m]); sweep < goal; ++sweep) {
      mc->sweep(sweep);
      if (sweep % sweeps_between_looks != 0) continue;
      record.stop_reason = control.stopped()                  ? JAM_STOP_CANCELLED
                           : now_seconds() > control.wall_end ? JAM_STOP_WALL_TIME
                                                              : JAM_STOP_NONE;
      if (record.stop_reason != JAM_STOP_NONE) return;
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
  record.acceptance = share(mc->counts.moved, mc->counts.moves);
}

// ---- the stage

MonteCarloStage::MonteCarloStage(const Packing &p, const jam_monte_carlo_options &o)
    : p_(p), options_(o), means_(p, o), seen_(p.position.size(), 0.0) {
  if (options_.step == 0.0) options_.step = tuned_step(p_, options_);
  check_monte_carlo(p_, options_);
  // Velocities of before belong to another state.
  p_.has_velocity = false;
  std::fill(p_.velocity.begin(), p_.velocity.end(), 0.0);
  engine_ = make_monte_carlo(p_, options_, options_.run);
}

MonteCarloStage::MonteCarloStage(const Packing &p, Archive &from)
    : p_(p), options_(default_monte_carlo_options()), means_(p, options_) {
  archive(from);
}

void MonteCarloStage::archive(Archive &a) {
  a(options_);
  a(done_);
  a(stop_reason_);
  a(seen_);
  means_.archive(a);
  if (a.reading()) {
    check_monte_carlo_options(options_);
    Archive::check(options_.step > 0.0 && done_ >= 0 && seen_.size() == p_.position.size());
    check_monte_carlo(p_, options_);
    engine_ = make_monte_carlo(p_, options_, options_.run);
  }
  engine_->archive(a);
}

Packing MonteCarloStage::current() const {
  Packing p = p_;
  engine_->write_state(p);
  return p;
}

bool MonteCarloStage::tell(Monitor &monitor, double goal) const {
  jam_progress q{};
  q.phase = phase();
  q.packing_fraction = packing_fraction(p_);
  q.pressure = q.gain = q.max_step = std::numeric_limits<double>::quiet_NaN();
  q.fraction = static_cast<double>(done_) / goal;
  q.steps = done_;
  return monitor.report(q);
}

void MonteCarloStage::take_displacement(Observer *observer) {
  const std::vector<double> &moved = engine_->displacement();
  const size_t d = static_cast<size_t>(p_.dim);
  if (observer)
    for (size_t k = 0; k < moved.size(); ++k)
      observer->travel(static_cast<int32_t>(k / d))[k % d] += moved[k] - seen_[k];
  seen_ = moved;
}

jam_status MonteCarloStage::run(const Limits &limits, const Listeners &listeners) {
  constexpr int64_t sample_every = 10;  // sweeps; a sample takes about the time of a sweep
  const double begin = now_seconds(), wall_end = begin + limits.wall_time;
  const int64_t goal = static_cast<int64_t>(std::min(limits.per_particle, 9e15)), before = done_;
  stop_reason_ = JAM_STOP_COLLISIONS;
  while (done_ < goal) {
    engine_->sweep(options_.first_sweep + done_++);
    if (done_ % sample_every != 0) continue;
    means_.sample(*engine_);
    if (done_ == goal) break;
    if (tell(*listeners.monitor, static_cast<double>(goal))) stop_reason_ = JAM_STOP_CANCELLED;
    if (now_seconds() > wall_end) stop_reason_ = JAM_STOP_WALL_TIME;
    if (stop_reason_ != JAM_STOP_COLLISIONS) break;
  }
  take_displacement(listeners.observer);
  engine_->write_state(p_);
  seconds_ = now_seconds() - begin;
  trials_ = static_cast<double>(done_ - before) * static_cast<double>(p_.n());
  p_.pressure = report().pressure;
  if (stop_reason_ == JAM_STOP_CANCELLED) return JAM_CANCELLED;
  return stop_reason_ == JAM_STOP_WALL_TIME ? JAM_LIMIT : JAM_OK;
}

jam_monte_carlo_report MonteCarloStage::report() const {
  jam_monte_carlo_report r{};
  r.struct_size = sizeof r;
  r.stop_reason = stop_reason_;
  r.step = options_.step;
  double msd = 0.0;
  for (const double x : engine_->displacement()) msd += x * x;
  r.msd = msd / static_cast<double>(p_.n()) * p_.cell.side() * p_.cell.side();
  r.sweeps = done_;
  r.next_sweep = options_.first_sweep + done_;
  r.acceptance = share(engine_->counts.moved, engine_->counts.moves);
  r.swap_acceptance = share(engine_->counts.swapped, engine_->counts.swaps);
  means_.give(r);
  r.seconds = seconds_;
  r.trials_per_second = trials_ / std::max(seconds_, 1e-9);
  return r;
}

}  // namespace jam
