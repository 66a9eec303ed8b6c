// Rattlers that overlap, in two doubles: a place is free where a proof may put them.
#pragma once
#include "proof/open_gaps.hpp"

namespace jam::inside {

// A rattler that overlaps moves to where all pairs that it nearly touches are open. Its cage may be far narrower than
// the overlap. pairs: near_pairs of the scene. False where no such place is found; then it overlaps as little as it
// can: a sphere that just fits touches others, and rounding is what stays of its overlap.
bool free_rattler(ProofScene &scene, int32_t i, const std::vector<NearPair> &pairs);

// All of them; whether one moved.
bool free_rattlers(ProofScene &scene);

}  // namespace jam::inside
