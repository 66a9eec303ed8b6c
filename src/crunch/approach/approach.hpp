// Phase 1: sequential LPs. Each LP maximises Gamma over displacements within a bound; the spheres move, and
// the pairs are listed again (Artiaco et al., Phys. Rev. E 106, 055310 (2022)).
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

Phase approach(CrunchState &s);

}  // namespace jam::inside
