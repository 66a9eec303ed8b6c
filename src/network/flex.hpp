// The motion that shows that spheres are not held: of all nodes, from one of those that could be held.
#pragma once
#include <vector>

#include "network/constraint_rows.hpp"
#include "network/rattlers.hpp"
#include "network/rigidity_test.hpp"

namespace jam::inside {

// Whether a motion, of this flex and strain (empty without one), overlaps at no contact beyond rounding. gap: what
// contacts are open by; empty: nothing.
bool keeps_contacts(const RigidityMatrix &g, const std::vector<double> &gap, const std::vector<double> &flex,
                    const std::vector<double> &strain);

// x: a motion of the rows of `sub`, spheres that their contacts might hold; empty where there are none. Each released
// sphere, the last one first, moves out of the way of its contacts. Into out.flex and out.strain, changed a little
// where that keeps contacts closed. They stay empty where the motion closes contacts at more than the rate of rounding,
// or one by more than the widest of them is open.
void complete_flex(const RigidityMatrix &g, const RigidityMatrix &sub, const ConstraintRows &sub_rows,
                   const std::vector<double> &x, const std::vector<Release> &released, bool strain,
                   RigidityResult &out);

}  // namespace jam::inside
