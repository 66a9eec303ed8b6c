// What jam_observe records. The engine reports collisions and displacements; the stage decides when to take a sample.
// Nothing here changes the dynamics. Lengths are in units of the box; the C calls convert them.
//
// The series is taken at collisions. Histograms are not: at a collision one pair more than on average is in contact.
// They are taken at moments that are set some collisions per particle before, so that no collision is favoured.
#pragma once
#include <algorithm>
#include <limits>

#include "core/packing.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

// Reduced pressure p = P V / (N k T) from the sums of a run.

// Over some collisions and the time between them.
struct PressureSums {
  double virial = 0.0;            // sum of r . dp, of momentum exchanged without the growth part
  double kinetic_integral = 0.0;  // integral of sum m v^2 over time
  PressureSums &operator+=(const PressureSums &more) {
    virial += more.virial;
    kinetic_integral += more.kinetic_integral;
    return *this;
  }
  PressureSums operator+(const PressureSums &more) const { return PressureSums(*this) += more; }
  PressureSums operator-(const PressureSums &less) const {
    return {virial - less.virial, kinetic_integral - less.kinetic_integral};
  }
  bool time_has_passed() const { return kinetic_integral > 0.0; }
  // p = 1 + virial / (d N kT t) for n spheres. The total momentum is constant, so kT = sum m v^2 / (d (N - 1)) about
  // the centre of mass. Two hard spheres then have their exact p = 1 + 2 phi / (1 - 4 phi) in three dimensions. Of
  // walls the virial has radius times momentum: then p is beta P V / N with the P that acts on the walls and the whole
  // V of the container. `kept`: the share of components of the momentum that is constant (Container::momentum_kept).
  double reduced_pressure(double n, double kept = 1.0) const {
    return 1.0 + (n - kept) / n * (virial / kinetic_integral);
  }
};

// The stress tensor of dynamics, as momentum that crosses a plane: by collisions, and carried by the spheres
// themselves. The traces are PressureSums, which are taken at the same moments.
class StressSums {
 public:
  explicit StressSums(size_t dim) : dim_(dim), virial_(dim * dim, 0.0), kinetic_(virial_), moving_(virial_) {}

  // The momenta are counted again, and have been there since then.
  void restart(double since) { moving_.assign(dim_ * dim_, 0.0), since_ = since; }
  // weight: m, negative to take a sphere out.
  template <int D>
  void add(double weight, const double *v) {
    each<D>([&](size_t at, int a, int b) { moving_[at] += weight * (v[a] * v[b]); });
  }
  // Of a new origin of time: then, which is `now` by the old one.
  template <int D>
  void advance(double now, double then) {
    const double time = now - since_;
    each<D>([&](size_t at, int, int) { kinetic_[at] += time * moving_[at]; });
    since_ = then;
  }
  // Momentum along n over the distance of centres: their product is the work.
  template <int D>
  void collide(double work, const double *n) {
    each<D>([&](size_t at, int a, int b) { virial_[at] += work * (n[a] * n[b]); });
  }
  // P_ab V / (N kT), with the trace d PressureSums::reduced_pressure; NaN before any time has passed.
  std::vector<double> reduced(double n, double kept) const {
    double trace = 0.0;
    for (size_t c = 0; c < dim_; ++c) trace += kinetic_[c * (dim_ + 1)];
    const double unit = static_cast<double>(dim_) / trace;
    std::vector<double> out(dim_ * dim_);
    for (size_t a = 0; a < dim_; ++a)
      for (size_t b = a; b < dim_; ++b) {
        const size_t at = a * dim_ + b;
        out[at] = out[b * dim_ + a] = unit * (kinetic_[at] + (n - kept) / n * virial_[at]);
      }
    return out;
  }

 private:
  template <int D, class F>
  static void each(F &&f) {
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b) f(static_cast<size_t>(a * D + b), a, b);
  }

  size_t dim_;
  std::vector<double> virial_, kinetic_, moving_;  // sum of r dp; integral of sum m v v over time; that sum now: b >= a
  double since_ = 0.0;
};

