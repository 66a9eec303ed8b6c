// What a crunch did to the packing that it was given.
#include <cmath>
#include <exception>
#include <map>
#include <utility>

#include "core/cancellation.hpp"
#include "core/pair_rule.hpp"
#include "crunch/state.hpp"
#include "network/resolution.hpp"

namespace jam {
namespace {

using Count = std::map<std::pair<int32_t, int32_t>, int64_t>;  // images of a pair that touch

// Pairs that touched at the start, as far as the digits of the coordinates say.
Count touching(const Packing &p, bool own_images, int64_t &total) {
  const GapResolution resolution = gap_resolution(p);
  const PairList pairs = find_pairs(p, resolution.reach(), 1.0 + undecided_gap_limit);
  double r[JAM_MAX_DIM];
  Count count;
  total = 0;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
    if (pairs.own_image(k) && !own_images) continue;
    if (!resolution.may_touch(std::sqrt(pair_vector(p, pairs, k, r)) / sigma - 1.0, sigma)) continue;
    ++count[{pairs.i[k], pairs.j[k]}], ++total;
  }
  return count;
}

}  // namespace

void report_changes(const Packing &start, CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  r.packing_fraction_start = packing_fraction(start);
  r.contacts_start = r.contacts_kept = -1;
  r.displacement_max = r.displacement_rms = r.displacement_max_stable = r.displacement_rms_stable = std::nan("");
  try {
    const std::vector<int32_t> &coordination = s.out.contacts.coordination;
    s.history.displaced(s.out.packing, nullptr, r.displacement_max, r.displacement_rms);
    if (stable_spheres(coordination) > 0)
      s.history.displaced(s.out.packing, &coordination, r.displacement_max_stable, r.displacement_rms_stable);
    Count count = touching(start, s.o.strain != JAM_STRAIN_NONE, r.contacts_start);
    if (r.rattlers < 0) return;
    r.contacts_kept = 0;
    const PairList &contacts = s.out.contacts.pairs;
    for (size_t k = 0; k < contacts.size(); ++k) {
      const auto at = count.find({contacts.i[k], contacts.j[k]});
      if (at != count.end() && at->second > 0) --at->second, ++r.contacts_kept;
    }
  } catch (const Cancelled &) {  // the rest of the report stands
    r.contacts_kept = -1;
  } catch (const std::exception &) {  // out of memory: likewise
    r.contacts_kept = -1;
  }
}

}  // namespace jam
