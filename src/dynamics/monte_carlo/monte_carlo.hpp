// Metropolis Monte Carlo of hard spheres and of soft ones at a temperature, at constant volume.
//
// Numbers. Coordinates are integers with 2^64 to each cell vector, so that differences wrap by themselves and moving
// there and back gives the same bits. Distances and energies are doubles. A large cube has one image of each pair in
// reach; geometry.hpp has the other cells, and small ones with several images.
//
// Lists. Each sphere lists those within the longest contact distance and a skin. Lists hold until a sphere has moved by
// half the skin; then all are made again from cells. Dilute hard spheres take such long steps that lists would hold for
// no sweep: they search cells instead. Both give the same bits. Sizes that differ much have cells by level.
//
// A sweep is one trial of each sphere in the order of their numbers. Every single trial keeps the Boltzmann
// distribution, so a sweep does. Random numbers are a function of (seed, run, sweep, sphere).
#pragma once
#include "dynamics/dynamics.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

// The length of trial steps at which a wanted share is accepted, from a preliminary run of its own stream.

// A tuning that several calls may share: what a call that must stop leaves is kept as bytes, which are copied and
// stored with the run. It ends at the same bits. The packing stays.
class StepTuner {
 public:
  // Sets o.step, in mean diameters, for the acceptance o.acceptance; false: the call must stop before it. A call makes
  // one sweep at least, so that calls of any length come to the end.
  bool tune(const Packing &p, jam_monte_carlo_options &o, Monitor &monitor);
  // Of the packing and options that tune() is called with: bytes of a file are tried.
  void archive(Archive &a, const Packing &p, const jam_monte_carlo_options &o);

 private:
  std::vector<char> left_;  // empty: not begun, or at its end
};

struct MonteCarloCounts {
  int64_t moves = 0, moved = 0, swaps = 0, swapped = 0;
  double acceptance() const { return share(moved, moves); }
  double swap_acceptance() const { return share(swapped, swaps); }

 private:
  static double share(int64_t part, int64_t all) {
    return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : std::numeric_limits<double>::quiet_NaN();
  }
};

class MonteCarlo {
 public:
  virtual ~MonteCarlo() = default;
  virtual void sweep(int64_t number) = 0;
  virtual void set_step(double step) = 0;  // half side of the cube of trial displacements, unit of the box side
  virtual double energy() const = 0;       // U, recomputed
  // Sum over pairs of r f (soft), unit of energy.
  virtual double virial() const = 0;
  // Pairs by gap h < h_max, `bins` equal bins: hard spheres' pressure comes from the density at h = 0.
  virtual void count_gaps(double h_max, std::vector<double> &bins) = 0;
  virtual double gap_range() const = 0;  // the largest h_max
  virtual void write_state(Packing &p) const = 0;
  virtual const std::vector<double> &displacement() const = 0;  // (n, d) since the beginning, unit of the box side
  virtual void archive(Archive &a) = 0;
  MonteCarloCounts counts;
};

// step in mean diameters, as in the options.
std::unique_ptr<MonteCarlo> make_monte_carlo(const Packing &p, const jam_monte_carlo_options &o, int64_t run);

jam_monte_carlo_options default_monte_carlo_options();
// Throw naming the value; the packing must suit: no Mari-Kurchan shifts.
void check_monte_carlo_options(const jam_monte_carlo_options &o);
void check_monte_carlo(const Packing &p, const jam_monte_carlo_options &o);

// A larger step, in mean diameters, could be longer than half a cell vector.
double largest_monte_carlo_step(const Packing &p);

// Means over a run and their errors, from energies and virials or gaps of its blocks.
class MonteCarloMeans {
 public:
  MonteCarloMeans(const Packing &p, const jam_monte_carlo_options &o);
  void sample(MonteCarlo &mc);
  void give(jam_monte_carlo_report &report) const;
  void archive(Archive &a);

 private:
  static constexpr size_t bins = SampleTuning::gap_bins;  // checkpoints hold so many
  void give_hard(jam_monte_carlo_report &report) const;
  double n_, dim_, temperature_;
  bool hard_;
  double h_max_ = 0.0;
  std::vector<double> energy_, pressure_;  // soft: one a sample
  std::vector<double> gaps_;               // hard: (samples, bins)
};

// A Monte Carlo run in progress. Per particle, the limits count sweeps since it began.
class MonteCarloRun final : public Dynamics {
 public:
  MonteCarloRun(const Packing &p, const jam_monte_carlo_options &o);
  MonteCarloRun(const Packing &p, Archive &from);

  int32_t phase() const override { return JAM_PHASE_MONTE_CARLO; }
  jam_status run(const Limits &limits, const Listeners &listeners) override;
  const Packing &packing() const override { return p_; }
  Packing current() const override;
  void archive(Archive &a) override;
  jam_monte_carlo_report report() const;
  // To resume: options that are neither the defaults nor those of the run are refused by name, but sweeps and
  // wall_time.
  void check_resumed(const jam_monte_carlo_options &o) const;
  bool begun() const { return engine_ != nullptr; }

 private:
  bool begin(Monitor &monitor);
  void take_displacement(Observer *observer);
  Packing p_;
  jam_monte_carlo_options options_;
  StepTuner tuner_;
  std::unique_ptr<MonteCarlo> engine_;  // made by the first run, which may be stopped meanwhile
  MonteCarloMeans means_;
  std::vector<double> seen_;  // displacement that observers have
  int64_t done_ = 0;
  int32_t stop_reason_ = JAM_STOP_NONE;
  double seconds_ = 0.0, trials_ = 0.0;  // of the last call
};

}  // namespace jam::inside
