// From the interior point's answer to an exact vertex. Doubles cannot tell a weak contact from a narrow gap: a force of
// 1e-7 across a gap of 1e-8 is below the tolerance of an LP. Clear contacts are held closed, clear gaps open; a small
// LP settles the rest exactly.
#pragma once
#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "crunch/gap_rows.hpp"
#include "crunch/tuning.hpp"
#include "lp/newton_system.hpp"
#include "network/contact_network.hpp"

namespace jam {

struct Vertex {
  ContactNetwork net;  // forces (mean 1) balance to rounding at the given positions, none is negative; a few contacts
                       // may be open
  Motion step;         // closes these to first order
  double open = 0.0;   // gaps weighted by forces: by weak duality no motion lets the diameters grow by more
};

// p: contacts closed, no overlap. net: its contacts with forces, right but for the undecided; some may be missing. The
// graph of `system` is replaced. False: none found, or interrupted.
bool find_vertex(const Packing &p, const ContactNetwork &net, NewtonSystem &system, int threads, const Tuning &tuning,
                 Monitor *monitor, Vertex &out);

}  // namespace jam
