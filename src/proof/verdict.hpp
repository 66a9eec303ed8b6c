// Jammed where doubles leave it open: trapping, in two doubles.
#pragma once
#include "network/rigidity_test.hpp"
#include "proof/theorem.hpp"

namespace jam::inside {

// Refines the scene and proves what it can; where that is nothing, of the contacts that close together. The scene is
// then the one that was proved, or where nothing is, that of contacts that close and hold their spheres: the checker's
// norm may trap them. False where rows are dependent and it is not refined.
bool find_proof(ProofScene &scene, ProofEquations &equations, Proof &proof);

// An undecided test of collective jamming whose contacts carry force: where theorem.hpp proves that its spheres are
// trapped, it becomes a yes. Soft modes that doubles cannot tell from flexes are decided so.
void decide_by_proof(const Packing &p, PackingVerdict &verdict);

// A yes of the test that rests on weak forces, of more contacts than one state of self-stress has. Doubles cannot
// distinguish such forces from gaps. Where contacts do not all close, the network of those that close together, and
// hold their spheres, takes its place. Where they do not hold them, or exchanges come to no end, nothing is decided: a
// saddle, as far as two doubles show.
void confirm_by_exchange(const Packing &p, PackingVerdict &verdict);

}  // namespace jam::inside
