// The certificate: everything in the report that follows from positions, diameters, contacts and forces alone.
#pragma once
#include "core/packing.hpp"
#include "jam/jam.h"
#include "network/contact_network.hpp"

namespace jam::inside {

// free_cell: the gaps of spheres and their own images count too.
void certify(const Packing &p, const ContactNetwork &contacts, jam_crunch_report &report, bool free_cell = false);

}  // namespace jam::inside
