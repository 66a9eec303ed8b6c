// Newton's steps towards the exactly jammed packing, on positions of two doubles.
#pragma once
#include "proof/normal_matrix.hpp"

namespace jam {

// The step J u = -F from the scene's numbers, J = [R, -sigma^2]: v (nodes, dim) and that of Gamma. With one state of
// self-stress f it solves all equations; with more of them it solves them as nearly as it can.
struct NewtonStep {
  std::vector<double> v;
  double gamma = 0.0;
};
NewtonStep newton_step(const ProofScene &scene, const ProofEquations &equations, const NormalMatrix &normal);
// Adds it to positions and Gamma of the scene, in two doubles. Rattlers stay.
void take_step(ProofScene &scene, const NewtonStep &step);

// Newton's steps until |F| stops falling. Returns the equations at the end; forces are refined too. A packing whose
// rows are dependent is left as it is: false.
bool refine(ProofScene &scene, ProofEquations &equations);

}  // namespace jam
