#include "verdict/overlaps.hpp"

#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "core/pairs.hpp"

namespace jam::inside {
namespace {

void refuse_soft(const Packing &p, const ClosestPair &closest) {
  if (!(closest.gap < -0.5)) return;
  if (closest.j < 0)
    fail(JAM_E_OVERLAP, "sphere %d overlaps %s by %.3g of its radius: this is no packing of hard spheres", closest.i,
         p.container[wall_partner(closest.j)].name().c_str(), -closest.gap);
  if (closest.gap == -1.0)
    fail(JAM_E_OVERLAP, "spheres %d and %d have the same centre: this is no packing of hard spheres", closest.i,
         closest.j);
  fail(JAM_E_OVERLAP, "spheres %d and %d overlap by %.3g of their contact distance: this is no packing of hard spheres",
       closest.i, closest.j, -closest.gap);
}

}  // namespace

// That the worst pair overlaps says that gaps are known no better.
TestedPacking without_overlaps(const Packing &p) {
  TestedPacking out{p, gap_resolution(p)};
  const ClosestPair closest = closest_contact(p);
  out.nearest_gap = closest.gap;
  out.packing.overlap_allowed = false;
  if (!(closest.gap < -contact_gap_limit)) return out;
  refuse_soft(p, closest);
  const double overlap = -closest.gap * contact_distance(p, closest.i, closest.j);
  out.overlapping = -closest.gap > undecided_gap_limit && overlap > out.resolution.reach();
  widen(out.resolution, p, overlap);
  out.diameter_factor = 1.0 + closest.gap;
  for (double &sigma : out.packing.diameter) sigma *= out.diameter_factor;
  return out;
}

}  // namespace jam::inside
