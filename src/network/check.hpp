// The verdict on a packing as it is: from positions, diameters and cell alone, and nothing moves.
#pragma once
#include <string>

#include "core/packing.hpp"
#include "jam/jam.h"
#include "network/rigidity_test.hpp"

namespace jam::inside {

// The report of a check that was left before it had a verdict.
jam_check_report untested_check();

struct CheckResult {
  jam_check_report report{};
  Packing tested;           // with the diameters that were tested: no pair overlaps
  ContactNetwork carrying;  // contacts with force of the verdict
};
// known: the network that is stored with the packing, or NULL. judge: the verdict of one kind (proof/judge.hpp);
// without it that of doubles.
using Judge = PackingVerdict (*)(const Packing &, const GapResolution &, const ContactNetwork *known, Jamming);
CheckResult check_as_it_is(const Packing &p, const ContactNetwork *known = nullptr, Judge judge = test_packing);

// check_text.cpp: the report as one paragraph.
std::string text_of(const jam_check_report &report);

}  // namespace jam::inside
