#include "network/own_images.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "network/resolution.hpp"

namespace jam::inside {

ContactNetwork unlisted_own_images(const Packing &p, const ContactNetwork &net, double limit) {
  if (p.cell.shortest() > (1.0 + limit) * diameter_max(p)) return {};
  const ContactNetwork own = unforced_pairs(p, 0.0, 1.0 + limit);
  ContactLookup known(p, net);
  std::vector<char> on(own.size(), 0);
  for (size_t k = 0; k < own.size(); ++k)
    on[k] = !known.holds(own.pairs, k) && own.pairs.own_image(k) && own.gap[k] < limit;
  return subset(own, on, p.dim);
}

ContactNetwork unlisted_own_images(const Packing &p, const ContactNetwork &net) {
  if (!net.stiffness.empty()) return {};
  double widest = contact_gap_limit;
  for (const double h : net.gap) widest = std::max(widest, h);
  return unlisted_own_images(p, net, widest);
}

void refuse_own_images(const ContactNetwork &own, const char *quantity) {
  if (own.size() == 0) return;
  fail(
      JAM_E_UNSUPPORTED,
      "%s would be wrong: sphere %d touches its own image, and the network of a fixed cell omits this contact, as such "
      "a cell does not determine its force. Crunch with strain=free, which lists it, or use more spheres a cell: "
      "jam_tile, then jam_contacts_from_geometry",
      quantity, own.pairs.i[0]);
}

}  // namespace jam::inside
