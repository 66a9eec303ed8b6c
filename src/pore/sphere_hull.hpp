// Triangles of a sphere: the convex hull of points on it, which is their Delaunay triangulation.
#pragma once
#include "pore/balls.hpp"

namespace jam::inside {

using Triangle = std::array<int32_t, 3>;  // counterclockwise seen from outside

struct SphereGrid {
  std::vector<Point> point;  // unit vectors
  std::vector<Triangle> triangle;
};
// An icosahedron whose faces are divided until no edge is longer, in radii.
SphereGrid divided_icosahedron(double edge);

// Hull of unit vectors that surround the origin, no two nearer than 1e-4. Points are rounded to 2^-19 to decide what
// lies on which side, in integers, so that the surface is closed whatever the points are.
std::vector<Triangle> sphere_hull(const std::vector<Point> &point);

// Convex pieces cut by planes x_c = t. Two pieces that share a face get the same corners on it, to the bit, so that the
// surface of both together has no gap after the cut.
struct Face {
  std::vector<Point> corner;  // counterclockwise seen from outside
  bool surface;               // of the solid; others are shared with a neighbour
};

// Removes the part of the piece on one side of a plane: x_c < t, or with `above` x_c > t. The cut becomes a new face of
// the surface.
void clip(std::vector<Face> &piece, int c, double t, bool above);

}  // namespace jam::inside
