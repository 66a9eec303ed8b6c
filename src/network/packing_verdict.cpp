// The verdict on a packing: its pairs near contact by gaps and digits, their test, and what contacts in doubt change.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair_rule.hpp"
#include "network/rigidity_test.hpp"
#include "network/room.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

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
  for (std::vector<double> *motion : {&r.flex, &r.attempt}) {
    if (motion->empty()) continue;
    std::vector<double> v(g.unknowns(), 0.0);
    scatter(part, motion->data(), 1.0, v);
    *motion = std::move(v);
  }
  return r;
}

// With the closed contacts jammed, another contact between two of their force-carrying spheres changes nothing: its row
// is a combination of theirs. True when all contacts in doubt are of that kind or cannot carry force at all.
bool within_jammed(const RigidityMatrix &g, const std::vector<char> &closed, const std::vector<char> &carrying) {
  std::vector<char> stable(g.nodes, 0), on(g.contacts(), 1);
  for (size_t k = 0; k < g.contacts(); ++k)
    if (carrying[k]) for_spheres(g.a[k], g.b[k], [&](int32_t i) { stable[i] = 1; });
  drop_unbalanced(g.dim, static_cast<size_t>(g.nodes), g.a, g.b, g.normal, on);
  for (size_t k = 0; k < g.contacts(); ++k)
    if (on[k] && !closed[k] && !(stable[g.a[k]] && (g.b[k] < 0 || stable[g.b[k]]))) return false;
  return true;
}

// Spheres with d contacts or fewer can slip out of a balance of forces (they are no part of a jammed network), and
// others follow; round walls hold spheres with fewer. Whether any sphere is left does not depend on directions.
bool may_hold_spheres(const RigidityMatrix &g) {
  if (g.round_axes > 0) return g.contacts() > 0;
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

// A sphere on the axis of its tube, or at the centre of its ball, touches the round wall all around: one row is not
// enough.
bool touches_all_around(const RigidityMatrix &g, const std::vector<char> &near_enough) {
  for (size_t k = 0; k < g.contacts(); ++k)
    if (near_enough[k] && g.b[k] < 0 && !(-g.bending[k] * g.sigma[k] * RigidityTuning::off_axis < 1.0)) return true;
  return false;
}

// A sphere that touches nothing but its own images has no motion of its own. It is held where their forces balance on
// the cell too.
void judge_alone(const RigidityMatrix &g, RigidityResult &r) {
  const RigidityResult strict = test_rigidity(subset(g, r.carrying), Jamming::strict);
  r.margin = strict.margin;
  r.jammed = strict.stressed == Verdict::yes ? Verdict::yes : Verdict::undecided;
}

}  // namespace

bool may_touch_own_image(const Packing &p, const GapResolution &resolution) {
  const double widest = diameter_max(p);
  return resolution.may_touch(p.cell.shortest() / widest - 1.0, widest);
}

void take_strict(PackingVerdict &collective, const PackingVerdict &strict) {
  const RigidityResult &held = strict.result;
  RigidityResult &r = collective.result;
  if (r.jammed == Verdict::yes) return;
  if (held.jammed == Verdict::yes)
    collective = strict;
  else if (held.jammed == Verdict::undecided)
    r.jammed = collective.when_closed = Verdict::undecided;
}

PackingVerdict test_packing(const Packing &p, const ContactNetwork *listed, Jamming kind) {
  return test_packing(p, gap_resolution(p), listed, kind);
}

