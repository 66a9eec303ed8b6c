// Where digits leave it open whether the contacts hold the spheres, another approach may end at contacts that do.
#pragma once
#include "crunch/state.hpp"

namespace jam {

// Decompresses the packing, displaces every sphere at random within the room that this gives, and lets LPs and path
// begin again. Each time it decompresses farther, since the nearest jammed packing is wanted. False where no
// decompression is left.
bool recompress(CrunchState &s);

}  // namespace jam
