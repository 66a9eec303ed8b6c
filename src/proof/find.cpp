#include "proof/find.hpp"

#include <algorithm>
#include <cmath>

#include "network/resolution.hpp"
#include "proof/closing.hpp"
#include "proof/free_rattler.hpp"
#include "proof/implied.hpp"
#include "proof/newton.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

bool shown(const Proof &proof) { return proof.exact || proof.trapped; }

// As find_proof, without the cause of a saddle.
bool search_proof(ProofScene &scene, ProofEquations &equations, Proof &proof) {
  ProofScene other = scene;
  const bool refined = refine(scene, equations);
  if (refined) free_rattlers(scene);  // an overlap of one would widen the trap of all
  proof = refined ? prove(scene, equations) : Proof{};
  if (!refined) proof.cause = ProofCause::singular;
  if (!refined && scene.contacts() < static_cast<size_t>(scene.needed())) {  // their rows are no square
    proof.cause = ProofCause::excess, proof.cause_value = static_cast<double>(scene.contacts());
    proof.cause_bound = static_cast<double>(scene.needed());
  }
  if (shown(proof) || scene.strict || scene.contacts() == 0) return refined;
  const Exchange exchanged = close_together(other);
  const ProofScene closed = other;
  const Settled end = finish_exchange(other, exchanged);
  if (end == Settled::unchanged) return refined;
  ProofScene settled = other;
  ProofEquations there;
  settled.implied = find_implied(settled);
  if (refine(settled, there)) {
    const Proof again = prove(settled, there);
    if (shown(again)) {
      proof = again, scene = std::move(settled), equations = std::move(there);
      return true;
    }
  }
  if (end != Settled::held) return refined;
  mix_in_forces_of_closed(other, closed);
  if (!balance(other, there)) return refined;
  proof = prove(other, there), scene = std::move(other), equations = std::move(there);
  return true;
}

// Contacts with weak forces that do not close together: the two numbers are the least force and the widest gap.
void name_saddle(const ProofScene &s, const ProofEquations &e, Proof &proof) {
  if (proof.cause != ProofCause::excess || !(proof.least_force < proof_tuning::weak)) return;
  double widest = 0.0;
  for (size_t c = 0; c < s.contacts(); ++c)
    widest = std::max(widest, 0.5 * std::fabs(e.f[c]) / (e.sigma2[c] * s.gamma()));
  if (!(widest > proof_tuning::nearly_closed)) return;
  proof.cause = ProofCause::saddle, proof.cause_value = proof.least_force, proof.cause_bound = widest;
}

// The cause where nothing is proved and spheres touch their own images, whether a network lists them or not.
void name_images(const ProofScene &s, Proof &proof) {
  const double widest = *std::max_element(s.ratio.begin(), s.ratio.end()), apart = s.shortest_period();
  if (!shown(proof) && s.gamma() * widest * widest > (1.0 - contact_gap_limit) * apart * apart)
    proof.cause = ProofCause::images, proof.cause_value = 1.0, proof.cause_bound = 0.0;
}

}  // namespace

// Steps to the least gaps would spread those of pairs that are not quite closed over all.
bool balance(ProofScene &s, ProofEquations &e) {
  e = evaluate(s);
  NormalMatrix normal(s, e);
  if (!normal.factorise()) return false;
  refine_forces(s, e, normal);
  return *std::min_element(s.force.begin(), s.force.end()) > 0.0;
}

bool find_proof(ProofScene &scene, ProofEquations &equations, Proof &proof) {
  const bool refined = search_proof(scene, equations, proof);
  name_images(scene, proof);
  if (refined && !shown(proof) && !scene.strict) name_saddle(scene, equations, proof);
  return refined;
}

}  // namespace jam::inside
