// Collectively jammed or not, from positions alone; and in a free cell strictly.
#pragma once
#include "crunch/state.hpp"

namespace jam {

// Closes the contacts and balances the forces, as far as they do. False when the call was interrupted.
bool polish_contacts(CrunchState &s);
// Tests the packing. LPs continue from a saddle; where contacts are undecided, narrow LPs follow.
Phase decide_jamming(CrunchState &s);
// Narrow LPs and moves along flexes belong to the optimum of the wide LPs. A looser tolerance may end before it.
bool converged(const CrunchState &s);

}  // namespace jam
