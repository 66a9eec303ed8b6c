// Means of a Monte Carlo run and their errors.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math.hpp"
#include "dynamics/monte_carlo/monte_carlo.hpp"

namespace jam::inside {
namespace {

// Acceptance falls about exponentially with the step: each round of sweeps gives a better one. Coarse rounds end when
// the step settles. The fine ones are averaged.

constexpr int64_t no_run = -1;  // no run has this number
constexpr int64_t rounds = StepTuning::coarse + StepTuning::fine;
bool is_coarse(int64_t round) { return round < StepTuning::coarse; }

class Rounds {
 public:
  Rounds(const Packing &p, const jam_monte_carlo_options &o)
      : n_(static_cast<int64_t>(p.n())),
        largest_(largest_monte_carlo_step(p)),
        length_(diameter_mean(p) / p.cell.side()),
        log_wanted_(math::log(o.acceptance)),
        step_(std::min(StepTuning::first, largest_)) {
    check_monte_carlo(p, o);
    make(p, o);
  }
  Rounds(const Packing &p, const jam_monte_carlo_options &o, Archive &from) : Rounds(p, o) {
    state(from);
    Archive::check(round_ >= 0 && round_ < rounds && sweep_ >= 0 && sweep_ <= sweeps_of(round_) && number_ >= 0);
    Archive::check(step_ > 0.0 && step_ <= largest_ && std::isfinite(mean_log_));
    if (round_ > 0) mc_->set_step(step_ * length_);
    mc_->archive(from);
    from.end();
  }

  bool run(Monitor &monitor) {
    for (; round_ < rounds; ++round_) {
      while (sweep_ < sweeps_of(round_)) {
        mc_->sweep(number_++);
        ++sweep_;
        if (monitor.look()) return false;
      }
      adapt();
      before_ = mc_->counts;
      sweep_ = 0;
    }
    return true;
  }
  double step() const { return std::min(largest_, math::exp(mean_log_)); }
  void archive(Archive &a) {
    state(a);
    mc_->archive(a);
  }

 private:
  // Acceptance needs trials, not sweeps.
  int64_t sweeps_of(int64_t round) const {
    const int64_t trials = is_coarse(round) ? StepTuning::coarse_trials : StepTuning::fine_trials,
                  most = is_coarse(round) ? StepTuning::coarse_sweeps : StepTuning::fine_sweeps;
    return std::min(most, (trials + n_ - 1) / n_);
  }
  void make(const Packing &p, jam_monte_carlo_options o) {
    o.step = step_;
    mc_ = make_monte_carlo(p, o, no_run);
  }
  void state(Archive &a) { a(before_), a(round_), a(sweep_), a(number_), a(step_), a(mean_log_); }
  void adapt() {
    const int64_t tried = mc_->counts.moves - before_.moves;
    const double share =
        tried ? static_cast<double>(mc_->counts.moved - before_.moved) / static_cast<double>(tried) : 1.0;
    const double factor = math::log(std::max(share, StepTuning::least_share)) / log_wanted_,
                 change = math::pow(std::max(factor, StepTuning::least_share), is_coarse(round_) ? -1.0 : -0.5);
    const double before = step_;
    step_ = std::min(largest_, step_ * std::min(StepTuning::most_growth, std::max(StepTuning::most_fall, change)));
    if (step_ < StepTuning::smallest)
      fail(JAM_E_ARGUMENT, "no step above %g mean diameters is accepted: the spheres are in contact",
           StepTuning::smallest);
    mc_->set_step(step_ * length_);
    if (!is_coarse(round_))
      mean_log_ += math::log(step_) / StepTuning::fine;
    else if (std::fabs(step_ - before) < StepTuning::settled * before)
      round_ = StepTuning::coarse - 1;
  }

  int64_t n_;
  double largest_, length_, log_wanted_;  // of a step in mean diameters; its unit in box sides; log of the acceptance
  std::unique_ptr<MonteCarlo> mc_;
  MonteCarloCounts before_;                     // at the beginning of this round
  int64_t round_ = 0, sweep_ = 0, number_ = 0;  // sweeps: of this round, of all
  double step_, mean_log_ = 0.0;
};

Rounds continued(const Packing &p, const jam_monte_carlo_options &o, const std::vector<char> &left) {
  Archive from(std::string(left.begin(), left.end()));
  return Rounds(p, o, from);
}

}  // namespace

MonteCarloMeans::MonteCarloMeans(const Packing &p, const jam_monte_carlo_options &o)
    : n_(static_cast<double>(p.n())), dim_(p.dim), temperature_(o.temperature), hard_(o.alpha == 0.0) {}

void MonteCarloMeans::sample(MonteCarlo &mc) {
  if (!hard_) {
    energy_.push_back(mc.energy() / n_);
    pressure_.push_back(1.0 + mc.virial() / (dim_ * n_ * temperature_));
    return;
  }
  if (h_max_ == 0.0) {
    std::vector<double> all(SampleTuning::first_bins, 0.0);
    const double range = mc.gap_range();
    mc.count_gaps(range, all);
    double sum = 0.0;
    size_t k = 0;
    while (k < all.size() && sum < SampleTuning::pairs_counted * dim_ * n_) sum += all[k++];
    h_max_ = range * static_cast<double>(k) / static_cast<double>(all.size());
  }
  std::vector<double> now(bins, 0.0);
  mc.count_gaps(h_max_, now);
  gaps_.insert(gaps_.end(), now.begin(), now.end());
}

namespace {

// Density of pairs at h = 0 from counts in bins: ln(count) = a + b h + c h^2 by least squares, weights count. NaN where
// so few counts leave a, whose error is the root of an element of the inverse matrix, open by 1 or more.
double density_at_contact(const std::vector<double> &count, double h_max) {
  double m[3][5] = {};
  m[0][4] = 1.0;
  const double width = h_max / static_cast<double>(count.size());
  for (size_t k = 0; k < count.size(); ++k) {
    if (!(count[k] > 0.0)) continue;
    const double h = (static_cast<double>(k) + 0.5) / static_cast<double>(count.size());
    const double basis[3] = {1.0, h, h * h}, y = math::log(count[k] / width);
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
      for (int c = 0; c < 5; ++c) m[b][c] -= factor * m[a][c];
    }
  }
  if (!(m[0][4] < m[0][0])) return std::numeric_limits<double>::quiet_NaN();
  return math::exp(m[0][3] / m[0][0]);
}

constexpr size_t parts = SampleTuning::parts;

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

bool StepTuner::tune(const Packing &p, jam_monte_carlo_options &o, Monitor &monitor) {
  // Lists are made whole: a call that left them would have nothing to keep.
  Rounds tuned = left_.empty() ? Rounds(p, o) : continued(p, o, left_);
  if (!tuned.run(monitor)) {
    Archive to;
    tuned.archive(to);
    left_.assign(to.bytes().begin(), to.bytes().end());
    return false;
  }
  o.step = tuned.step();
  left_ = {};
  return true;
}

void StepTuner::archive(Archive &a, const Packing &p, const jam_monte_carlo_options &o) {
  a(left_);
  if (a.reading() && !left_.empty()) continued(p, o, left_);
}

}  // namespace jam::inside
