#include "verdict/verdict.hpp"

#include <algorithm>

#include "core/pair_rule.hpp"
#include "proof/newton.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

// What two doubles add to the test of doubles.

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

// The pairs that touch or may touch, their rows and flags.
JammingCase open_case(const Packing &p, const GapResolution &resolution, const ContactNetwork *listed, Jamming kind) {
  JammingCase c{p, resolution, nullptr, kind, false, {}, {}, {}};
  const ContactNetwork near = unforced_network(p, resolution.pairs_in_reach(p, listed_gap_limit));
  std::vector<double> in_list(near.size(), 0.0);
  if (listed) in_list = carry_over(listed->pairs, std::vector<double>(listed->size(), 1.0), near.pairs);
  std::vector<char> tested(near.size());
  for (size_t k = 0; k < near.size(); ++k) {
    const double sigma = contact_distance(p, near.pairs.i[k], near.pairs.j[k]);
    const bool is_listed = in_list[k] > 0.0, counts = kind == Jamming::strict || !near.pairs.own_image(k);
    tested[k] = is_listed || (counts && resolution.may_touch(near.gap[k], sigma));
    if (!tested[k]) continue;
    const bool closed = near.gap[k] < (is_listed ? undecided_gap_limit : contact_gap_limit);
    c.pairs.listed.push_back(is_listed), c.pairs.closed.push_back(closed);
    c.pairs.maybe_closed.push_back(closed || is_listed || near.gap[k] * sigma < resolution.reach(sigma));
  }
  ContactNetwork &net = c.v.contacts = subset(near, tested, p.dim);
  c.v.undecided_contacts =
      std::count_if(net.gap.begin(), net.gap.end(), [](double h) { return h >= contact_gap_limit; });
  c.rows = make_rigidity_matrix(p, net);
  c.v.sphere = c.rows.sphere;
  return c;
}

void set_forces(JammingCase &c) {
  c.v.contacts.force = c.v.result.force;
  set_force_scale(c.p, c.v.contacts);
}

ContactNetwork closed_of(const Packing &p, const ContactNetwork *known) {
  if (!known) return {};
  std::vector<char> on(known->size());
  for (size_t k = 0; k < on.size(); ++k) on[k] = known->pairs.own_image(k) || known->gap[k] < contact_gap_limit;
  return subset(*known, on, p.dim);
}

// By the rules of one kind: motions of its spheres, and in the strict test of its cell. other: the verdict of the other
// kind, where it is known.
PackingVerdict test_alone(const Packing &p, const GapResolution &resolution, const ContactNetwork *known, Jamming kind,
                          const PackingVerdict *other = nullptr) {
  const ContactNetwork closed = closed_of(p, known);
  JammingCase c = open_case(p, resolution, closed.size() ? &closed : nullptr, kind);
  c.known = known, c.other = other;
  try_rules(c, Rule::rows, Rule::all_around);
  set_forces(c);
  try_rules(c, Rule::weak_forces, Rule::nearly_closed);
  return std::move(c.v);
}

}  // namespace

void PackingVerdict::hear(Rule speaker, std::optional<Verdict> says) {
  if (!says || *says == jammed) return;
  jammed = jammed == Verdict::undecided ? *says : Verdict::undecided;
  rule = speaker;
}

bool may_touch_own_image(const Packing &p, const GapResolution &resolution) {
  const double widest = diameter_max(p);
  return resolution.may_touch(p.cell.shortest() / widest - 1.0, widest);
}

PackingVerdict test_packing(const Packing &p, const GapResolution &resolution, const ContactNetwork *listed,
                            Jamming kind, Rule last) {
  JammingCase c = open_case(p, resolution, listed, kind);
  try_rules(c, Rule::rows, std::min(last, Rule::all_around));
  set_forces(c);
  if (last > Rule::all_around) try_rules(c, Rule::weak_forces, last);
  return std::move(c.v);
}

PackingVerdict test_packing(const Packing &p, const ContactNetwork *listed, Jamming kind, Rule last) {
  return test_packing(p, gap_resolution(p), listed, kind, last);
}

PackingVerdict verdict_of(const TestedPacking &tested, const ContactNetwork *known, Jamming kind) {
  return JammingTest(tested, known).verdict(kind);
}

const PackingVerdict &JammingTest::alone(Jamming kind) {
  std::optional<PackingVerdict> &v = alone_[static_cast<int>(kind)];
  if (v) return *v;
  const std::optional<PackingVerdict> &held = alone_[static_cast<int>(Jamming::collective)];
  v = test_alone(p_, resolution_, known_, kind, held ? &*held : nullptr);
  return *v;
}

const PackingVerdict &JammingTest::collective() {
  std::optional<PackingVerdict> &v = final_[static_cast<int>(Jamming::collective)];
  if (v) return *v;
  v = alone(Jamming::collective);
  JammingCase c{p_, resolution_, known_, Jamming::collective, tested_.overlapping, {}, {}, {}};
  if (v->jammed != Verdict::yes && !p_.container && may_touch_own_image(p_, resolution_)) {
    c.other = &alone(Jamming::strict);
    const bool balanced_by_images = v->jammed == Verdict::no && c.other->jammed == Verdict::no &&
                                    v->result.stressed == Verdict::no && c.other->result.stressed == Verdict::yes;
    if (balanced_by_images) v = test_alone(p_, resolution_, &c.other->contacts, Jamming::collective);
  }
  c.v = std::move(*v);
  try_rules(c, Rule::moves_at_rest, Rule::overlaps);
  return *(v = std::move(c.v));
}

const PackingVerdict &JammingTest::strict() {
  std::optional<PackingVerdict> &v = final_[static_cast<int>(Jamming::strict)];
  if (v) return *v;
  v = alone(Jamming::strict);
  if (v->jammed == Verdict::no) return *v;
  JammingCase c{p_, resolution_, known_, Jamming::strict, tested_.overlapping, {}, {}, std::move(*v)};
  c.other = c.v.jammed == Verdict::undecided ? &alone(Jamming::collective) : &collective();
  try_rules(c, Rule::moves_at_rest, Rule::overlaps);
  return *(v = std::move(c.v));
}

Verdict verdict_of_copies(const PackingVerdict &one_cell, const CopiesEvidence &e) {
  PackingVerdict v;
  const bool doubt = one_cell.jammed == Verdict::undecided && one_cell.result.spheres != 1;
  const Verdict counted = e.empty || e.flexes > 0 ? Verdict::no : Verdict::yes;
  // Contacts in doubt, and coordinates with few digits, leave one cell undecided, and the copies too.
  if (!doubt) v.hear(Rule::rows, counted);
  if (!e.empty && e.flexes_of_one == 0 && e.flexes > 0 && !e.clear) v.hear(Rule::clearance, Verdict::undecided);
  if (v.jammed == Verdict::yes && !(e.closed && e.margin > undecided_eigenvalue))
    v.hear(e.closed ? Rule::rows : Rule::open_contacts, Verdict::undecided);
  return v.jammed;
}

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