PackingVerdict test_packing(const Packing &p, const GapResolution &resolution, const ContactNetwork *listed,
                            Jamming kind) {
  PackingVerdict out;
  ContactNetwork &net = out.contacts;
  ContactNetwork near;
  near.pairs = find_pairs(p, resolution.reach(), 1.0 + listed_gap_limit);
  measure_contacts(p, near);
  near.coordination.assign(p.n(), 0);
  near.force.assign(near.size(), 0.0);
  std::vector<double> in_list(near.size(), 0.0);
  if (listed) in_list = carry_over(listed->pairs, std::vector<double>(listed->size(), 1.0), near.pairs);
  std::vector<char> wanted(near.size());
  // A sphere and its own image keep their distance in a fixed cell: contacts only of a network from a free one.
  const auto counts = [&](size_t k) { return kind == Jamming::strict || !near.pairs.own_image(k); };
  for (size_t k = 0; k < near.size(); ++k)
    wanted[k] = in_list[k] > 0.0 ||
                (counts(k) && resolution.may_touch(near.gap[k], contact_distance(p, near.pairs.i[k], near.pairs.j[k])));
  net = subset(near, wanted, p.dim);
  std::vector<char> closed, near_enough, listed_here;
  for (size_t k = 0; k < near.size(); ++k) {
    if (!wanted[k]) continue;
    const bool named = in_list[k] > 0.0;
    listed_here.push_back(named);
    closed.push_back(near.gap[k] < (named ? undecided_gap_limit : contact_gap_limit));
    near_enough.push_back(closed.back() || named ||
                          near.gap[k] * contact_distance(p, near.pairs.i[k], near.pairs.j[k]) < resolution.reach());
  }
  out.undecided_contacts =
      std::count_if(net.gap.begin(), net.gap.end(), [](double h) { return h >= contact_gap_limit; });
  const RigidityMatrix g = make_rigidity_matrix(p, net);
  out.sphere = g.sphere;
  out.result = test_part(g, closed, kind);
  out.when_closed = out.result.jammed;
  if (near_enough != closed && !(out.result.jammed == Verdict::yes && within_jammed(g, closed, out.result.carrying))) {
    RigidityResult shut = test_part(g, near_enough, kind);
    const bool same = shut.jammed == out.result.jammed;
    out.when_closed = shut.jammed;
    // Jammed with and without the pairs in doubt: closed contacts alone prove it. Else the flex of the open ones is
    // kept.
    if (same ? shut.jammed != Verdict::yes : out.result.jammed == Verdict::yes) out.result = std::move(shut);
    if (!same) out.result.jammed = Verdict::undecided;
  }
  if (out.result.jammed == Verdict::no && out.result.stressed == Verdict::yes && !out.result.flex.empty() &&
      !find_flex_with_room(p, near_enough, kind, out))
    out.result.jammed = Verdict::undecided;
  if (out.result.jammed == Verdict::no && out.result.stressed == Verdict::no && !out.result.flex.empty()) {
    double open = std::numeric_limits<double>::epsilon();
    for (size_t k = 0; k < net.size(); ++k)
      if (closed[k]) open = std::max(open, std::fabs(net.gap[k]));
    if (!out.result.opens_clearly(open)) out.result.jammed = out.result.stressed = Verdict::undecided;
  }
  if (out.result.jammed == Verdict::undecided && !resolution.coarse(p)) {
    // Unlisted pairs whose gaps are wider than rounding may be open. They leave contacts that may prove it alone; that
    // these do not hold the spheres proves nothing near a jammed packing.
    std::vector<char> tight(closed);
    for (size_t k = 0; k < net.size(); ++k)
      tight[k] = closed[k] && (listed_here[k] || net.gap[k] < 4.0 * resolution.rounding);
    RigidityResult r = tight == closed ? out.result : test_part(g, tight, kind);
    if (r.jammed == Verdict::yes) out.result = std::move(r);
  }
  if (std::count(closed.begin(), closed.end(), 1) == 0 && g.nodes > 0 && out.result.jammed == Verdict::no) {
    out.result.flex.assign(g.unknowns(), 0.0);  // nothing is closed: any motion will do
    out.result.flex[0] = 1.0;
  }
  if (out.result.jammed == Verdict::no && resolution.coarse(p) && may_hold_spheres(g))
    out.result.jammed = Verdict::undecided;
  // A contact that stays open is none: only closed ones prove a packing jammed, whoever lists them.
  for (size_t k = 0; k < net.size(); ++k)
    if (out.result.jammed == Verdict::yes && out.result.carrying[k] && !(net.gap[k] < contact_gap_limit))
      out.result.jammed = Verdict::undecided;
  if (kind == Jamming::collective && out.result.spheres == 1 && out.result.contacts > 0 && !p.container)
    judge_alone(g, out.result);
  if (g.round_axes > 0 && touches_all_around(g, near_enough)) {
    out.result.jammed = out.result.stressed = out.when_closed = Verdict::undecided;
    out.result.flex.clear(), out.result.attempt.clear();
  }
  net.force = out.result.force;
  set_force_scale(p, net);
  return out;
}

}  // namespace jam::inside
