// The proof of a network, in two doubles.
#pragma once
#include "proof/theorem.hpp"

namespace jam::inside {

// Refines and tries to prove. If that fails, tries again with only the contacts that close together. On return `scene`
// is the one that was proved, or the last tried. False where rows are dependent and it is not refined.
bool find_proof(ProofScene &scene, ProofEquations &equations, Proof &proof);

// The equations and forces that balance where the contacts are. False where one of them would pull.
bool balance(ProofScene &scene, ProofEquations &equations);

}  // namespace jam::inside
