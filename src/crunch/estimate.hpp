// What a crunch will cost, from the particle graph and its elimination tree alone.
#pragma once
#include "core/packing.hpp"
#include "jam/jam.h"

namespace jam::inside {

// Memory and work of a crunch before it runs. Throws for bad options.
[[gnu::cold]] jam_estimate_report estimate(const Packing &start, const jam_crunch_options &o);

}  // namespace jam::inside
