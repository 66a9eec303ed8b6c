// How mu changes along the barrier path: it falls where the barrier function is at its maximum, and rises at a saddle.
#pragma once
#include <limits>

#include "crunch/tuning.hpp"

namespace jam::inside {

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

}  // namespace jam::inside
