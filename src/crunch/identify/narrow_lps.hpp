// Narrow LPs find which contacts carry force when the tolerance of a wide LP hides a weak force or a narrow gap: the
// duality gap of an LP shrinks with its step bound. The bound follows the steps down to a motion whose square is
// rounding. No regularising diagonal is added: it would take the weak force of the third contact of a sphere between
// two nearly opposite ones.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

Phase narrow_lps(CrunchState &s);

}  // namespace jam::inside
