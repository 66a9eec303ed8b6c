// A wall as a surface: the distance of a point, the inward normal and how it turns, the area, and when a moving and
// growing sphere meets the surface. Every layer asks these questions, never which surface it is. There are planes, and
// round surfaces about the middle of the first axes: cylinders and balls of one radius, and cones, whose radius is
// linear in z. core/container.hpp joins surfaces to a container.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>

#include "core/double_double.hpp"
#include "jam/jam.h"

namespace jam::inside {

// How a sphere nears a wall: it touches when gap - 2 slope t - bend t^2 has fallen to 0. Of a plane the gap is
// distance - radius; of a round surface, of radius R_c about the origin, (R_c - radius)^2 - |r|^2; of a cone, whose
// generators lean by the angle a, cos^2 a [(R_c(z) - radius / cos a)^2 - |r|^2].
struct Approach {
  double gap, slope, bend, room;  // room: the root of gap at r = 0; 0 of a plane

  // Time of contact from now; infinity without one, 0 for a sphere at the wall that moves towards it.
  double time() const {
    constexpr double never = std::numeric_limits<double>::infinity();
    const double disc = slope * slope + bend * gap;
    if (gap <= 0.0 && slope > 0.0) return 0.0;
    if (slope > 0.0) return disc < 0.0 ? never : gap / (slope + std::sqrt(disc));
    // It recedes: only a round wall comes back to it. Without a root, by rounding, the time of least overlap.
    return bend > 0.0 ? (std::sqrt(disc > 0.0 ? disc : 0.0) - slope) / bend : never;
  }
  // -h of a sphere whose gap is negative.
  double overlap(double radius) const {
    return room > 0.0 ? -gap / ((room + std::sqrt(room * room - gap)) * radius) : -gap / radius;
  }
};

// Where the normal of a contact turns as its sphere moves: the second derivative of the distance is b (P - m m^T), with
// P the unit matrix of `axes` and the unit vector m = lean P n. b is 1 / distance of a pair, -Surface::curvature of a
// wall.
struct Turning {
  uint32_t axes;
  double lean;
  bool along(int c) const { return axes >> c & 1; }
};
constexpr Turning turning_of_pairs{~0u, 1.0};

class Surface {
 public:
  static Surface plane(int dim, int axis, int side, double edge, double area) {
    Surface s(dim, axis, side, area);
    s.edge_ = edge;
    return s;
  }
  static Surface round(int dim, int axes, double radius, double area) {
    Surface s(dim, dim, 1, area);
    s.axes_ = axes, s.radius_ = radius;
    return s;
  }
  // About axis z, d = 3: the radius falls to one half from z = 0 to z = length.
  static Surface cone(double radius, double length, double area) {
    Surface s = round(3, 2, radius, area);
    s.edge_ = length;
    return s;
  }

  // As the columns of jam_walls have them: of a curved surface d, and 1.
  int axis() const { return axis_; }
  int side() const { return side_; }
  double area() const { return area_; }
  // "the wall x = 0". Out of line, as are others below: the loops over pairs ask them of walls alone.
  [[gnu::noinline]] std::string name() const {
    if (curved()) return "the round wall";
    char text[64];
    std::snprintf(text, sizeof text, "the wall %c = %g", dim_ <= 3 ? "xyz"[axis_] : static_cast<char>('0' + axis_),
                  side_ ? edge_ : 0.0);
    return text;
  }
  bool curved() const { return axes_ > 0; }
  Turning turning() const { return {(1u << axes_) - 1u, lean()}; }
  // Directions in which it is curved: a contact with it may hold as much as so many more contacts with a plane.
  int curved_directions() const { return axes_ > 0 ? axes_ - 1 : 0; }

