// Newton's steps towards the exactly jammed packing, on positions of two doubles.
#pragma once
#include "proof/normal_matrix.hpp"

namespace jam::inside {

// The step J u = -F from the scene's numbers, J = [R, -sigma^2]: v (ends, dim) and that of Gamma. With one state of
// self-stress f it solves all equations; with more of them it solves them as nearly as it can.
struct NewtonStep {
  std::vector<double> v;
  double gamma = 0.0;
};
NewtonStep newton_step(const ProofScene &scene, const ProofEquations &equations, const NormalMatrix &normal);
// Adds it to positions and Gamma of the scene, in two doubles. Rattlers stay.
void take_step(ProofScene &scene, const NewtonStep &step);

// The part of the forces with R^T f = 0, scaled to sum f sigma^2 = 1; strict with R^T f = the gradient of log V.
void refine_forces(ProofScene &scene, const ProofEquations &equations, const NormalMatrix &normal);

// Newton's steps until |F| stops falling, whether or not it can become 0. False where rows are dependent.
bool approach_closure(ProofScene &scene, ProofEquations &equations);

// Newton's steps until |F| stops falling. Returns the equations at the end; forces are refined too. A packing whose
// rows are dependent is left as it is: false.
bool refine(ProofScene &scene, ProofEquations &equations);

}  // namespace jam::inside
