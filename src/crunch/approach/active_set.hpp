// Which rows of an LP carry force, and which spheres they touch.
#pragma once
#include <cstdint>
#include <vector>

#include "core/packing.hpp"
#include "crunch/tuning.hpp"
#include "lp/packing_lp.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

struct ActiveSet {
  std::vector<size_t> rows;           // indices into the LP's pairs, ascending
  std::vector<int32_t> coordination;  // n
  int64_t stable = 0;                 // spheres with a force
};

// One flag a row: it carries force, or its slack is below `closed`.
std::vector<char> force_carrying(const PackingLp &lp, const LpSolution &answer, double closed);
ActiveSet find_active_set(const PackingLp &lp, const LpSolution &answer, double closed);
// Largest |s| over spheres with a force, their mean taken out along all axes but those closed by walls (bits); over all
// spheres if no sphere has one.
double largest_step(const LpSolution &answer, const ActiveSet &active, int dim, uint32_t closed_axes = 0);
// The active rows as contacts of p: unit vectors, gaps, forces from the multipliers.
ContactNetwork make_contacts(const Packing &p, const PairList &pairs, const LpSolution &answer,
                             const ActiveSet &active);
// True when more rows carry force than one state of self-stress has: a crystal in the making, whose path meets one
// saddle after the other. y: multipliers, sum 1; isostatic: d n.
bool hyperstatic(const std::vector<double> &y, double isostatic, const Tuning &tuning);

}  // namespace jam::inside
