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

// Writes to out.flex and out.strain a motion of all nodes: x on the spheres of `sub` (empty: none of them moves), and
// each released sphere moved off its contacts, last released first. The motion is changed a little where that keeps
// contacts closed. Both stay empty if a contact would close faster than rounding allows, or by more than the widest
// contact with force is open.
void complete_flex(const RigidityMatrix &g, const RigidityMatrix &sub, const ConstraintRows &sub_rows,
                   const std::vector<double> &x, const std::vector<Release> &released, bool strain,
                   RigidityResult &out);

}  // namespace jam::inside
