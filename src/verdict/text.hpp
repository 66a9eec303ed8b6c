// A verdict in words and in reports: one reason, and one sentence a reason, for every call.
#pragma once
#include <cstdint>

#include "verdict/verdict.hpp"

namespace jam::inside {

// The numbers of a sentence. A jam_check_report, which has no others, gives the same sentence as the verdict.
struct VerdictNumbers {
  Jamming kind = Jamming::collective;
  int32_t jammed = JAM_VERDICT_UNTESTED, reason = JAM_CHECK_MARGIN;  // jam_verdict, jam_check_reason
  int64_t n = 0, spheres = 0, contacts = 0, closed_pairs = 0, flexes = 0, self_stresses = 0, undecided_contacts = 0;
  double force_residual = 0.0, rigidity_margin = 0.0, resolution = 0.0;
  double unresolved = 0.0;  // of PackingVerdict
  std::string unresolved_because;
};

// jam_verdict of a Verdict.
int32_t verdict_code(Verdict verdict);
VerdictNumbers numbers_of(const PackingVerdict &v, const TestedPacking &tested, Jamming kind);
// Why the packing is not known to be jammed, with its numbers: without a capital and a full stop. Empty where it is.
std::string why_not_jammed(const VerdictNumbers &numbers);
std::string why_not_jammed(const PackingVerdict &v, const Packing &p, Jamming kind = Jamming::collective);

// What every report says of a verdict.
template <class Report>
void report_counts(const PackingVerdict &v, Report &r) {
  r.flexes = v.result.flexes;
  r.zero_force_contacts = v.result.zero_force_contacts;
  r.undecided_contacts = v.undecided_contacts;
  r.rigidity_margin = v.result.margin;
}

// The verdict of a crunch or of contacts from geometry in their report.
void report_verdict(const PackingVerdict &v, jam_crunch_report &r);

// The report of a check as one paragraph that can be quoted.
std::string text_of(const jam_check_report &report);

}  // namespace jam::inside
