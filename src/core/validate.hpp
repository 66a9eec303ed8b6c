// What every packing is, whatever made it. Entrances check it always; builds with JAM_CHECK_PAIRS, which are those of
// the tests under sanitizers, check it after every call that changes a handle.
#pragma once
#include "core/packing.hpp"

namespace jam::inside {

// Throws `code`, with a text that names the value at fault, unless lengths agree, positions lie in the brick of the
// cell, diameters are within the limits and velocities too. Overlaps are another question.
void check_packing(const Packing &p, jam_status code);

// Throws `code` where a sphere is wider than the shortest period: pairs are no longer searched beyond nearest images.
void refuse_wider_than_periods(const Packing &p, jam_status code);

}  // namespace jam::inside
