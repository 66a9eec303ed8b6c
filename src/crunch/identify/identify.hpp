// Phase 3: which contacts carry force, their last digits, and the verdict.
//
//   active set of the LP -> closed contacts, balanced forces (polish) -> test of collective jamming -> jammed, or a
//   flex
//
// A flex is a motion that opens contacts: the packing is a saddle of the density. A decompression leads away from it.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

Phase identify(CrunchState &s);

}  // namespace jam::inside
