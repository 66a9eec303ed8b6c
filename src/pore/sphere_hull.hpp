// Triangles of a sphere: the convex hull of points on it, which is their Delaunay triangulation.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

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

}  // namespace jam::inside
