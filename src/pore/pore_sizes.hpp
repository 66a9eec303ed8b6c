// The largest spheres that fit into the pores.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/packing.hpp"

namespace jam::inside {

// A row for each of `points` random points of the void (JAM_PORE_X ...). Exact: the largest sphere that contains a
// point and touches no solid is found among the spheres that touch d + 1 surfaces, or d (d = 3: or d - 1, in a plane
// with the point) and the point itself.
void check_pore_points(const Packing &p, int64_t points);
std::vector<std::array<double, 5>> pore_sizes(const Packing &p, int64_t points, int64_t seed);

}  // namespace jam::inside
