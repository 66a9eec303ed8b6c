#include "verdict/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair_rule.hpp"
#include "network/contacts_from_geometry.hpp"
#include "network/rattlers.hpp"
#include "verdict/tuning.hpp"

namespace jam::inside {
namespace {

bool is(const JammingCase &c, Verdict jammed) { return c.v.jammed == jammed; }
bool touches(double gap) { return gap < contact_gap_limit; }
Says undecided_if(bool doubt) { return doubt ? Says(Verdict::undecided) : std::nullopt; }

// Result on the rows that are `on`, with its arrays as long as those of the whole list.
RigidityResult test_part(const RigidityMatrix &g, const std::vector<char> &on, Jamming kind) {
  if (std::count(on.begin(), on.end(), 0) == 0) return test_rigidity(g, kind);
  const RigidityMatrix part = subset(g, on);
  RigidityResult r = test_rigidity(part, kind);
  std::vector<char> carrying(g.contacts(), 0);
  std::vector<double> force(g.contacts(), 0.0);
  for (size_t k = 0, at = 0; k < g.contacts(); ++k)
    if (on[k]) carrying[k] = r.carrying[at], force[k] = r.force[at++];
  r.carrying = std::move(carrying), r.force = std::move(force);
  if (!r.flex.empty()) {
    std::vector<double> v(g.unknowns(), 0.0);
    scatter(part, r.flex.data(), 1.0, v);
    r.flex = std::move(v);
  }
  return r;
}

// With the closed contacts jammed, another contact between two of their force-carrying spheres changes nothing: its row
// is a combination of theirs. True when all contacts in doubt are of that kind or cannot carry force at all.
bool within_jammed(const JammingCase &c) {
  const RigidityMatrix &g = c.rows;
  std::vector<char> stable(g.nodes, 0), on(g.contacts(), 1);
  for (size_t k = 0; k < g.contacts(); ++k)
    if (c.v.result.carrying[k]) for_spheres(g.a[k], g.b[k], [&](int32_t i) { stable[i] = 1; });
  drop_unbalanced(g.dim, static_cast<size_t>(g.nodes), g.a, g.b, g.normal, on);
  for (size_t k = 0; k < g.contacts(); ++k)
    if (on[k] && !c.pairs.closed[k] && !(stable[g.a[k]] && (g.b[k] < 0 || stable[g.b[k]]))) return false;
  return true;
}

// Spheres with d contacts or fewer can slip out of a balance of forces (they are no part of a jammed network), and
// others follow; round walls hold spheres with fewer. Whether any sphere is left does not depend on directions.
bool could_be_supported(const RigidityMatrix &g) {
  if (g.curved != 0) return g.contacts() > 0;
  std::vector<int32_t> degree(g.nodes, 0);
  std::vector<char> on(g.contacts(), 1);
  for (size_t k = 0; k < g.contacts(); ++k) for_spheres(g.a[k], g.b[k], [&](int32_t i) { ++degree[i]; });
  for (bool again = true; again;) {
    again = false;
    for (size_t k = 0; k < g.contacts(); ++k)
      if (on[k] && (degree[g.a[k]] <= g.dim || (g.b[k] >= 0 && degree[g.b[k]] <= g.dim))) {
        on[k] = 0, again = true;
        for_spheres(g.a[k], g.b[k], [&](int32_t i) { --degree[i]; });
      }
  }
  return std::count(on.begin(), on.end(), 1) > 0;
}

Says test_closed(JammingCase &c) {
  c.v.result = test_part(c.rows, c.pairs.closed, c.kind);
  c.v.answer_if_all_closed = c.v.result.rigid;
  return c.v.result.rigid;
}

// Jammed with and without the pairs in doubt: closed contacts alone prove it. Else the flex of the open ones is kept.
Says test_doubtful_pairs(JammingCase &c) {
  if (c.pairs.maybe_closed == c.pairs.closed || (is(c, Verdict::yes) && within_jammed(c))) return {};
  RigidityResult all_closed = test_part(c.rows, c.pairs.maybe_closed, c.kind);
  const Verdict now = c.v.jammed, then = all_closed.rigid;
  c.v.answer_if_all_closed = then;
  if (then == now ? now != Verdict::yes : now == Verdict::yes) c.v.result = std::move(all_closed);
  return undecided_if(then != now);
}

Says test_clearance(JammingCase &c) {
  const RigidityResult &r = c.v.result;
  if (!is(c, Verdict::no) || r.stressed != Verdict::yes || r.flex.empty()) return {};
  return undecided_if(!find_unblocked_flex(c.p, c.pairs.maybe_closed, c.kind, c.v));
}

Says test_opening(JammingCase &c) {
  RigidityResult &r = c.v.result;
  if (!is(c, Verdict::no) || r.stressed != Verdict::no || r.flex.empty()) return {};
  double open = std::numeric_limits<double>::epsilon();
  for (size_t k = 0; k < c.v.contacts.size(); ++k)
    if (c.pairs.closed[k]) open = std::max(open, std::fabs(c.v.contacts.gap[k]));
  if (r.opens_clearly(open)) return {};
  r.stressed = Verdict::undecided;
  return Verdict::undecided;
}

// Pairs whose gaps are wider than rounding, and that no list names, may be open. Without these pairs the rest may still
// prove "jammed"; a failure of that test proves nothing.
Says test_tight_pairs(JammingCase &c) {
  if (!is(c, Verdict::undecided) || c.resolution.coarse(c.p)) return {};
  std::vector<char> tight(c.pairs.closed);
  for (size_t k = 0; k < tight.size(); ++k)
    tight[k] = tight[k] && (c.pairs.listed[k] ||
                            c.v.contacts.gap[k] < VerdictTuning::roundings_of_tight_pairs * c.resolution.rounding);
  if (tight == c.pairs.closed) return {};
  RigidityResult r = test_part(c.rows, tight, c.kind);
  if (r.rigid != Verdict::yes) return {};
  c.v.result = std::move(r);
  return Verdict::yes;
}

// Where no pair is closed any motion will do.
Says take_any_motion(JammingCase &c) {
  const bool none = std::count(c.pairs.closed.begin(), c.pairs.closed.end(), 1) == 0;
  if (!none || c.rows.nodes == 0 || !is(c, Verdict::no)) return {};
  c.v.result.flex.assign(c.rows.unknowns(), 0.0);
  c.v.result.flex[0] = 1.0;
  return {};
}

Says doubt_few_digits(JammingCase &c) {
  return undecided_if(is(c, Verdict::no) && c.resolution.coarse(c.p) && could_be_supported(c.rows));
}

// A sphere that touches nothing but its own images has no motion of its own. It is held where their forces balance on
// the cell too.
Says test_single_sphere(JammingCase &c) {
  RigidityResult &r = c.v.result;
  if (c.kind != Jamming::collective || r.spheres != 1 || r.contacts == 0 || c.p.container) return {};
  const RigidityResult strict = test_rigidity(subset(c.rows, r.carrying), Jamming::strict);
  r.margin = strict.margin;
  return strict.stressed == Verdict::yes ? Verdict::yes : Verdict::undecided;
}

// A contact that stays open is none: only closed ones prove a packing jammed, whatever list has them.
Says doubt_open_contacts(JammingCase &c) {
  bool open = false;
  for (size_t k = 0; k < c.v.contacts.size(); ++k)
    open = open || (c.v.result.carrying[k] && !touches(c.v.contacts.gap[k]));
  return undecided_if(is(c, Verdict::yes) && open);
}

// A sphere on the axis of its tube, or at the centre of its ball, touches the round wall all around: one row is not
// enough.
Says doubt_contact_all_around(JammingCase &c) {
  const RigidityMatrix &g = c.rows;
  bool around = false;
  for (size_t k = 0; k < g.contacts() && g.curved != 0; ++k)
    around = around ||
             (c.pairs.maybe_closed[k] && g.b[k] < 0 && !(-g.bending[k] * g.sigma[k] * VerdictTuning::off_axis < 1.0));
  if (!around) return {};
  c.v.result.stressed = c.v.answer_if_all_closed = Verdict::undecided;
  c.v.result.flex.clear();
  return Verdict::undecided;
}

// Some pairs touch, and yet a motion opens them all.
bool opens_contacts(const PackingVerdict &v) {
  return v.jammed == Verdict::no && v.result.stressed == Verdict::no &&
         std::any_of(v.contacts.gap.begin(), v.contacts.gap.end(), touches);
}

// With the contacts of `open` beside those that touch, all taken as closed. A motion that opens them slowly counts
// where it leads the spheres far beyond what their gaps leave open, and is the flex then.
Verdict with_closed(JammingCase &c, const ContactNetwork &open, double widest) {
  ContactNetwork all = unforced_pairs(c.p, 0.0, 1.0 + 2.0 * widest);
  ContactLookup in_open(c.p, open), in_touching(c.p, c.v.contacts);
  std::vector<char> on(all.size());
  for (size_t k = 0; k < on.size(); ++k) {
    const bool listed = in_open.holds(all.pairs, k), tested = in_touching.holds(all.pairs, k);
    on[k] = listed || (tested && touches(all.gap[k]));
  }
  const RigidityMatrix g = make_rigidity_matrix(c.p, subset(all, on, c.p.dim));
  RigidityResult r = test_rigidity(g, c.kind);
  if (r.rigid != Verdict::no || r.stressed != Verdict::no || r.opens_clearly(widest)) return r.rigid;
  const double far = VerdictTuning::far_beyond_gaps * std::sqrt(widest);
  if (!leads_free(c.p, {g.sphere, r.flex, r.strain}, far)) return Verdict::undecided;
  c.v.result.flex = std::move(r.flex), c.v.result.strain = std::move(r.strain), c.v.sphere = g.sphere;
  return Verdict::no;
}

// A pair touches, and others that would hold spheres with it are open. Their contacts may have been closed before
// digits were lost in a way that leaves no step, such as a turned frame, or before a crunch ended: where they are open
// by little, or by much less than all other pairs. Where no pair touches, all are open by more than rounding.
Says undecide_if_nearly_closed_pairs_hold(JammingCase &c) {
  if (!opens_contacts(c.v) || c.p.n() < 2) return {};
  // Spheres that contacts hold in the fixed cell have all of theirs closed, and these do not fix the cell.
  if (c.kind == Jamming::strict) {
    const ContactNetwork closed = subset(c.v.contacts, c.pairs.listed, c.p.dim);
    const ContactNetwork *listed = closed.size() ? &closed : nullptr;
    const Verdict held =
        c.other ? c.other->jammed : test_packing(c.p, c.resolution, listed, Jamming::collective).jammed;
    if (held == Verdict::yes) return {};
  }
  const auto hold = [&](const ContactNetwork &open, bool clear) {
    if (open.size() == 0) return false;
    const double widest = std::max(contact_gap_limit, *std::max_element(open.gap.begin(), open.gap.end()));
    if (!clear && !(widest < listed_gap_limit)) return false;
    const Verdict all_closed = with_closed(c, open, widest);
    if (all_closed == Verdict::no) return false;
    c.v.answer_if_all_closed = all_closed;
    const int64_t more = std::count_if(open.gap.begin(), open.gap.end(), [](double gap) { return !touches(gap); });
    c.v.undecided_contacts = std::max(c.v.undecided_contacts, more);
    return true;
  };
  if (c.known && hold(*c.known, false)) return Verdict::undecided;
  const GeometryResult near = contacts_from_geometry(c.p, default_geometry_options());
  return undecided_if(hold(near.network, near.clear));
}

// Spheres that move in the fixed cell move without a strain.
Says adopt_collective_no(JammingCase &c) {
  if (c.kind != Jamming::strict || !is(c, Verdict::undecided) || c.other->jammed != Verdict::no ||
      c.other->result.flex.empty())
    return {};
  c.v.answer_if_all_closed = Verdict::no;
  if (c.other->result.stressed == Verdict::no) c.v.result.stressed = Verdict::no;
  c.v.result.flex = c.other->result.flex, c.v.sphere = c.other->sphere;
  c.v.result.strain.assign(static_cast<size_t>(c.p.dim) * c.p.dim, 0.0);
  return Verdict::no;
}

// The strict test counts own images, and may show jamming where the collective one does not; strictly jammed is
// collectively jammed.
Says adopt_strict_yes(JammingCase &c) {
  if (c.kind != Jamming::collective || !c.other || is(c, Verdict::yes) || c.other->jammed == Verdict::no) return {};
  if (c.other->jammed == Verdict::undecided) {
    c.v.answer_if_all_closed = Verdict::undecided;
    return Verdict::undecided;
  }
  c.v.hear(Rule::own_images, Verdict::undecided);
  static_cast<Evidence &>(c.v) = *c.other;
  return Verdict::yes;
}

// What is held in every strain is held in the fixed cell. Where doubles do not show that, they show neither.
Says doubt_if_loose_in_the_cell(JammingCase &c) {
  return undecided_if(c.kind == Jamming::strict && is(c, Verdict::yes) && c.other->jammed != Verdict::yes);
}

Says doubt_overlaps(JammingCase &c) { return undecided_if(c.overlapping && is(c, Verdict::yes)); }

constexpr RuleOf rules[] = {
    {Rule::rows, test_closed},
    {Rule::doubtful_pairs, test_doubtful_pairs},
    {Rule::clearance, test_clearance},
    {Rule::slow_opening, test_opening},
    {Rule::tight_pairs, test_tight_pairs},
    {Rule::tight_pairs, take_any_motion},
    {Rule::digits, doubt_few_digits},
    {Rule::single_sphere, test_single_sphere},
    {Rule::open_contacts, doubt_open_contacts},
    {Rule::all_around, doubt_contact_all_around},
    {Rule::weak_forces, recheck_weak_forces},
    {Rule::trapped, raise_if_trapped},
    {Rule::nearly_closed, undecide_if_nearly_closed_pairs_hold},
    {Rule::moves_at_rest, adopt_collective_no},
    {Rule::own_images, adopt_strict_yes},
    {Rule::loose_in_the_cell, doubt_if_loose_in_the_cell},
    {Rule::overlaps, doubt_overlaps},
};

}  // namespace

void try_rules(JammingCase &c, Rule first, Rule last) {
  for (const RuleOf &one : rules)
    if (one.rule >= first && one.rule <= last) c.v.hear(one.rule, one.says(c));
}

}  // namespace jam::inside
