#include "proof/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "core/pair_rule.hpp"
#include "proof/closing.hpp"
#include "proof/free_rattler.hpp"
#include "proof/implied.hpp"
#include "proof/newton.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

// Forces that balance where the contacts are: steps to the least gaps would spread those of pairs that are not quite
// closed over all.
bool balance(ProofScene &s, ProofEquations &e) {
  e = evaluate(s);
  NormalMatrix normal(s, e);
  if (!normal.factorise()) return false;
  refine_forces(s, e, normal);
  return *std::min_element(s.force.begin(), s.force.end()) > 0.0;
}

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
  const Settled end = settle_exchange(other, exchanged);
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
  lean_on_closed(other, closed);
  if (!balance(other, there)) return refined;
  proof = prove(other, there), scene = std::move(other), equations = std::move(there);
  return true;
}

// Contacts with weak forces that do not close together: the two numbers are the least force and the widest gap.
void name_saddle(const ProofScene &s, const ProofEquations &e, Proof &proof) {
  if (proof.cause != ProofCause::excess || !(proof.least_force < proof_tuning::weak)) return;
  double widest = 0.0;
  for (size_t c = 0; c < s.contacts(); ++c)
    widest = std::max(widest, 0.5 * std::fabs(e.f[c]) / (e.sigma2[c] * s.gamma));
  if (!(widest > proof_tuning::nearly_closed)) return;
  proof.cause = ProofCause::saddle, proof.cause_value = proof.least_force, proof.cause_bound = widest;
}

// The cause where nothing is proved and spheres touch their own images, whether a network lists them or not.
void name_images(const ProofScene &s, Proof &proof) {
  const double widest = *std::max_element(s.ratio.begin(), s.ratio.end()), apart = s.cell.shortest();
  if (!shown(proof) && s.gamma * widest * widest > (1.0 - contact_gap_limit) * apart * apart)
    proof.cause = ProofCause::images, proof.cause_value = 1.0, proof.cause_bound = 0.0;
}

}  // namespace

bool find_proof(ProofScene &scene, ProofEquations &equations, Proof &proof) {
  const bool refined = search_proof(scene, equations, proof);
  name_images(scene, proof);
  if (refined && !shown(proof) && !scene.strict) name_saddle(scene, equations, proof);
  return refined;
}

