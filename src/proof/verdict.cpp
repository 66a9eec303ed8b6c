#include "proof/verdict.hpp"

#include <algorithm>

#include "proof/newton.hpp"
#include "proof/theorem.hpp"

namespace jam {

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