  template <class Real = double>
  Real distance(const double *x) const {
    if (!curved()) return side_ ? Real(edge_) - Real(x[axis_]) : Real(x[axis_]);
    Real r2(0.0);
    for (int c = 0; c < axes_; ++c) r2 = r2 + (Real(x[c]) - Real(radius_)) * (Real(x[c]) - Real(radius_));
    return tapers() ? (radius_at<Real>(x) - square_root(r2)) / lean<Real>() : Real(radius_) - square_root(r2);
  }
  [[gnu::noinline]] void normal(const double *x, double *n) const {
    for (int c = 0; c < dim_; ++c) n[c] = 0.0;
    if (!curved()) {
      n[axis_] = side_ ? -1.0 : 1.0;
      return;
    }
    const double r = from_axis(x);
    if (!(r > 0.0))
      n[0] = cosine();  // at the centre all directions are alike
    else
      for (int c = 0; c < axes_; ++c) n[c] = (radius_ - x[c]) / r * cosine();
    if (tapers()) n[dim_ - 1] = taper() * cosine();
  }
  double curvature(const double *x) const { return curved() ? cosine() / from_axis(x) : 0.0; }
  // How much the distance changes when a point goes from x to x + u, without cancellation. n: the normal there.
  [[gnu::noinline]] double displaced(const double *x, const double *u, double *n) const {
    if (!curved()) {
      normal(x, n);
      return side_ ? -u[axis_] : u[axis_];
    }
    double r2 = 0.0, to2 = 0.0, change = 0.0, to[JAM_MAX_DIM];
    for (int c = 0; c < axes_; ++c) {
      const double r = x[c] - radius_;
      to[c] = r + u[c];
      r2 += r * r, to2 += to[c] * to[c], change += u[c] * (r + to[c]);
    }
    const double length = std::sqrt(to2), both = std::sqrt(r2) + length;
    for (int c = 0; c < dim_; ++c) n[c] = c < axes_ && length > 0.0 ? -to[c] / length * cosine() : 0.0;
    if (!(length > 0.0)) n[0] = cosine();
    if (tapers()) n[dim_ - 1] = taper() * cosine();
    return (taper() * u[dim_ - 1] - (both > 0.0 ? change / both : 0.0)) * cosine();
  }
  // The vector to x from the nearest point of the wall: the r_ij of a contact. Returns its squared length.
  double vector(const double *x, double *r) const {
    const double h = distance(x);
    normal(x, r);
    for (int c = 0; c < dim_; ++c) r[c] *= h;
    return h * h;
  }
  // Of a curved surface, for a sphere at this distance.
  [[gnu::noinline]] Approach approach(const double *x, const double *v, double radius, double growth,
                                      double distance) const {
    double r2 = 0.0, rv = 0.0, vv = 0.0;
    for (int c = 0; c < axes_; ++c) {
      const double r = x[c] - radius_;
      r2 += r * r, rv += r * v[c], vv += v[c] * v[c];
    }
    const double room = radius_at(x) - radius * lean();
    return along_cone((distance - radius) * lean() * (room + std::sqrt(r2)), rv, vv, room,
                      taper() * v[dim_ - 1] - growth * lean());
  }