struct Sample {
  double time, collisions, packing_fraction, pressure, error, displacement2;
};

// Sums over the collisions of each pair: a hash table with open addressing, which doubles when it is half full.
class PairSums {
 public:
  struct Slot {
    uint64_t key = empty;
    int64_t collisions = 0;
    double momentum = 0.0;
  };
  static constexpr uint64_t empty = ~uint64_t{0};
  void add(int32_t i, int32_t j, double momentum);
  std::vector<Slot> sorted() const;  // by (i, j), i < j; key = i << 32 | j

 private:
  Slot &find(uint64_t key);
  std::vector<Slot> slots_;
  size_t used_ = 0;
};

// Running mean and its error of a density in bins.
struct Histogram {
  std::vector<double> edge, sum, square;
  int64_t samples = 0;
  size_t bins() const { return sum.size(); }
  void start(std::vector<double> edges);
  void add(const std::vector<double> &density);
  double mean(size_t bin) const {
    return samples > 0 ? sum[bin] / static_cast<double>(samples) : std::numeric_limits<double>::quiet_NaN();
  }
  double error(size_t bin) const;
};

jam_observe_options default_observe_options();
void check_observe_options(const jam_observe_options &o);

class Observer {
 public:
  Observer(const Packing &p, const jam_observe_options &o);

  // Called by the engine, with the user's numbers of spheres.
  void collision(int32_t i, int32_t j, double momentum) {
    if (!options_.collisions) return;
    ++collisions_[i];
    ++collisions_[j];
    pairs_.add(i, j, momentum);
  }
  void wall_collision(int32_t i) {
    if (options_.collisions) ++collisions_[i];
  }
  StressSums stress;
  std::vector<double> reduced_stress() const { return stress.reduced(n_, momentum_kept_); }
  double *travel(int32_t i) { return &travel_[static_cast<size_t>(i) * dim_]; }

  // Called by the stage. Collisions are counted over all calls since jam_observe.
  int64_t seen = 0;   // collisions, now
  double time = 0.0;  // simulated, now
  int64_t next_stop() const { return std::min(next_block_, next_snapshot_); }
  bool block_due() const { return seen >= next_block_; }
  bool snapshot_due() const { return seen >= next_snapshot_; }
  double next_histograms() const { return histograms_at_; }  // the `time` of the next histograms
  // Ends a block, an eighth of a sample. True when the sample is complete; then call take_sample.
  bool end_block(const PressureSums &block);
  void take_sample(const Packing &now, const std::vector<double> &displacement);
  void take_histograms(const Packing &now);
  bool has_snapshots() const { return options_.snapshot_every > 0.0; }
  int64_t end_snapshot();  // the number of this snapshot, from 1
  // Sums of a block that the end of a call has cut; the next call continues the block.
  PressureSums left;

  const std::vector<Sample> &samples() const { return samples_; }
  const std::vector<int64_t> &collisions() const { return collisions_; }
  const std::vector<double> &travelled() const { return travel_; }
  const PairSums &pairs() const { return pairs_; }
  const Histogram &gaps() const { return gaps_; }
  const Histogram &correlation() const { return correlation_; }

 private:
  std::vector<double> between_walls(const Packing &p, const std::vector<double> &edge, bool of_contact,
                                    std::vector<double> pairs) const;
  std::vector<double> sample_gaps(const Packing &p) const;
  std::vector<double> sample_correlation(const Packing &p) const;
  static constexpr int blocks = SampleTuning::blocks;
  jam_observe_options options_;
  size_t dim_;
  double n_, momentum_kept_;
  int64_t next_block_, next_snapshot_, blocks_made_ = 0, snapshots_ = 0;
  double snapshot_at_ = 0.0, snapshot_step_;
  double sample_time_ = 0.0, histograms_at_ = std::numeric_limits<double>::infinity();
  std::vector<PressureSums> blocks_;
  std::vector<Sample> samples_;
  std::vector<int64_t> collisions_;
  std::vector<double> travel_;
  PairSums pairs_;
  Histogram gaps_, correlation_;
};

}  // namespace jam::inside
