// The end of a crunch at a finite duality gap. On the path y c = mu for every row: a contact has much force and a small
// gap, another pair the reverse. The linear program at this point parts those in between, from the multipliers of the
// path in a few iterations. A curved path may still part some of them the other way: they are counted.
//
//   multipliers of the path -> LP -> contacts and forces -> forces that balance -> duality gap of these forces
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

// False where the forces of the LP do not balance or leave a larger gap than the options allow, or when interrupted.
bool ends_at_gap(CrunchState &s, const Multipliers &path);

}  // namespace jam::inside
