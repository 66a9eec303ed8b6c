// Spheres inside a cylinder that touch its wall and further surfaces. A sphere that touches the wall at the azimuth phi
// has its centre at axis + (R_c - r) e(phi) + z; squared terms in r then cancel in the condition of touching a ball, so
// that r is a parabola in z, and a second surface gives z by a quadratic equation.
#pragma once
#include <cmath>
#include <limits>

#include "core/container.hpp"
#include "pore/balls.hpp"

namespace jam::inside {

// Spheres that touch several balls and walls.

// One equation d . c + q r = b for the centre c and radius r of a sphere that touches a surface; c from a base point.
struct Row {
  Point d;
  double q, b;
};
inline Row touching(const Ball &base, const Ball &ball) {
  const Point d = minus(ball.x, base.x);
  return {d, ball.r - base.r, 0.5 * (dot(d, d) - ball.r * ball.r + base.r * base.r)};
}
inline Row in_plane(const Point &normal) { return {normal, 0.0, 0.0}; }
// Touching wall w from inside: a flat one has a distance linear in c, a round one is a ball of negative radius.
inline Row touching_wall(const Ball &base, const Container &container, int w) {
  Point n{};
  container[w].normal(base.x.data(), n.data());
  const double distance = container[w].distance(base.x.data());
  if (!container[w].curved()) return {n, -1.0, -distance};
  const double radius = 0.5 * container.widest(), off = radius - distance;
  return touching(base, {{base.x[0] + off * n[0], base.x[1] + off * n[1], base.x[2] + off * n[2]}, -radius});
}
// The plane through the point of a row's base and two directions; of opposite walls, any plane across them.
inline Row in_plane_of(const Row &i, const Row &j) {
  const Point normal = cross(i.d, j.d);
  if (dot(normal, normal) > 0.0) return in_plane(normal);
  return in_plane(i.d[2] == 0.0 ? Point{0.0, 0.0, 1.0} : Point{1.0, 0.0, 0.0});
}

// The same where directions of rows lie nearly in a plane, as those of opposite walls do. There rounding would spoil a
// centre computed from the radius, so centre and radius are computed from one coordinate of the centre, or from the
// radius: the one whose minor of the rows is largest.
template <class F>
void solve_flat(const Ball &base, const std::array<Row, 3> &row, const F &f) {
  const auto column = [&](size_t c) {
    return c == 3 ? Point{row[0].q, row[1].q, row[2].q} : Point{row[0].d[c], row[1].d[c], row[2].d[c]};
  };
  const auto minor = [&](size_t free) {
    return dot(column((free + 1) % 4), cross(column((free + 2) % 4), column((free + 3) % 4)));
  };
  size_t free = 0;
  for (size_t c = 1; c < 4; ++c)
    if (std::fabs(minor(c)) > std::fabs(minor(free))) free = c;
  const double det = minor(free);
  if (det == 0.0) return;
  const Point right{row[0].b, row[1].b, row[2].b}, last = column(free);
  std::array<double, 4> u{}, w{};
  for (size_t k = 1; k < 4; ++k) {  // Cramer's rule; the order of three columns turns in a circle
    const Point next = column((free + 1 + k % 3) % 4), other = column((free + 1 + (k + 1) % 3) % 4);
    u[(free + k) % 4] = dot(right, cross(next, other)) / det;
    w[(free + k) % 4] = -dot(last, cross(next, other)) / det;
  }
  w[free] = 1.0;
  const double reach = u[3] + base.r;
  const double a = w[0] * w[0] + w[1] * w[1] + w[2] * w[2] - w[3] * w[3],
               half = u[0] * w[0] + u[1] * w[1] + u[2] * w[2] - reach * w[3],
               rest = u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - reach * reach;
  const double disc = half * half - a * rest;
  if (!(disc >= 0.0)) return;
  const double root = -(half + std::copysign(std::sqrt(disc), half));
  for (const double t : {rest / root, root / a}) {
    const double r = u[3] + t * w[3];
    if (std::fabs(t) < std::numeric_limits<double>::infinity() && r > 0.0 && r + base.r > 0.0)
      f(Ball{{base.x[0] + u[0] + t * w[0], base.x[1] + u[1] + t * w[1], base.x[2] + u[2] + t * w[2]}, r});
  }
}

// Calls f with each sphere of positive radius that solves three rows and touches the base (of radius 0: passes
// through it). The rows give c = u + w r, and |c| = r + R of the base is quadratic in r.
template <class F>
void solve(const Ball &base, const Row &i, const Row &j, const Row &k, const F &f) {
  const Point jk = cross(j.d, k.d), ki = cross(k.d, i.d), ij = cross(i.d, j.d);
  const double det = dot(i.d, jk);
  const double size2 = dot(i.d, i.d) * dot(j.d, j.d) * dot(k.d, k.d);
  if (!(det * det > PoreSizeTuning::flat * PoreSizeTuning::flat * size2)) return solve_flat(base, {i, j, k}, f);
  Point u, w;
  for (size_t c = 0; c < 3; ++c) {
    u[c] = (i.b * jk[c] + j.b * ki[c] + k.b * ij[c]) / det;
    w[c] = -(i.q * jk[c] + j.q * ki[c] + k.q * ij[c]) / det;
  }
  const double a = dot(w, w) - 1.0, half = dot(u, w) - base.r, rest = dot(u, u) - base.r * base.r;
  const double disc = half * half - a * rest;
  if (!(disc >= 0.0)) return;
  const double root = -(half + std::copysign(std::sqrt(disc), half));  // no difference of near numbers
  for (const double r : {rest / root, root / a})
    if (r > 0.0 && r < std::numeric_limits<double>::infinity())
      f(Ball{{base.x[0] + u[0] + w[0] * r, base.x[1] + u[1] + w[1] * r, base.x[2] + u[2] + w[2] * r}, r});
}

// On the line of the base and the direction of a row.
template <class F>
void solve_on_line(const Ball &base, const Row &i, const F &f) {
  const bool upright = i.d[0] == 0.0 && i.d[1] == 0.0;
  const Point across = cross(i.d, upright ? Point{1.0, 0.0, 0.0} : Point{0.0, 0.0, 1.0});
  solve(base, i, in_plane(across), in_plane(cross(i.d, across)), f);
}

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
