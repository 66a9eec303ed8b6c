// The certificate: everything in the report that follows from positions, diameters, contacts and forces alone.
#pragma once
#include <string>

#include "core/packing.hpp"
#include "jam/jam.h"
#include "network/contact_network.hpp"
#include "network/rigidity_test.hpp"

namespace jam::inside {

// free_cell: the gaps of spheres and their own images count too.
void certify(const Packing &p, const ContactNetwork &contacts, jam_crunch_report &report, bool free_cell = false);

// jam_verdict of a Verdict.
int32_t verdict_code(Verdict verdict);
// What the test of collective jamming says, put into the report; strictly_jammed stays untested.
void report_verdict(const PackingVerdict &verdict, const Packing &p, jam_crunch_report &report);
// Why the test does not say that the packing is jammed: one sentence with its figures. Empty where it does.
// Strict: forces must balance on the cell too, up to a pressure.
std::string why_not_jammed(const PackingVerdict &verdict, Jamming kind = Jamming::collective);

}  // namespace jam::inside
