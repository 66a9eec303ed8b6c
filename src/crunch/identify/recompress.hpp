// Where a crunch ends at a packing that is not shown to be jammed, another approach may end at one that is.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

// Decompresses the packing, displaces every sphere at random within the room that this gives, and lets LPs and path
// begin again. Each time it decompresses farther, so that the packing ends near the first one. False where no
// decompression is left.
bool recompress(CrunchState &s);

}  // namespace jam::inside
