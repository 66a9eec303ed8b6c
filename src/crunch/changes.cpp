// What a crunch did to the packing that it was given.
#include <cmath>
#include <exception>

#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "crunch/state.hpp"
#include "network/resolution.hpp"

namespace jam {

// Closed pairs as in the test of jamming, and those that digits cannot distinguish from them.
Touching find_touching(const Packing &start, bool own_images) {
  const GapResolution resolution = gap_resolution(start);
  const PairList pairs = find_pairs(start, resolution.reach(), 1.0 + contact_gap_limit);
  double r[JAM_MAX_DIM];
  Touching found;
  found.total = 0;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double sigma = contact_distance(start, pairs.i[k], pairs.j[k]);
    if (pairs.own_image(k) && !own_images) continue;
    const double gap = std::sqrt(pair_vector(start, pairs, k, r)) / sigma - 1.0;
    if (!(gap < contact_gap_limit || gap * sigma < resolution.reach())) continue;
    ++found.images[{pairs.i[k], pairs.j[k]}], ++found.total;
  }
  return found;
}

void report_changes(Touching start, double packing_fraction_start, CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  r.packing_fraction_start = packing_fraction_start;
  r.contacts_start = start.total;
  r.contacts_kept = -1;
  r.displacement_max = r.displacement_rms = r.displacement_max_stable = r.displacement_rms_stable = std::nan("");
  try {
    const std::vector<int32_t> &coordination = s.out.contacts.coordination;
    s.history.displaced(s.out.packing, nullptr, r.displacement_max, r.displacement_rms);
    if (stable_spheres(coordination) > 0)
      s.history.displaced(s.out.packing, &coordination, r.displacement_max_stable, r.displacement_rms_stable);
  } catch (const std::exception &) {  // out of memory: the rest of the report stands
  }
  if (r.rattlers < 0 || start.total < 0) return;
  r.contacts_kept = 0;
  const PairList &contacts = s.out.contacts.pairs;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const auto at = start.images.find({contacts.i[k], contacts.j[k]});
    if (at != start.images.end() && at->second > 0) --at->second, ++r.contacts_kept;
  }
}

}  // namespace jam
