// Acceptance falls about exponentially with the step: each round of sweeps gives a better one. Coarse rounds end when
// the step settles. The fine ones are averaged.
#include "dynamics/monte_carlo/step_tuner.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/math.hpp"
#include "dynamics/monte_carlo/monte_carlo.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {
namespace {

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
