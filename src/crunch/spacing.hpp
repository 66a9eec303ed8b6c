// How far a packing is from jamming.
#pragma once
#include <vector>

#include "core/packing.hpp"
#include "core/pairs.hpp"

namespace jam::inside {

// Packing fraction of random jammed packings: 0.84 in d = 2, about 0.64 * 0.7^(d-3) above.
double jammed_fraction(int dim);
// By how much the mean spacing of spheres, phi^(-1/d) diameters, exceeds that of a random jammed packing: how far a
// sphere may have to travel. 0 when denser.
double free_spacing(const Packing &p);
// h = r / sigma - 1 of each pair.
std::vector<double> relative_gaps(const Packing &p, const PairList &pairs);
// Median gap of the d n nearest pairs, the contacts to be; 0.5 when there are not as many.
double contact_gap(const Packing &p);

}  // namespace jam::inside
