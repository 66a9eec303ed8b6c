// Trial moves a second of Metropolis Monte Carlo against a plain cell-list code, and the accuracy of the pressure
// against processor time. Both codes take turns on the same packing with the same step. monte_carlo [SECONDS]: JSON to
// stdout. Rates are medians of seven rounds of processor time.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "core/create.hpp"
#include "core/rng.hpp"
#include "dynamics/event_driven/options.hpp"
#include "dynamics/monte_carlo/monte_carlo.hpp"

using namespace jam::inside;

static double cpu() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

static Packing fluid(int64_t n, double fraction, Monitor &monitor) {
  jam_create_options o = default_create_options();
  o.n = n;
  Packing p = make_packing(o, nullptr, 0, nullptr, 0);
  jam_md_report report{};
  run_stage(p, {0.03, 1e12, fraction, no_limit, no_limit}, monitor, report);
  return p;
}

// What a textbook does: linked cells no narrower than a diameter, 27 of them looked through for each trial.
class Plain {
 public:
  Plain(const Packing &p, double step, double alpha, double temperature)
      : sigma_(p.diameter[0]),
        step_(step * sigma_),
        alpha_(alpha),
        beta_(1.0 / temperature),
        rng_(7, Stream::monte_carlo) {
    m_ = static_cast<int>(1.0 / sigma_);
    x_.resize(p.n());
    first_.assign(static_cast<size_t>(m_ * m_ * m_), -1);
    next_.resize(p.n());
    before_.resize(p.n());
    for (size_t i = 0; i < p.n(); ++i) {
      for (int c = 0; c < 3; ++c) x_[i][c] = p.position[3 * i + c];
      link(static_cast<int>(i));
    }
  }
  void sweep() {
    for (size_t i = 0; i < x_.size(); ++i) trial(static_cast<int>(i));
  }
  int64_t moved = 0;

 private:
  using Point = std::array<double, 3>;
  int cell(const Point &x) const {
    int at = 0;
    for (int c = 0; c < 3; ++c) at = at * m_ + std::min(m_ - 1, static_cast<int>(x[c] * m_));
    return at;
  }
  void link(int i) {
    const int c = cell(x_[i]);
    before_[i] = -1;
    next_[i] = first_[c];
    if (next_[i] >= 0) before_[next_[i]] = i;
    first_[c] = i;
  }
  void unlink(int i) {
    if (before_[i] >= 0)
      next_[before_[i]] = next_[i];
    else
      first_[cell(x_[i])] = next_[i];
    if (next_[i] >= 0) before_[next_[i]] = before_[i];
  }
  double energy(int i, const Point &x) const {
    double sum = 0.0;
    int home[3];
    for (int c = 0; c < 3; ++c) home[c] = std::min(m_ - 1, static_cast<int>(x[c] * m_));
    for (int k = 0; k < 27; ++k) {
      const int a = (home[0] + k / 9 - 1 + m_) % m_, b = (home[1] + k / 3 % 3 - 1 + m_) % m_,
                c = (home[2] + k % 3 - 1 + m_) % m_;
      for (int j = first_[(a * m_ + b) * m_ + c]; j >= 0; j = next_[j]) {
        if (j == i) continue;
        double r2 = 0.0;
        for (int e = 0; e < 3; ++e) {
          double r = x[e] - x_[j][e];
          r -= r > 0.5 ? 1.0 : r < -0.5 ? -1.0 : 0.0;
          r2 += r * r;
        }
        if (r2 >= sigma_ * sigma_) continue;
        if (alpha_ == 0.0) return 1e300;
        sum += std::pow(sigma_ - std::sqrt(r2), alpha_);
      }
    }
    return sum;
  }
  void trial(int i) {
    Point to = x_[i];
    for (double &c : to) c = wrap(c + step_ * (2.0 * rng_.uniform() - 1.0), 1.0);
    const double change = energy(i, to) - (alpha_ > 0.0 ? energy(i, x_[i]) : 0.0);
    if (change > 0.0 && !(alpha_ > 0.0 && rng_.uniform() < std::exp(-change * beta_))) return;
    unlink(i);
    x_[i] = to;
    link(i);
    ++moved;
  }
  double sigma_, step_, alpha_, beta_;
  int m_;
  Rng rng_;
  std::vector<Point> x_;
  std::vector<int> first_, next_, before_;
};

static double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

static void race(const char *name, const Packing &p, double alpha, double temperature, double seconds, bool last) {
  jam_monte_carlo_options o = default_monte_carlo_options();
  o.alpha = alpha;
  o.temperature = temperature;
  Monitor never_stops;
  StepTuner().tune(p, o, never_stops);
  const std::unique_ptr<MonteCarlo> mc = make_monte_carlo(p, o, 0);
  Plain plain(p, o.step, alpha, temperature);
  std::vector<double> ours, theirs;
  int64_t number = 0;
  for (int round = 0; round < 7; ++round)
    for (int which = 0; which < 2; ++which) {
      const double begin = cpu();
      int64_t sweeps = 0;
      while (cpu() - begin < seconds / 14)
        for (int k = 0; k < 10; ++k, ++sweeps) which ? plain.sweep() : mc->sweep(number++);
      (which ? theirs : ours).push_back(static_cast<double>(sweeps) * static_cast<double>(p.n()) / (cpu() - begin));
    }
  const MonteCarloCounts &c = mc->counts;
  std::printf(
      "  {\"scene\": \"%s\", \"n\": %zu, \"alpha\": %g, \"temperature\": %g, \"step\": %.4g, \"acceptance\": %.4f, "
      "\"sweeps_a_list\": %.3g, \"trials_a_second\": %.4g, \"plain\": %.4g, \"ratio\": %.3g}%s\n",
      name, p.n(), alpha, temperature, o.step, static_cast<double>(c.moved) / static_cast<double>(c.moves),
      static_cast<double>(number) / static_cast<double>(c.lists), median(ours), median(theirs),
      median(ours) / median(theirs), last ? "" : ",");
}

int main(int argc, char **argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 2.8;
  Monitor monitor;
  std::printf("[\n");
  const Packing glass = fluid(1024, 0.63, monitor);
  race("hard, phi 0.63", glass, 0.0, 1.0, seconds, false);
  race("hard, phi 0.50", fluid(1024, 0.5, monitor), 0.0, 1.0, seconds, false);
  race("hard, phi 0.30", fluid(1024, 0.3, monitor), 0.0, 1.0, seconds, false);
  race("soft, phi 0.63", glass, 2.0, 1e-6, seconds, false);
  race("soft, phi 0.63", glass, 2.0, 1e-4, seconds, false);
  race("soft, phi 0.63", glass, 1.5, 1e-3, seconds, false);
  race("soft, phi 0.63", glass, 2.5, 1e-5, seconds, true);
  std::printf("]\n");
}
