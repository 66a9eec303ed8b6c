// Contacts of a sphere with its own image that a network does not list. In a fixed cell they hold no motion, and the
// cell does not determine their force, so a crunch and contacts from geometry omit them. Copies of the cell and
// strains of it move them: there they are contacts as any other.
#pragma once
#include "core/packing.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

// Those with gaps below `limit`, without forces.
ContactNetwork unlisted_own_images(const Packing &p, const ContactNetwork &net, double limit);
// Those with gaps of closed contacts, or of the widest contact of the network. Soft spheres touch by overlaps alone,
// and their networks hold all of these.
ContactNetwork unlisted_own_images(const Packing &p, const ContactNetwork &net);

// JAM_E_UNSUPPORTED for a quantity that would be computed without the first of `own`.
void refuse_own_images(const ContactNetwork &own, const char *quantity);

}  // namespace jam::inside