void decide_by_proof(const Packing &p, PackingVerdict &verdict) {
  RigidityResult &r = verdict.result;
  if (r.jammed != Verdict::undecided || r.contacts == 0 || p.model != JAM_MODEL_EUCLID) return;
  const ContactNetwork network = verdict.carrying(p.dim);
  if (!(*std::min_element(network.force.begin(), network.force.end()) > 0.0)) return;
  ProofScene scene = scene_of_contacts(p, network, {});
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

namespace {

// The contacts of a scene, at the positions of the packing that it came from.
ContactNetwork network_of(const ProofScene &s, const Packing &p) {
  const size_t d = static_cast<size_t>(s.dim);
  std::vector<size_t> order(s.contacts());
  std::vector<int32_t> i(order.size()), j(order.size());
  for (size_t c = 0; c < order.size(); ++c) {
    order[c] = c, i[c] = s.sphere[s.a[c]], j[c] = s.sphere[s.b[c]];
  }
  const auto key = [&](size_t c) { return std::minmax(i[c], j[c]); };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
  ContactNetwork net;
  net.coordination.assign(p.n(), 0);
  double mean = 0.0;
  for (const size_t c : order) {
    const double sign = i[c] < j[c] ? 1.0 : -1.0;
    net.pairs.i.push_back(std::min(i[c], j[c])), net.pairs.j.push_back(std::max(i[c], j[c]));
    for (size_t k = 0; k < d; ++k) {
      double offset = 0.0;
      for (size_t q = k; q < d; ++q) offset += sign * s.image[c * d + q] * p.cell.row(static_cast<int>(q))[k];
      net.pairs.offset.push_back(offset);
    }
    ++net.coordination[i[c]], ++net.coordination[j[c]];
    net.force.push_back(s.force[c] * contact_distance(p, i[c], j[c]));
  }
  measure_contacts(p, net);
  // Forces of the scene are in units of |r|, which differs from the contact distance where contacts are open.
  for (size_t k = 0; k < net.size(); ++k) {
    net.force[k] *= 1.0 + net.gap[k];
    mean += net.force[k] / static_cast<double>(net.size());
  }
  for (double &f : net.force) f /= mean;
  set_force_scale(p, net);
  return net;
}

// Forces of the scene balance at its refined positions. Those of the packing are as far away as its contacts were open,
// so that forces are balanced there again. False where one of them would pull.
bool balance_at_positions(const Packing &p, ContactNetwork &net) {
  ProofScene s = scene_of_contacts(p, net, {});
  ProofEquations e;
  if (!balance(s, e)) return false;
  net = network_of(s, p);
  return true;
}

void take_network(ContactNetwork net, const Packing &p, PackingVerdict &verdict) {
  RigidityResult &r = verdict.result;
  verdict.contacts = std::move(net);
  const RigidityMatrix g = make_rigidity_matrix(p, verdict.contacts);
  verdict.sphere = g.sphere;
  r.carrying.assign(g.contacts(), 1), r.force = verdict.contacts.force;
  r.force_residual = balance_residual(g, r.force.data());
  r.spheres = g.nodes, r.contacts = static_cast<int64_t>(g.contacts()), r.zero_force_contacts = 0;
  r.contacts_needed = isostatic_contacts(g.nodes, g.dim, p.container);
  r.self_stresses = r.contacts - (r.contacts_needed - 1);
  r.undercoordinated = std::count_if(verdict.contacts.coordination.begin(), verdict.contacts.coordination.end(),
                                     [&](int32_t z) { return z > 0 && z <= g.dim; });
}

std::string words_of(LpsEnd end) {
  const std::string lps = "; linear programs in two doubles might close other contacts, but ";
  if (end == LpsEnd::without_clp) return lps + "need Clp, which this build lacks";
  if (end == LpsEnd::too_many_rows)
    return lps + "more than " + std::to_string(proof_tuning::largest_lp) + " pairs are near contact";
  return end == LpsEnd::no_end ? "; exchanges of contacts and linear programs in two doubles come to no end" : "";
}

bool proves(ProofScene &s) {
  ProofEquations e;
  if (!refine(s, e)) return false;
  const Proof proof = prove(s, e);
  return proof.trapped || proof.exact;
}

}  // namespace

void confirm_by_exchange(const Packing &p, PackingVerdict &verdict) {
  const RigidityResult &r = verdict.result;
  if (r.jammed != Verdict::yes || r.contacts <= r.contacts_needed || p.model != JAM_MODEL_EUCLID || p.container) return;
  const ContactNetwork network = verdict.carrying(p.dim);
  if (!(*std::min_element(network.force.begin(), network.force.end()) < proof_tuning::weak)) return;
  ProofScene as_listed = scene_of_contacts(p, network, {}), closing = as_listed;
  if (as_listed.own_images || proves(as_listed)) return;
  LpsEnd lps = LpsEnd::closed;
  const Exchange end = close_together(closing, &lps);
  const Settled found = settle_exchange(closing, end);
  if (found == Settled::held || (found == Settled::changed && proves(closing))) {
    ContactNetwork net = network_of(closing, p);
    if (balance_at_positions(p, net)) take_network(std::move(net), p, verdict);
  } else {
    verdict.result.jammed = verdict.when_closed = Verdict::undecided;
    verdict.unresolved = *std::min_element(network.force.begin(), network.force.end());
    verdict.unresolved_because = words_of(lps);
  }
}

}  // namespace jam::inside
