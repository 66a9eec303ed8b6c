// Jamming from a part of the contacts: a set K with a positive self-stress whose rows hold their spheres B rigidly.
// B then balances any load, so that every contact within B carries force too, however weak. The rest is tested with B
// as one body. This decides networks with forces of 1e-8 of the mean, where no certificate of all contacts at once
// is above rounding.
#pragma once
#include "network/rigidity_test.hpp"
#include "network/stress_cone.hpp"

namespace jam::inside {

// sub: contacts of spheres that may carry force. cone: undecided, with its positive set. False: K is not rigid. True:
// the verdict on sub is in `out`, its flags, forces and flex on contacts and nodes of sub.
bool test_from_rigid_part(const RigidityMatrix &sub, const StressCone &cone, Jamming kind, RigidityResult &out);

}  // namespace jam::inside
