// Spheres inside a cylinder that touch its wall and further surfaces. A sphere that touches the wall at the azimuth phi
// has its centre at axis + (R_c - r) e(phi) + z; squared terms in r then cancel in the condition of touching a ball, so
// that r is a parabola in z, and a second surface gives z by a quadratic equation.
#pragma once
#include <array>
#include <limits>
#include <vector>

#include "pore/touching_spheres.hpp"

namespace jam::inside {

class Tube {
 public:
  // The axis goes through (radius, radius).
  explicit Tube(double radius) : radius_(radius) {}
  double radius() const { return radius_; }
  // Appends the spheres that touch the wall, the base and both rows.
  void touching(const Ball &base, const Row &i, const Row &j, std::vector<Ball> &out) const;
  // Appends those that touch the wall, the base and the row, and are the widest among their neighbours that do.
  void widest(const Ball &base, const Row &i, std::vector<Ball> &out) const;
  // Appends the spheres about the axis, as wide as the cylinder, that touch the base.
  void about_axis(const Ball &base, std::vector<Ball> &out) const;

 private:
  std::vector<double> azimuths_for(const Ball &base) const;
  void touching_flat(const Ball &base, const Row &i, const Row &j, std::vector<Ball> &out) const;
  void touching_in_line(const Ball &base, const Row &i, const Row &j, std::vector<Ball> &out) const;
  double radius_;
};

// Real roots in [low, high] of a polynomial, lowest coefficient first, ascending; places where it only touches 0 too.
std::vector<double> real_roots(const std::vector<double> &coefficient, double low, double high);

}  // namespace jam::inside
