// What is proved of a packing: that an exactly jammed one lies within a radius of it (existence), or that no motion
// without overlap leads away from it (trapping). Constants and proofs: bindings/docs/proof_theory.md.
//
//   scene -> Newton -> F, R, f -> [smallest singular value] -> existence -> open gaps
//                                                           -> trapping
//
// Every number in a Proof is rounded outward. All lengths are in the scene's unit.
#pragma once
#include "proof/normal_matrix.hpp"

namespace jam::inside {

enum class ProofCause { none = 0, excess = 1, force = 2, gap = 3, singular = 4, rattler = 5, images = 6, saddle = 7 };

struct Proof {
  bool exact = false, trapped = false;
  bool closed = false;                  // exact since all F_c are 0 as they stand: a crystal
  ProofCause cause = ProofCause::none;  // why it is not exact
  double cause_value = 0.0, cause_bound = 0.0;
  double radius = 0.0, gamma_radius = 0.0;       // of existence, in all unknowns and in Gamma
  double least_force = 0.0, force_radius = 0.0;  // over the mean force
  double least_gap = 0.0;                        // relative, of all pairs that are no contacts
  NormalMatrix::Bound bound;
  double inner = 0.0, outer = 0.0;  // no packing as dense between these distances
};

// The scene as refine() leaves it.
Proof prove(const ProofScene &scene, const ProofEquations &equations);

}  // namespace jam::inside
