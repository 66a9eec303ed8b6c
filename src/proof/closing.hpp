// Which contacts close together. Doubles cannot distinguish a gap of 1e-14 from a force of 1e-8; two doubles can.
#pragma once
#include "proof/scene.hpp"

namespace jam {

// Newton's steps and exchanges of contacts, until all that are listed close with positive forces and no other pair
// overlaps: the dual simplex method for the largest Gamma, in two doubles. Contacts that stay open leave the list,
// pairs of stable spheres that overlap enter it, and rattlers move out of overlaps. Forces of a new list are in the
// middle of all states of self-stress. False where nothing changes, or exchanges come to no end: then the scene is as
// it was.
bool exchange_contacts(ProofScene &scene);

}  // namespace jam
