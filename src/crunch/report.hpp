// The report of a crunch: its end, and what it did to the packing that it was given.
#pragma once
#include <map>
#include <utility>

#include "crunch/state.hpp"

namespace jam::inside {

// Closed pairs of the start as in the test of jamming, and those that digits cannot distinguish from them. Found before
// the work: after it the time of the call may be over.
struct Touching {
  std::map<std::pair<int32_t, int32_t>, int64_t> images;  // that touch, of each pair
  int64_t total = -1;                                     // -1: not known, as the call was stopped
};
Touching find_touching(const Packing &start);

// The final network certified, the verdict and the counters of the work.
void report_end(CrunchState &s);
// Out of memory, or no LP solved: the state is the last good one, without contacts. It allocates only what it must.
void report_failure(CrunchState &s);
// What the crunch did to the packing that it was given.
void report_changes(Touching start, double packing_fraction_start, CrunchState &s);

}  // namespace jam::inside
