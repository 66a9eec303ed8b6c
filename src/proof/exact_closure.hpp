// Crystals: contacts that close exactly at the written doubles, with more of them than unknowns.
#pragma once
#include "proof/scene.hpp"

namespace jam::inside {

// Whether one Gamma makes every F_c exactly 0 at the scene's centres, to the last bit. Then Gamma is that.
bool close_exactly(ProofScene &scene);
// Forces that are equal except for rounding become equal, so that those of a crystal balance exactly.
void equal_forces(ProofScene &scene);

}  // namespace jam::inside
