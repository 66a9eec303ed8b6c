// Newton's steps towards the exactly jammed packing, on positions of two doubles.
#pragma once
#include "linalg/block_cholesky.hpp"
#include "proof/scene.hpp"

namespace jam::inside {

// M = R^T R of the rows of a proof, with the pinned sphere held, its factor, and a proved lower bound of the smallest
// singular value of R.

class NormalMatrix {
 public:
  NormalMatrix(const ProofScene &scene, const ProofEquations &equations);
  NormalMatrix(const NormalMatrix &) = delete;
  NormalMatrix &operator=(const NormalMatrix &) = delete;
  // False where R^T R is singular to rounding. The other functions need true.
  bool factorise();
  // v (nodes, dim) with R v nearest to y, refined to double precision; 0 at the pinned node.
  std::vector<double> nearest(const std::vector<double> &y) const;
  // f := the nearest to it with R^T f = 0, strict with R^T f = the gradient of log V.
  void project_on_balance(std::vector<double> &f) const;

  // The smallest eigenvalue of M is at least `singular`^2. A factorisation L L^T of M - mu without a lost pivot has
  // |M - mu - L L^T| <= gamma_(k + 4) |L| |L^T|, k the longest row of L (Higham, ch. 10), so that
  // eigenvalue >= mu - that error. 0 where no mu can be shown.
  struct Bound {
    double singular = 0.0;    // at or below the smallest singular value of the exact R
    double eigenvalue = 0.0;  // estimate of the smallest eigenvalue of M
    double rounding = 0.0;    // what the error bounds take off mu
  };
  Bound bound();

 private:
  double smallest_eigenvalue() const;
  void pin(std::vector<double> &v) const;
  double forming_error() const;
  const ProofScene &scene_;
  const ProofEquations &equations_;
  BlockMatrix m_;
  std::unique_ptr<ShiftedFactor> factor_;
};

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

// Crystals: contacts that close exactly at the written doubles, with more of them than unknowns.

// Whether one Gamma makes every F_c exactly 0 at the scene's centres, to the last bit. Then Gamma is that.
bool close_exactly(ProofScene &scene);
// Forces that are equal except for rounding become equal, so that those of a crystal balance exactly.
void equal_forces(ProofScene &scene);

// The proof of a network, in two doubles.

// What is proved of a packing: that an exactly jammed one lies within a radius of it (existence), or that no motion
// without overlap leads away from it (trapping). Constants and proofs: bindings/docs/proof_theory.md.
//
//   scene -> Newton -> F, R, f -> [smallest singular value] -> existence -> open gaps
//                                                           -> trapping
//
// Every number in a Proof is rounded outward. All lengths are in the scene's unit.
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

// Refines and tries to prove. If that fails, tries again with only the contacts that close together. On return `scene`
// is the one that was proved, or the last tried. False where rows are dependent and it is not refined.
bool find_proof(ProofScene &scene, ProofEquations &equations, Proof &proof);

// The equations and forces that balance where the contacts are. False where one of them would pull.
bool balance(ProofScene &scene, ProofEquations &equations);

}  // namespace jam::inside
