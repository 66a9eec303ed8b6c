// Proofs for the reports of other calls.
#pragma once
#include <limits>
#include <string>

#include "network/contact_network.hpp"

namespace jam::inside {

jam_proof_report prove_network(const Packing &p, const ContactNetwork &network);

// jam_proof_text.
std::string proof_text(int32_t theorem, int32_t cause, double radius, double value, double bound);

// What a report says where no proof was requested, or none is possible.
template <class Report>
void without_proof(Report &r) {
  r.theorem = JAM_THEOREM_NONE, r.proof_cause = JAM_CAUSE_NONE;
  r.proof_radius = std::numeric_limits<double>::infinity();  // and no NaN, so that equal reports compare equal
  r.proof_value = r.proof_bound = 0.0;
}
template <class Report>
void take_proof(const Packing &p, const ContactNetwork &network, Report &r) {
  without_proof(r);
  const jam_proof_report proof = prove_network(p, network);
  r.theorem = proof.theorem, r.proof_cause = proof.cause;
  if (proof.theorem != JAM_THEOREM_NONE)
    r.proof_radius = proof.theorem == JAM_THEOREM_EXACT ? proof.radius : proof.inner;
  r.proof_value = proof.cause_value, r.proof_bound = proof.cause_bound;
}

}  // namespace jam::inside
