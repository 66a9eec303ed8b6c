// Overlaps before a verdict. Every test of jamming is of hard spheres, so diameters are reduced until none is left.
#pragma once
#include "core/packing.hpp"
#include "network/resolution.hpp"

namespace jam::inside {

struct TestedPacking {
  Packing packing;  // no pair overlaps
  GapResolution resolution;
  double nearest_gap = 0.0;  // of the diameters as given; infinite where no pair is near
  double diameter_factor = 1.0;
  bool overlapping = false;  // by more than rounding and digits: the packing is another one than the given one
};
// Fails with JAM_E_OVERLAP above one half of a contact distance.
TestedPacking without_overlaps(const Packing &p);

}  // namespace jam::inside
