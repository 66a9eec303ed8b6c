// The contact network from positions, diameters and box alone.
#pragma once
#include "network/contact_network.hpp"
#include "network/self_stress.hpp"

namespace jam {

jam_geometry_options default_geometry_options();

struct GeometryResult {
  ContactNetwork network;
  jam_geometry_report report{};
  jam_status status = JAM_OK;  // JAM_OK, JAM_AMBIGUOUS, JAM_NOT_JAMMED
};

GeometryResult contacts_from_geometry(const Packing &p, const jam_geometry_options &o,
                                      const CancellationPoint &cancel_point = CancellationPoint());

// Where the sorted gaps jump, largest jump first: the tolerances that give enough contacts for a rigid network.
struct ContactCandidates {
  std::vector<double> limit, jump;
  std::vector<int32_t> contacts, excess;
};
ContactCandidates contact_candidates(const Packing &p, double window);

// Takes out, again and again, spheres that touch fewer than d + 1 others or whose contact vectors do not span space.
// Contacts of a sphere with its own image constrain nothing and are taken out too.
void remove_rattlers(const Packing &p, ContactNetwork &network);

}  // namespace jam
