// Contacts by distance alone: of beds under weight and friction, whose contact forces do not balance as those of
// frictionless spheres do.
#pragma once
#include "network/contact_network.hpp"

namespace jam::inside {

// All pairs with h < gap, every image, and walls; forces are NaN.
ContactNetwork contacts_by_distance(const Packing &p, double gap);

}  // namespace jam::inside
