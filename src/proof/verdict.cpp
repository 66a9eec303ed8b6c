#include "proof/verdict.hpp"

#include <algorithm>

#include "proof/closing.hpp"
#include "proof/newton.hpp"

namespace jam {

bool find_proof(ProofScene &scene, ProofEquations &equations, Proof &proof) {
  ProofScene other = scene;
  const bool refined = refine(scene, equations);
  proof = refined ? prove(scene, equations) : Proof{};
  if (!refined) proof.cause = ProofCause::singular;
  ProofEquations there;
  if (proof.exact || proof.trapped || scene.strict || !exchange_contacts(other) || !refine(other, there))
    return refined;
  const Proof again = prove(other, there);
  if (!again.exact && !again.trapped) return refined;
  proof = again, scene = std::move(other), equations = std::move(there);
  return true;
}

void decide_by_proof(const Packing &p, PackingVerdict &verdict) {
  RigidityResult &r = verdict.result;
  if (r.jammed != Verdict::undecided || r.contacts == 0 || p.model != JAM_MODEL_EUCLID) return;
  const ContactNetwork network = verdict.carrying(p.dim);
  if (!(*std::min_element(network.force.begin(), network.force.end()) > 0.0)) return;
  ProofScene scene = make_proof_scene(p, network, {});
  ProofEquations equations;
  if (!refine(scene, equations)) return;
  const Proof proof = prove(scene, equations);
  if (!proof.trapped && !proof.exact) return;
  r.jammed = r.stressed = Verdict::yes;
  r.self_stresses -= r.flexes;
  r.flexes = 0;
  r.flex.clear(), r.attempt.clear();
  // R has rows 2 r_c.
  double length2 = 0.0;
  for (const double sigma2 : equations.sigma2) length2 += 4.0 * scene.gamma * sigma2;
  r.margin = proof.bound.eigenvalue * static_cast<double>(scene.contacts()) / length2;
  verdict.when_closed = Verdict::yes;
}

}  // namespace jam
