// The pairs that the barrier path lists: all within a reach, and farther ones for spheres that these leave uncovered.
#pragma once
#include "core/packing.hpp"
#include "core/pairs.hpp"
#include "crunch/tuning.hpp"

namespace jam::inside {

// All pairs with |r_ij| < reach + slope sigma_ij. A sphere without neighbours in some direction gets a longer reach of
// its own, doubled until it is covered or the reach is tuning.farthest_reach. In a mixture small spheres rattle in
// holes wider than the reach; rows that come and go as they cross a hole leave the barrier without a maximum. Sorted as
// by find_pairs.
PairList select_neighbours(const Packing &p, double reach, double slope = 1.0, const Tuning &tuning = Tuning());

}  // namespace jam::inside
