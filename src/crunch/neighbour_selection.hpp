// The pairs that the path lists: all within a reach, and for spheres that these do not hold on all sides, farther ones.
#pragma once
#include "core/packing.hpp"
#include "core/pairs.hpp"

namespace jam {

// All pairs with |r_ij| < reach + slope sigma_ij. A sphere that they leave room to run to one side gets a longer reach
// of its own, doubled until it has a cage or the reach is that of the farthest: in a mixture small spheres rattle in
// holes wider than the reach, and a barrier whose rows change as they cross their hole has no maximum to go to. Sorted
// as by find_pairs.
PairList select_neighbours(const Packing &p, double reach, double slope = 1.0);

}  // namespace jam
