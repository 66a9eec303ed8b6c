#include "crunch/path/schedule.hpp"

#include <algorithm>
#include <limits>

namespace jam::inside {

// A saddle shows by steps that stay short while the decrement no longer falls. The first two steps at a new mu may be
// short in any case. At a larger mu the same distance takes fewer steps.
double BarrierSchedule::next_factor(const Step &last) {
  if (steps_ == 0) short_steps_ = 0, least_ = mark_ = std::numeric_limits<double>::infinity();
  const bool falls = last.decrement < InteriorPointTuning::progress * least_;
  if (steps_ > 0) {
    least_ = std::min(least_, last.decrement);
    if (last.decrement < t_.progress * mark_) short_steps_ = 0, mark_ = last.decrement;
  }
  if (steps_ > 2 && last.part < 0.5 && !falls) ++short_steps_;
  ++steps_;
  if (steps_ <= t_.max_steps_at_mu && short_steps_ < t_.max_short_steps) return 1.0;
  steps_ = 0;
  // Its part in Gamma is (1 - mu rows) log Gamma: at a large mu the function grows without bound as all spheres shrink.
  if (last.mu_ratio < t_.increase) return t_.reduction;
  ++increases_;
  return t_.increase;
}

bool BarrierSchedule::centred(double decrement, double rows) {
  if (!(decrement < t_.centred * rows)) return false;
  steps_ = 0;
  return true;
}

}  // namespace jam::inside
