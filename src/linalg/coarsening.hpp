// Coarser graphs for the multilevel bisection.
#pragma once
#include "core/rng.hpp"
#include "linalg/graph.hpp"

namespace jam::inside {

// Joins pairs of neighbours along their heaviest free edge, in a random order of the nodes (G. Karypis and V. Kumar,
// SIAM J. Sci. Comput. 20, 359 (1998)). No node grows heavier than heaviest. parent[v]: the coarse node that holds v.
WeightedGraph coarsen(const WeightedGraph &fine, int32_t heaviest, Rng &rng, std::vector<int32_t> &parent);

}  // namespace jam::inside
