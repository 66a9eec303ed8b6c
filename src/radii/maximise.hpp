// jam_maximise_radii: positions and radii of the largest weighted sum of radii, or of the largest common factor of
// moments of the radii, in a fixed cell or one that deforms at fixed volume.
//
//   checks -> radii shrink to open all contacts -> path.hpp at falling mu -> vertex.hpp -> maximum
//                                                      ^                        |  forces do not balance: smaller mu
//                                                      +------------------------+  a saddle: pushed off it, larger mu
#pragma once
#include <string>
#include <vector>

#include "core/monitor.hpp"
#include "core/notes.hpp"
#include "core/packing.hpp"
#include "jam/jam.h"
#include "network/contact_network.hpp"

namespace jam::inside {

struct RadiiResult {
  Packing packing;          // valid whatever the status
  ContactNetwork contacts;  // of a maximum: pairs that carry force, mean 1
  jam_radii_report report{};
  jam_status status = JAM_OK;
  std::string text;
  Notes notes;
};
RadiiResult maximise_radii(const Packing &start, const jam_radii_options &o, const double *weights, Monitor &monitor);

}  // namespace jam::inside
