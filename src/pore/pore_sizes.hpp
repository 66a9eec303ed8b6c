// The largest spheres that fit into the pores.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/packing.hpp"

namespace jam::inside {

// A row for each of `points` random points of the void (JAM_PORE_X ...). The largest sphere that contains a point and
// no solid is one of finitely many, and all of them are tried: those that touch d + 1 surfaces; d surfaces and the
// point; in d = 3 also d - 1 surfaces and the point, with the centre in the plane of these three. A round wall adds
// spheres that touch one surface less.
void check_pore_points(const Packing &p, int64_t points);
std::vector<std::array<double, 5>> pore_sizes(const Packing &p, int64_t points, int64_t seed);

}  // namespace jam::inside
