// The last digits of a packing whose flexes the curvature of a round wall stabilises, with fewer contacts than one
// state of self-stress has otherwise: two disks in a circle, a zigzag in a tube. There forces balance at one place of a
// flex alone, and closing the contacts does not find it.
#pragma once
#include "core/packing.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

// Newton's method for all conditions of a maximum at once: forces balance, and contacts are closed. Small systems only,
// as the matrix is dense. False where it does not converge; p and net are as before then.
bool converge_at_curved_maximum(Packing &p, ContactNetwork &net);

}  // namespace jam::inside
