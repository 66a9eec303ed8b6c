// What two doubles add to the test of doubles.
#include <algorithm>

#include "core/pair_rule.hpp"
#include "proof/closing.hpp"
#include "proof/newton.hpp"
#include "proof/tuning.hpp"
#include "verdict/verdict.hpp"

namespace jam::inside {
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

void replace_network(ContactNetwork net, const Packing &p, PackingVerdict &verdict) {
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

// Proofs are for spheres of a periodic cell in the collective test, without Mari-Kurchan shifts.
bool may_be_proved(const JammingCase &c) {
  return c.kind == Jamming::collective && c.p.model == JAM_MODEL_EUCLID && !c.p.container;
}

}  // namespace

Says raise_if_trapped(JammingCase &c) {
  RigidityResult &r = c.v.result;
  if (c.v.jammed != Verdict::undecided || r.contacts == 0 || !may_be_proved(c)) return {};
  const ContactNetwork network = c.v.carrying(c.p.dim);
  if (!(*std::min_element(network.force.begin(), network.force.end()) > 0.0)) return {};
  ProofScene scene = scene_of_contacts(c.p, network, {});
  ProofEquations equations;
  if (!refine(scene, equations)) return {};
  const Proof proof = prove(scene, equations);
  if (!proof.trapped && !proof.exact) return {};
  r.stressed = Verdict::yes;
  r.self_stresses = r.contacts - (r.contacts_needed - 1);
  r.flexes = 0;
  r.flex.clear();
  // R has rows 2 r_c.
  double length2 = 0.0;
  for (const double sigma2 : equations.sigma2) length2 += 4.0 * scene.gamma() * sigma2;
  r.margin = proof.bound.eigenvalue * static_cast<double>(scene.contacts()) / length2;
  c.v.answer_if_all_closed = Verdict::yes;
  return Verdict::yes;
}

Says recheck_weak_forces(JammingCase &c) {
  const RigidityResult &r = c.v.result;
  if (c.v.jammed != Verdict::yes || r.contacts <= r.contacts_needed || !may_be_proved(c)) return {};
  const ContactNetwork network = c.v.carrying(c.p.dim);
  const double least = *std::min_element(network.force.begin(), network.force.end());
  if (!(least < proof_tuning::weak)) return {};
  ProofScene as_listed = scene_of_contacts(c.p, network, {}), closing = as_listed;
  if (as_listed.own_images || proves(as_listed)) return {};
  LpsEnd lps = LpsEnd::closed;
  const Settled found = finish_exchange(closing, close_together(closing, &lps));
  if (found == Settled::held || (found == Settled::changed && proves(closing))) {
    ContactNetwork net = network_of(closing, c.p);
    if (balance_at_positions(c.p, net)) replace_network(std::move(net), c.p, c.v);
    return {};
  }
  c.v.answer_if_all_closed = Verdict::undecided;
  c.v.unresolved = least, c.v.unresolved_because = words_of(lps);
  return Verdict::undecided;
}

}  // namespace jam::inside
