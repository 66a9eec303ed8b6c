// The barrier path: one interior-point method for the true, curved problem instead of one for each LP. After every
// Newton step the spheres move, the diameters grow, and the rows are computed again at the true distances; the
// multipliers stay. Every step is safe because the linearised set lies inside the true one. The barrier is the entropy
// of cell theory: this is a slower quench than sequential LPs and may end at another jamming point.
#pragma once
#include "crunch/crunch.hpp"
#include "linalg/newton_system.hpp"

namespace jam::inside {

struct BarrierPathControl {
  Tuning tuning;
  StrainBasis strain;      // that the path chooses; empty: a fixed cell
  PathPoint from;          // where a stopped path continues; mu 0: a new one
  double opening = 0.0;    // of a new one: the closest pair is opened to this relative gap at least
  double least_gap = 0.0;  // it ends at this duality gap, or at Tuning::path_end where that is larger
  int threads = 1;
  int64_t lps = 0;                          // solved before, for the progress
  std::function<double(double path)> done;  // part of the call that is done at this part of the path; may be empty
  std::function<void(double gap, size_t pairs, const PathPoint &at)> on_step;  // after every move; may be empty
};

struct BarrierPathResult {
  bool reached = false;  // it ended at its duality gap with balanced forces
  double gap = 0.0;
  int factorisations = 0;
  int increases = 0;        // of mu, at saddles
  Multipliers multipliers;  // of the last list
};

// Moves p towards its jamming point, always without overlap.
BarrierPathResult follow_barrier_path(Packing &p, const BarrierPathControl &control, NewtonSystem &system,
                                      Monitor &monitor);

// How mu changes along the barrier path: it falls where the barrier function is at its maximum, and rises at a saddle.
class BarrierSchedule {
 public:
  // What the last Newton step left.
  struct Step {
    double decrement;  // squared Newton decrement over mu at its start
    double part;       // of the whole Newton step that was taken
    double mu_ratio;   // the first mu over the present one
  };
  explicit BarrierSchedule(const Tuning &tuning) : t_(tuning) {}
  // Factor of mu before the next Newton step: 1; above 1 at a saddle; tuning.reduction at a saddle of the first mu,
  // which is the largest.
  double next_factor(const Step &last);
  // True where the maximum at mu counts as reached: mu then falls by tuning.reduction.
  bool centred(double decrement, double rows);
  int increases() const { return increases_; }

 private:
  const Tuning t_;
  double least_ = 0.0, mark_ = 0.0;  // lowest decrement at this mu; the one at which short steps began to count
  int steps_ = 0, short_steps_ = 0, increases_ = 0;
};

// The pairs that the barrier path lists: all within a reach, and farther ones for spheres that these leave uncovered.

// All pairs with |r_ij| < reach + slope sigma_ij. A sphere without neighbours in some direction gets a longer reach of
// its own, doubled until it is covered or the reach is tuning.farthest_reach. In a mixture small spheres rattle in
// holes wider than the reach; rows that come and go as they cross a hole leave the barrier without a maximum. Sorted as
// by find_pairs.
PairList select_neighbours(const Packing &p, double reach, double slope = 1.0, const Tuning &tuning = Tuning());

}  // namespace jam::inside
