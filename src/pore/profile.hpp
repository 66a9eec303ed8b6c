// Solid fraction in slabs and shells, by the exact volumes of balls cut by planes, balls and cylinders. Where spheres
// overlap, or pass a wall, it is that of their union inside the container.
#pragma once
#include <vector>

#include "core/packing.hpp"

namespace jam::inside {

// Volume (d = 2: area) of the part of a ball of this radius where x < t; the centre is at 0.
double volume_below(int dim, double radius, double t);
// Volume that two balls share, whose centres are `apart`.
double shared_volume(int dim, double a, double b, double apart);
// Volume that a ball and an infinite cylinder share; d = 3, centre `apart` from the axis. To 1e-12 of the ball.
double shared_with_cylinder(double ball, double cylinder, double apart);

struct Profile {
  std::vector<double> low, high, solid;
};
// axis < d: slabs between the faces of the cell that a_axis joins, by their distance; axis == d: shells about the
// centre of a ball or the axis of a cylinder. JAM_E_UNSUPPORTED for shells without a round container.
void check_solid_profile(const Packing &p, int axis, int bins);  // before the work
Profile solid_profile(const Packing &p, int axis, int bins);

}  // namespace jam::inside
