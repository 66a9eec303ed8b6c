// The record that callbacks get, empty, and the time that is left of a call.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/math.hpp"
#include "core/tuning.hpp"
#include "jam/jam.h"

namespace jam::inside {

// The one place that makes a record: what a phase does not know is NaN.
inline jam_progress progress_of(int32_t phase) {
  jam_progress p{};
  p.struct_size = sizeof p;
  p.phase = phase;
  p.packing_fraction = p.pressure = p.gain = p.max_step = p.fraction = p.seconds_left = p.seconds_left_spread =
      std::numeric_limits<double>::quiet_NaN();
  return p;
}

// log(first / now) / log(first / end) of a number that goes from `first` to `end`, up or down; NaN where one of them is
// no number yet.
inline double log_share(double first, double now, double end) {
  if (!(first > 0.0 && now > 0.0 && end > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(end)) return 0.0;
  const double whole = math::log(first / end);
  return whole == 0.0 ? 1.0 : std::min(1.0, std::max(0.0, math::log(first / now) / whole));
}

// Keeps how the fraction of a call grew, and extrapolates it.
class TimeLeft {
 public:
  void begin() { count_ = 0, least_gap_ = 0.0, largest_ = std::numeric_limits<double>::quiet_NaN(); }
  // Completes p, whose `seconds` are set: its fraction never falls, and the time left follows from the rates at which
  // it grew over all the time, over the last half and over the last quarter of it. Their range is the spread.
  void complete(jam_progress &p) {
    if (largest_ > p.fraction || std::isnan(p.fraction)) p.fraction = largest_;
    if (std::isnan(p.fraction)) return;
    largest_ = p.fraction = std::min(1.0, std::max(0.0, p.fraction));
    keep(p.seconds, p.fraction);
    double least = std::numeric_limits<double>::infinity(), most = 0.0, recent = 0.0;
    const double first = seconds_[0], whole = p.seconds - first;
    if (count_ < TimeLeftTuning::fewest) return;
    for (const double part : {1.0, 0.5, 0.25}) {
      const size_t k = at(p.seconds - part * whole);
      const double gained = p.fraction - fraction_[k];
      if (!(gained > 0.0)) continue;
      const double left = (1.0 - p.fraction) * (p.seconds - seconds_[k]) / gained;
      least = std::min(least, left), most = std::max(most, left);
      if (part >= 0.5) recent = left;
    }
    if (!(most > 0.0)) return;
    p.seconds_left = recent > 0.0 ? recent : most;
    const bool unsteady = p.phase == JAM_PHASE_CRUNCH || p.phase == JAM_PHASE_POLISH;
    p.seconds_left_spread = (unsteady ? TimeLeftTuning::crunch : TimeLeftTuning::steady) *
                            std::max(most / p.seconds_left, p.seconds_left / least);
  }

 private:
  static constexpr size_t most_kept = TimeLeftTuning::most_kept;
  // The last record that is no later; the first one where none is.
  size_t at(double seconds) const {
    size_t k = 0;
    while (k + 1 < count_ && seconds_[k + 1] <= seconds) ++k;
    return k;
  }
  void keep(double seconds, double fraction) {
    if (count_ > 0 && seconds - seconds_[count_ - 1] < least_gap_) return;
    if (count_ == most_kept) {  // every second one stays
      for (size_t k = 0; k < most_kept / 2; ++k) seconds_[k] = seconds_[2 * k], fraction_[k] = fraction_[2 * k];
      count_ = most_kept / 2;
      least_gap_ = 2.0 * (seconds_[count_ - 1] - seconds_[0]) / most_kept;
    }
    seconds_[count_] = seconds, fraction_[count_++] = fraction;
  }
  std::array<double, most_kept> seconds_{}, fraction_{};
  size_t count_ = 0;
  double least_gap_ = 0.0, largest_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace jam::inside
