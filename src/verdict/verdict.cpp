#include "verdict/verdict.hpp"

#include <algorithm>

#include "core/pair_rule.hpp"

namespace jam::inside {
namespace {

// The pairs that touch or may touch, their rows and flags.
JammingCase open_case(const Packing &p, const GapResolution &resolution, const ContactNetwork *listed, Jamming kind) {
  JammingCase c{p, resolution, nullptr, kind, false, {}, {}, {}};
  const ContactNetwork near = unforced_pairs(p, resolution.reach(), 1.0 + listed_gap_limit);
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
    c.pairs.maybe_closed.push_back(closed || is_listed || near.gap[k] * sigma < resolution.reach());
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

}  // namespace jam::inside
