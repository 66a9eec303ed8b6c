// The length of trial steps at which a wanted share is accepted, from a preliminary run of its own stream.
#pragma once
#include <vector>

#include "core/archive.hpp"
#include "core/monitor.hpp"
#include "core/packing.hpp"

namespace jam::inside {

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

}  // namespace jam::inside
