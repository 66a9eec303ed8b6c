// Jammed where doubles leave it open: trapping, in two doubles.
#pragma once
#include "network/rigidity_test.hpp"

namespace jam {

// An undecided test of collective jamming whose contacts carry force: where theorem.hpp proves that its spheres are
// trapped, it becomes a yes. Soft modes that doubles cannot tell from flexes are decided so.
void decide_by_proof(const Packing &p, PackingVerdict &verdict);

}  // namespace jam
