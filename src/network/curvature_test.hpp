// Whether the curvature of a round wall holds the flexes of a network with a positive stress.
#pragma once
#include <vector>

#include "network/rigidity_test.hpp"

namespace jam::inside {

// carrying: K+ of `out`, with its forces and flexes. The first flex becomes that which curvature holds least.
void test_prestress_stability(const RigidityMatrix &carrying, const std::vector<double> &force,
                              std::vector<std::vector<double>> &flexes, RigidityResult &out);

// Whether forces times second derivatives of distances are positive along a motion of the nodes of the matrix of which
// `carrying` is a part, a flex of that part.
bool opens_by_curvature(const RigidityMatrix &carrying, const std::vector<double> &force,
                        const std::vector<double> &motion);

}  // namespace jam::inside
