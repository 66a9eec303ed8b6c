// Which contacts close together. Doubles cannot distinguish a gap of 1e-14 from a force of 1e-8; two doubles can.
#pragma once
#include "proof/refined_lp.hpp"
#include "proof/scene.hpp"

namespace jam::inside {

// The dual simplex method for the largest Gamma, in two doubles: Newton's steps, and exchanges of contacts with gaps
// that stay for pairs that overlap, until all listed contacts close and no other pair of stable spheres overlaps.
// Forces may vanish. Where exchanges come to no end, LPs do the same (refined_lp.hpp), with rattlers in them.
// `endless`: these end neither, and the scene is as it was; lps, which may be NULL, says why.
enum class Exchange { endless, same, changed };
Exchange close_together(ProofScene &scene, LpsEnd *lps = nullptr);

// After close_together, where the contacts are closed: forces in the middle of all states of self-stress, on the
// contacts that have some; and rattlers move out of overlaps. `held`: the test of jamming finds these forces, and no
// flex. `unchanged`: there was no end, and the scene is as it was.
enum class Settled { unchanged, changed, held };
Settled finish_exchange(ProofScene &scene, Exchange end);

// Adds the forces of the contacts that close to a small part of those in the middle: pairs that are not quite closed
// carry little then, and a proof allows for their gaps.
void mix_in_forces_of_closed(ProofScene &settled, const ProofScene &closed);

}  // namespace jam::inside
