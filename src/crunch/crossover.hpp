// From the interior point's answer to an exact vertex. Of some hundred weak contacts and narrow gaps an LP in doubles
// cannot tell which are closed: a force of 1e-7 across a gap of 1e-8 is below its tolerance. All others it can, so they
// are held as they are and the few are settled by a small LP of their own.
#pragma once
#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "crunch/gap_rows.hpp"
#include "lp/newton_system.hpp"
#include "network/contact_network.hpp"

namespace jam {

struct Vertex {
  ContactNetwork net;  // forces (mean 1) that balance to rounding at the positions given, none of them pulls; a few
                       // contacts may be open
  Motion step;         // closes those, to first order
  double open = 0.0;   // gaps weighted by forces: no motion lets the diameters grow by more, by weak duality
};

// p: contacts closed, no overlap. net: its contacts with forces, right but for the undecided, of which some may be
// missing. system is used anew. False: none found.
bool find_vertex(const Packing &p, const ContactNetwork &net, NewtonSystem &system, int threads, Monitor *monitor,
                 Vertex &out);

}  // namespace jam
