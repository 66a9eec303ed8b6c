// The contact network from positions, diameters and box alone.
#pragma once
#include "network/contact_network.hpp"
#include "network/resolution.hpp"
#include "network/rigidity_test.hpp"

namespace jam::inside {

jam_geometry_options default_geometry_options();

struct GeometryResult {
  ContactNetwork network;
  jam_geometry_report report{};
  Verdict answer_if_closed = Verdict::no;  // with the contacts of the network closed
  bool clear = false;                      // one jump of the gaps stands out
};

GeometryResult contacts_from_geometry(const Packing &p, const jam_geometry_options &o);

// Whether these are the contacts of the packing, whose verdict with gaps as they are is as_it_is: JAM_OK,
// JAM_AMBIGUOUS, JAM_NOT_JAMMED.
jam_status status_of(const GeometryResult &found, Verdict as_it_is, const GapResolution &resolution, const Packing &p);

// Contacts by distance alone: of beds under weight and friction, whose contact forces do not balance as those of
// frictionless spheres do.

// All pairs with h < gap, every image, and walls; forces are NaN.
ContactNetwork contacts_by_distance(const Packing &p, double gap);

}  // namespace jam::inside
