// Convex pieces cut by planes x_c = t. Two pieces that share a face get the same corners on it, to the bit, so that the
// surface of both together has no gap after the cut.
#pragma once
#include <array>
#include <vector>

#include "pore/balls.hpp"

namespace jam::inside {

struct Face {
  std::vector<Point> corner;  // counterclockwise seen from outside
  bool surface;               // of the solid; others are shared with a neighbour
};

// Removes the part of the piece on one side of a plane: x_c < t, or with `above` x_c > t. The cut becomes a new face of
// the surface.
void clip(std::vector<Face> &piece, int c, double t, bool above);

}  // namespace jam::inside
