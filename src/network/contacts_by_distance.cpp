#include "network/contacts_by_distance.hpp"

#include <limits>

#include "core/error.hpp"

namespace jam::inside {

ContactNetwork contacts_by_distance(const Packing &p, double gap) {
  if (!(gap > 0.0 && gap <= 1.0)) fail(JAM_E_ARGUMENT, "gap is %g, it must be above 0 and at most 1", gap);
  ContactNetwork net;
  const PairList near = find_pairs(p, 0.0, 1.0 + gap);
  for (size_t k = 0; k < near.size(); ++k) add_contact(p, near, k, net);
  net.force.assign(net.size(), std::numeric_limits<double>::quiet_NaN());
  net.coordination.assign(p.n(), 0);
  for (size_t k = 0; k < net.size(); ++k)
    for_spheres(net.pairs.i[k], net.pairs.j[k], [&](int32_t i) { ++net.coordination[static_cast<size_t>(i)]; });
  return net;
}

}  // namespace jam::inside
