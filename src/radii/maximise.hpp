// jam_maximise_radii: positions and radii of the largest weighted sum of radii, or of the largest common factor of
// moments of the radii, in a fixed cell or one that deforms at fixed volume.
//
//   checks -> radii shrink to open all contacts -> path.cpp at falling mu -> vertex.cpp -> maximum
//                                                      ^                        |  forces do not balance: smaller mu
//                                                      +------------------------+  a saddle: pushed off it, larger mu
#pragma once
#include "core/monitor.hpp"
#include "core/notes.hpp"
#include "network/contact_network.hpp"
#include "radii/rows.hpp"

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

// Options of jam_maximise_radii: defaults, what is refused, and what they name.
jam_radii_options default_radii_options();
// Throws JAM_E_... before any work.
void check_radii(const Packing &p, const jam_radii_options &o, const double *weights, size_t weights_len);
double mean_weight(const double *weights, size_t n);
std::vector<double> exponents_of(const jam_radii_options &o);
RadiiBounds bounds_of(const Packing &p, const jam_radii_options &o);

}  // namespace jam::inside
