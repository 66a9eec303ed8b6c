// Every number that steers the analysis of the pore space.
#pragma once

namespace jam::inside {

// Boxes that find spheres near a point.
struct BallsTuning {
  static constexpr double most_cells = 1000.0;  // along an edge
  // The unit of lengths over the mean distance of small spheres, and the edge of a box over the reach of a search. Half
  // of each: a search then visits at most some five boxes along an axis.
  static constexpr double of_distance = 0.5, of_reach = 0.5;
};

struct SolidTuning {
  // Spheres overlap, or pass a wall, from this depth over the smaller radius on. The volume that is then counted twice
  // is below rounding: its share is the square of the depth.
  static constexpr double overlap = 1e-9;
};

struct CutTuning {
  static constexpr double parallel = 1e-12;  // sine of the angle below which two planes count as parallel
  // Volumes in a cylinder, over the cube of the radius: the quadrature halves intervals until this is reached, at most
  // so many times.
  static constexpr double error = 1e-12;
  static constexpr int halvings = 24;
};

struct MeshTuning {
  // What options may be: edges over the radius, where triangles become too many or too coarse, and bridges.
  static constexpr double shortest_edge = 0.03, thinnest_bridge = 0.02, widest_bridge = 0.45;
  // Points of the grid this near to a contact or a rim, in edges, give way to it.
  static constexpr double clear_of_points = 0.5;
  static constexpr double between_rims = 0.01;  // least angle of two
  // The circle in which two spheres overlap: in edges, below which it is one point; over the smaller radius, beyond
  // which that sphere has too little left around its centre.
  static constexpr double narrowest_circle = 0.25, widest_circle = 0.98;
  static constexpr double same_centre = 1e-6;  // of the length of a joint: an image of its partner, not a third sphere
  // Corners of a round wall: its edges have the length of those of the largest sphere.
  static constexpr double fewest_corners = 24.0, most_corners = 4096.0;
  // Edges of a triangle, in steps of the floats of the file: shorter ones have errors of a per cent.
  static constexpr double least_steps = 100.0;
  // Estimate of triangles that a plane passes on a sphere of T: so many times sqrt(T) r, where it cuts the sphere in a
  // circle of r radii. A line on equilateral triangles of edge e passes one for each 0.453 e (mean chord of a convex
  // area: pi A / P), and e = sqrt(16 pi / (sqrt(3) T)) radii.
  static constexpr double passed = 2.57;
};

// Tanh-sinh quadrature: points on either side, and their distance. Shells of a cylinder are right to 1e-12.
struct QuadratureTuning {
  static constexpr int steps = 28;
  static constexpr double step = 0.125;
};

struct VoxelTuning {
  static constexpr double default_size = 0.01, most = 100000.0;  // V^(1/d); voxels along an edge
};

// Spheres that touch the wall of a cylinder.
struct TubeTuning {
  static constexpr double flat = 1e-9;          // sine below which two directions count as parallel
  static constexpr double double_root = 1e-10;  // of the sum of the terms of a polynomial that touches 0
  static constexpr int bisections = 60, newton_steps = 4;
  // Around the wall, between which widest spheres are searched; near the base denser by the factor exp(denser).
  static constexpr int azimuths = 64;
  static constexpr double denser = 8.0;
};

struct PoreSizeTuning {
  static constexpr double rounding = 1e-9;          // of lengths, over the spacing
  static constexpr double grid = 5.0;               // points for each spacing, from which the largest pore is bounded
  static constexpr int64_t most_misses = 10000000;  // random points in the solid, one after the other
  static constexpr double flat = 1e-3;              // sine below which three directions lie nearly in a plane
};

}  // namespace jam::inside