  // Molecular dynamics: the same from integers that are exact, `edge` those of the cell; an edge of 2^64 is 0.
  template <int D>
  Approach approach(const uint64_t *x, const double *v, int64_t radius, double growth,
                    const std::array<uint64_t, D> &edge) const {
    if (!curved()) {
      const uint64_t away = side_ ? edge[axis_] - x[axis_] : x[axis_];
      const double speed = side_ ? -v[axis_] : v[axis_];
      return {static_cast<double>(static_cast<__int128>(away) - radius), 0.5 * (growth - speed), 0.0, 0.0};
    }
    const uint64_t half = half_of(edge[0]), wall = radius_at<D>(x, edge);
    const __int128 reach = leaning(radius), room = wall - reach;
    unsigned __int128 rest = square(room);
    double rv = 0.0, vv = 0.0;
    for (int c = 0; c < axes_ && c < D; ++c) {
      const auto r = static_cast<int64_t>(x[c] - half);
      rest -= square(r);
      rv += static_cast<double>(r) * v[c];
      vv += v[c] * v[c];
    }
    return along_cone(static_cast<double>(static_cast<__int128>(rest)), rv, vv, static_cast<double>(room),
                      taper() * v[D - 1] - growth * lean());
  }
  // Whether a sphere at rest at x touches the wall, or is too wide for it, so that the gap above has no meaning.
  template <int D>
  bool reached(const uint64_t *x, int64_t radius, const std::array<uint64_t, D> &edge) const {
    const double rest[D] = {};
    return (curved() && leaning(radius) >= radius_at<D>(x, edge)) || approach<D>(x, rest, radius, 0.0, edge).gap < 0.0;
  }
  template <int D>
  void normal(const uint64_t *x, const std::array<uint64_t, D> &edge, double *n) const {
    double r[D], r2 = 0.0;
    for (int c = 0; c < D; ++c) n[c] = 0.0;
    if (!curved()) {
      n[axis_] = side_ ? -1.0 : 1.0;
      return;
    }
    for (int c = 0; c < axes_ && c < D; ++c) {
      r[c] = static_cast<double>(static_cast<int64_t>(x[c] - half_of(edge[0])));
      r2 += r[c] * r[c];
    }
    const double inverse = r2 > 0.0 ? -1.0 / std::sqrt(r2) * cosine() : 0.0;
    for (int c = 0; c < axes_ && c < D; ++c) n[c] = r[c] * inverse;
    if (!(r2 > 0.0)) n[0] = cosine();
    if (tapers()) n[D - 1] = taper() * cosine();
  }

 private:
  Surface(int dim, int axis, int side, double area) : dim_(dim), axis_(axis), side_(side), area_(area) {}
  static double square_root(double x) { return std::sqrt(x); }
  static DoubleDouble square_root(DoubleDouble x) { return jam::inside::square_root(x); }
  // Radius at the height of x.
  template <class Real = double>
  Real radius_at(const double *x) const {
    return tapers() ? Real(radius_) - Real(0.5 * radius_) * Real(x[dim_ - 1]) / Real(edge_) : Real(radius_);
  }
  template <int D>
  uint64_t radius_at(const uint64_t *x, const std::array<uint64_t, D> &edge) const {
    const uint64_t half = half_of(edge[0]);
    if (D < 3 || !tapers()) return half;
    const unsigned __int128 along = static_cast<unsigned __int128>(half / 2) * x[D - 1];
    return half - static_cast<uint64_t>(edge[D - 1] ? along / edge[D - 1] : along >> 64);
  }
  double from_axis(const double *x) const { return radius_at(x) - distance(x) * lean(); }
  // Of a cone, with the angle a of generators and axis: 1 / cos a, cos a, the radius that z adds, a length over cos a.
  bool tapers() const { return axes_ > 0 && edge_ > 0.0; }
  template <class Real = double>
  Real lean() const {
    if (!tapers()) return Real(1.0);
    const Real t = Real(0.5 * radius_) / Real(edge_);
    return square_root(Real(1.0) + t * t);
  }
  double cosine() const { return 1.0 / lean(); }
  double taper() const { return tapers() ? -0.5 * radius_ / edge_ : 0.0; }
  __int128 leaning(int64_t length) const {
    return tapers() ? length * static_cast<__int128>(lean() * 0x1p52) >> 52 : length;
  }
  // room + widening t = |r + v t|, squared, and in lengths along the normal.
  Approach along_cone(double gap, double rv, double vv, double room, double widening) const {
    const double square = cosine() * cosine();
    return {gap * square, (rv - room * widening) * square, (vv - widening * widening) * square, room * cosine()};
  }
  static uint64_t half_of(uint64_t edge) { return edge ? edge / 2 : uint64_t{1} << 63; }
  static unsigned __int128 square(__int128 x) {
    const auto m = static_cast<unsigned __int128>(x < 0 ? -x : x);
    return m * m;
  }

  int dim_, axis_, side_, axes_ = 0;         // axes_ > 0: curved, about the middle of the first so many axes
  double area_, edge_ = 0.0, radius_ = 0.0;  // of a cone its length and largest radius
};

}  // namespace jam::inside
