// Motions of parts of a network that keep all distances at any amplitude: two parts that no contact joins slide past
// each other.
#pragma once
#include <cstdint>
#include <vector>

#include "network/rigidity_matrix.hpp"

namespace jam::inside {

// Independent ones beyond the motions of the whole, and one of them (nodes, dim). A part translates along an axis
// on which it touches no wall, or rotates about the centre of a round wall: there all contacts with a sphere in the
// middle stay closed too.
struct Slides {
  int64_t count = 0;
  std::vector<double> motion;
};
Slides find_slides(const RigidityMatrix &g);

}  // namespace jam::inside
