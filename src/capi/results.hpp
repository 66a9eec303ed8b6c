// What calls found out about the packing that a handle holds now. It is one value: every call that moves spheres clears
// all of it (jam_system::commit), copies and checkpoints take all of it.
#pragma once
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/archive.hpp"
#include "crunch/record.hpp"
#include "jam/jam.h"
#include "network/contact_network.hpp"
#include "soft/shear.hpp"

namespace jam::inside {

struct Results {
  ContactNetwork contacts;  // of the report, or by distance; ask known_contacts or contacts_of_any_kind
  // Contacts are all pairs within this gap (jam_contacts_by_distance): without forces and without a report. NaN: not
  // so.
  double contact_gap = std::numeric_limits<double>::quiet_NaN();
  jam_crunch_report report{};
  bool has_report = false;
  std::vector<HistoryRow> history;  // of the crunch that led here; valid when has_history
  bool has_history = false;
  std::vector<KeptStep> kept_steps;     // of the same crunch; empty unless requested
  std::vector<ShearRow> shear_history;  // of the shear that led here; empty without one, not in checkpoints
  std::vector<SoftRow> soft_history;    // of the decompression that led here; empty without one

  // The contacts of a network that balances. NULL where no call searched for them, or a crunch was stopped before it
  // knew them.
  const ContactNetwork *known_contacts() const { return has_report && report.rattlers >= 0 ? &contacts : nullptr; }
  bool by_distance() const { return std::isfinite(contact_gap); }
  const ContactNetwork *contacts_of_any_kind() const { return by_distance() ? &contacts : known_contacts(); }
  void take_contacts_by_distance(ContactNetwork &&found, double gap) {
    contacts = std::move(found), contact_gap = gap;
    report = {}, has_report = false;
  }

  // results_archive.cpp. Reading throws JAM_E_FORMAT unless they fit the packing p.
  void archive(Archive &a, const Packing &p);
};

}  // namespace jam::inside
