// Phase 2: the barrier path, from the LP before it to the LPs after it.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

Phase follow_path(CrunchState &s);

}  // namespace jam::inside
