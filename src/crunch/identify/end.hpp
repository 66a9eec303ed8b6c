// How a crunch ends: collectively jammed or not, from positions alone; and in a free cell strictly.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

// Closes the contacts and balances the forces, as far as they do. False when the call was interrupted.
bool polish_contacts(CrunchState &s);
// Tests the packing. Where it is not shown to be jammed narrow LPs follow, then a decompression.
Phase decide_jamming(CrunchState &s);
// Ends the crunch with its verdict, the one that jam_rigidity would return. of_contacts: the test of its contacts, or
// nothing.
Phase give_verdict(CrunchState &s, const PackingVerdict &of_contacts);
// Narrow LPs and decompressions belong to the optimum of the wide LPs. A looser tolerance may end before it.
bool converged(const CrunchState &s);

}  // namespace jam::inside
