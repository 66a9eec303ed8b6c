// The last digits: contacts closed by Newton steps on the positions and one common diameter factor, forces projected on
// the null space of S^T.
#pragma once
#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "crunch/tuning.hpp"
#include "linalg/newton_system.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

enum class PolishEnd { done, no_contacts, interrupted, open_contact, too_few, negative_force, overlap };

// Changes p and contacts only when it returns done: all contacts closed to rounding, no overlap, and for a single
// self-stress all forces positive. A contact too many that does not close with the others is dropped. Where contacts
// still do not close, balance or push, narrow LPs find the vertex (identify.cpp).
// The graph of `system` is replaced.
PolishEnd polish(Packing &p, ContactNetwork &contacts, NewtonSystem &system, int threads, const Tuning &tuning,
                 Monitor *monitor = nullptr);

}  // namespace jam::inside
