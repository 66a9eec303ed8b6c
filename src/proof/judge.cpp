#include "proof/judge.hpp"

#include <algorithm>

#include "network/contacts_from_geometry.hpp"
#include "proof/verdict.hpp"

namespace jam::inside {
namespace {

ContactNetwork closed_of(const Packing &p, const ContactNetwork *known) {
  if (!known) return {};
  std::vector<char> on(known->size());
  for (size_t k = 0; k < on.size(); ++k) on[k] = known->pairs.own_image(k) || known->gap[k] < contact_gap_limit;
  return subset(*known, on, p.dim);
}

// Some pairs touch, and yet a motion opens them all.
bool opens_contacts(const PackingVerdict &v) {
  const auto touches = [](double gap) { return gap < contact_gap_limit; };
  return v.result.jammed == Verdict::no && v.result.stressed == Verdict::no &&
         std::any_of(v.contacts.gap.begin(), v.contacts.gap.end(), touches);
}

// With the contacts of `open` beside those that touch, all taken as closed.
Verdict with_closed(const Packing &p, const ContactNetwork &open, const ContactNetwork &touching, double widest,
                    Jamming kind) {
  ContactNetwork all;
  all.pairs = find_pairs(p, 0.0, 1.0 + 2.0 * widest);
  measure_contacts(p, all);
  all.coordination.assign(p.n(), 0);
  all.force.assign(all.size(), 0.0);
  ContactLookup in_open(p, open), in_touching(p, touching);
  std::vector<char> on(all.size());
  for (size_t k = 0; k < on.size(); ++k) {
    const bool listed = in_open.holds(all.pairs, k), touches = in_touching.holds(all.pairs, k);
    on[k] = listed || (touches && all.gap[k] < contact_gap_limit);
  }
  const RigidityResult r = test_rigidity(make_rigidity_matrix(p, subset(all, on, p.dim)), kind);
  return r.jammed == Verdict::no && r.stressed == Verdict::no && !r.opens_clearly(widest) ? Verdict::undecided
                                                                                          : r.jammed;
}

// A pair touches, and others that would hold spheres with it are open. Their contacts may have been closed before
// digits were lost in a way that leaves no step, such as a turned frame, or before a crunch ended: where they are open
// by little, or by much less than all other pairs. Where no pair touches, all are open by more than rounding.
void doubt_open_contacts(const Packing &p, const ContactNetwork *known, Jamming kind, PackingVerdict &v) {
  if (!opens_contacts(v) || p.n() < 2) return;
  const auto doubt = [&](const ContactNetwork &open, bool clear) {
    if (open.size() == 0) return false;
    const double widest = std::max(contact_gap_limit, *std::max_element(open.gap.begin(), open.gap.end()));
    if (!clear && !(widest < listed_gap_limit)) return false;
    const Verdict when_closed = with_closed(p, open, v.contacts, widest, kind);
    if (when_closed == Verdict::no) return false;
    v.result.jammed = Verdict::undecided, v.when_closed = when_closed;
    const auto wide = [](double gap) { return gap >= contact_gap_limit; };
    const auto count = static_cast<int64_t>(std::count_if(open.gap.begin(), open.gap.end(), wide));
    v.undecided_contacts = std::max(v.undecided_contacts, count);
    return true;
  };
  if (known && doubt(*known, false)) return;
  const GeometryResult near = contacts_from_geometry(p, default_geometry_options());
  doubt(near.network, near.clear);
}

// Spheres that move in the fixed cell move without a strain.
void take_collective_no(const Packing &p, const PackingVerdict &collective, PackingVerdict &strict) {
  if (collective.result.jammed != Verdict::no || collective.result.flex.empty()) return;
  strict.result.jammed = strict.when_closed = Verdict::no;
  if (collective.result.stressed == Verdict::no) strict.result.stressed = Verdict::no;
  strict.result.flex = collective.result.flex, strict.sphere = collective.sphere;
  strict.result.strain.assign(static_cast<size_t>(p.dim) * p.dim, 0.0);
}

}  // namespace

PackingVerdict judge_without_images(const Packing &p, const GapResolution &resolution, const ContactNetwork *known,
                                    Jamming kind) {
  const ContactNetwork closed = closed_of(p, known);
  PackingVerdict v = test_packing(p, resolution, closed.size() ? &closed : nullptr, kind);
  if (kind == Jamming::collective && !p.container) decide_by_proof(p, v), confirm_by_exchange(p, v);
  // Spheres that contacts hold in the fixed cell have all of theirs closed, and these do not fix the cell.
  const bool held =
      kind == Jamming::strict && opens_contacts(v) &&
      test_packing(p, resolution, closed.size() ? &closed : nullptr, Jamming::collective).result.jammed == Verdict::yes;
  if (!held) doubt_open_contacts(p, known, kind, v);
  return v;
}

PackingVerdict judge(const Packing &p, const GapResolution &resolution, const ContactNetwork *known, Jamming kind) {
  PackingVerdict v = judge_without_images(p, resolution, known, kind);
  if (kind == Jamming::strict && v.result.jammed == Verdict::undecided)
    take_collective_no(p, judge_without_images(p, resolution, known, Jamming::collective), v);
  if (kind == Jamming::collective && !p.container && v.result.jammed != Verdict::yes &&
      may_touch_own_image(p, resolution)) {
    const PackingVerdict strict = judge_without_images(p, resolution, known, Jamming::strict);
    const bool balanced_by_images = v.result.jammed == Verdict::no && strict.result.jammed == Verdict::no &&
                                    v.result.stressed == Verdict::no && strict.result.stressed == Verdict::yes;
    // As where a network lists the contacts with own images.
    if (balanced_by_images) v = judge_without_images(p, resolution, &strict.contacts, Jamming::collective);
    take_strict(v, strict);
  }
  // What is held in every strain is held in the fixed cell. Where doubles do not show that, they show neither.
  if (kind == Jamming::strict && v.result.jammed == Verdict::yes &&
      judge(p, resolution, known, Jamming::collective).result.jammed != Verdict::yes)
    v.result.jammed = Verdict::undecided;
  return v;
}

}  // namespace jam::inside
