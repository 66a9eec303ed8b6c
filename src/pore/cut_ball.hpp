// Balls cut by half-spaces, and by one more ball or a cylinder: their volumes, in closed form except for the cylinder.
#pragma once
#include <vector>

#include "pore/balls.hpp"

namespace jam::inside {

// The points x with normal . x <= offset; |normal| = 1. x counts from the centre of the ball. In d = 2 normal[2] is 0.
struct HalfSpace {
  Point normal;
  double offset;
};
// As seen from another origin.
HalfSpace seen_from(const Point &origin, const HalfSpace &h);
// Points of smaller power |x - c|^2 - R^2 about the origin, of radius R = `own`, than about `centre` with `radius`.
// Where the two centres are one point, all of them or none. `first` decides between equal balls.
HalfSpace nearer_by_power(double own, const Point &centre, double radius, bool first);

// Volume (d = 2: area) of the part of a ball that lies in all half-spaces.
double cut_volume(int dim, double radius, const std::vector<HalfSpace> &cuts);
// The same within one more ball.
double cut_volume_in_ball(int dim, double radius, const std::vector<HalfSpace> &cuts, const Ball &other);
// The same in d = 3 within a cylinder about a line through `axis.x` along z, by quadrature: CutTuning::error.
double cut_volume_in_cylinder(double radius, const std::vector<HalfSpace> &cuts, const Ball &axis);

}  // namespace jam::inside
