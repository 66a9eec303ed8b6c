// The verdict on a packing as it is: from positions, diameters and cell alone, and nothing moves.
#pragma once
#include "core/packing.hpp"
#include "jam/jam.h"
#include "network/contact_network.hpp"
#include "verdict/overlaps.hpp"

namespace jam::inside {

// The report of a check that was left before it had a verdict.
jam_check_report blank_report();

struct CheckResult {
  jam_check_report report{};
  TestedPacking tested;
  ContactNetwork carrying;  // contacts with force of the verdict
};
// known: the network that is stored with the packing, or NULL.
CheckResult check_as_it_is(const Packing &p, const ContactNetwork *known = nullptr);

}  // namespace jam::inside
