// Convex pieces cut by planes x_c = t. Neighbours that share a face get the same points on it to the bit, so that what
// is left stays closed.
#pragma once
#include <array>
#include <vector>

#include "pore/balls.hpp"

namespace jam::inside {

struct Face {
  std::vector<Point> corner;  // counterclockwise seen from outside
  bool surface;               // of the solid; others are shared with a neighbour
};

// Cuts away what lies beyond the plane: x_c < t, or with `above` x_c > t. The cut is a new face of the surface.
void clip(std::vector<Face> &piece, int c, double t, bool above);

}  // namespace jam::inside
