#include "pore/pore_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "jam/jam.h"
#include "pore/balls.hpp"
#include "pore/tube_spheres.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = PoreSizeTuning::rounding;

Row touching(const Ball &base, const Ball &ball) {
  const Point d = minus(ball.x, base.x);
  return {d, ball.r - base.r, 0.5 * (dot(d, d) - ball.r * ball.r + base.r * base.r)};
}
Row in_plane(const Point &normal) { return {normal, 0.0, 0.0}; }
// Touching wall w from inside: a flat one has a distance linear in c, a round one is a ball of negative radius.
Row touching_wall(const Ball &base, const Container &container, int w) {
  Point n{};
  container.normal(w, base.x.data(), n.data());
  const double distance = container.distance(w, base.x.data());
  if (!container.is_round(w)) return {n, -1.0, -distance};
  const double radius = 0.5 * container.widest(), off = radius - distance;
  return touching(base, {{base.x[0] + off * n[0], base.x[1] + off * n[1], base.x[2] + off * n[2]}, -radius});
}
// The plane through the point of a row's base and two directions; of opposite walls, any plane across them.
Row in_plane_of(const Row &i, const Row &j) {
  const Point normal = cross(i.d, j.d);
  if (dot(normal, normal) > 0.0) return in_plane(normal);
  return in_plane(i.d[2] == 0.0 ? Point{0.0, 0.0, 1.0} : Point{1.0, 0.0, 0.0});
}

// The same where directions of rows lie nearly in a plane, as those of opposite walls do: then c hardly follows from r.
// Centre and radius follow from the coordinate along which all rows change least.
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
    if (std::fabs(t) < infinite && r > 0.0 && r + base.r > 0.0)
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
    if (r > 0.0 && r < infinite)
      f(Ball{{base.x[0] + u[0] + w[0] * r, base.x[1] + u[1] + w[1] * r, base.x[2] + u[2] + w[2] * r}, r});
}

// On the line of the base and the direction of a row.
template <class F>
void solve_on_line(const Ball &base, const Row &i, const F &f) {
  const bool upright = i.d[0] == 0.0 && i.d[1] == 0.0;
  const Point across = cross(i.d, upright ? Point{1.0, 0.0, 0.0} : Point{0.0, 0.0, 1.0});
  solve(base, i, in_plane(across), in_plane(cross(i.d, across)), f);
}

class Pores {
 public:
  explicit Pores(const Packing &p)
      : p_(p), length_(spacing(p)), most_(bound_radius()), balls_(p, 2.0 * most_ + 0.5 * diameter_max(p)) {
    find_vertices();
  }
  // Distance to the nearest surface of a sphere or a wall, negative in the solid.
  double clearance(const Point &x) const { return to_walls(p_, x, balls_.clearance(x, 2.0 * most_)); }
  double largest_at(const Point &x);

 private:
  static double to_walls(const Packing &p, const Point &x, double least) {
    for (int w = 0; w < p.container.count(); ++w) least = std::min(least, p.container.distance(w, x.data()));
    return least;
  }
  // Rows of the surfaces that a sphere which touches the base can touch too: of `near_` and of walls.
  void take_rows(const Ball &base) {
    row_.clear();
    for (const Ball &b : near_) row_.push_back(touching(base, b));
    for (int w = 0; w < p_.container.count(); ++w)
      if (p_.container.distance(w, base.x.data()) <= base.r + 2.0 * most_ && !(in_tube() && p_.container.is_round(w)))
        row_.push_back(touching_wall(base, p_.container, w));
  }
  bool in_tube() const { return p_.dim == 3 && p_.container.round_axes() == 2; }
  // Calls f with the spheres that touch the wall of a cylinder, the base and rows of it.
  template <class F>
  void solve_in_tube(const Ball &base, const F &f);
  // A round wall bends towards the void: a sphere that touches it is widest with one surface less, in the plane or on
  // the line of the others. Its row is the last.
  bool curved() const { return p_.container.round_axes() > 0 && !in_tube() && row_.size() > near_.size(); }
  void keep_between_walls();
  void keep_at_ends();
  // No pore is wider: clearance grows by no more than the way from the nearest point of a grid.
  double bound_radius() const;
  void find_vertices();
  bool is_free(const Ball &s, const std::vector<Ball> &near) const {
    for (const Ball &b : near) {
      const Point d = minus(b.x, s.x);
      const double least = s.r + b.r - rounding * length_;
      if (dot(d, d) < least * least) return false;
    }
    return to_walls(p_, s.x, s.r) >= s.r - rounding * length_;
  }
  const Packing &p_;
  double length_, most_;
  Balls balls_;
  std::vector<Ball> near_;
  std::vector<Row> row_;  // of near_, then of walls
  std::vector<Ball> found_;
  std::vector<Ball> vertex_;
  std::vector<std::vector<int32_t>> vertices_at_;  // those that reach into each box of balls_
};

double Pores::bound_radius() const {
  constexpr double steps = PoreSizeTuning::grid;
  std::array<int64_t, 3> count{1, 1, 1};
  Point step{};
  for (int c = 0; c < p_.dim; ++c) {
    count[c] = static_cast<int64_t>(std::ceil(p_.cell.edge(c) * steps / length_));
    step[c] = p_.cell.edge(c) / static_cast<double>(count[c]);
  }
  for (double reach = length_;; reach *= 2.0) {  // until a surface is in reach of every point
    const Balls balls(p_, reach);
    double most = 0.0;
    for (int64_t z = 0; z < count[2]; ++z)
      for (int64_t y = 0; y < count[1]; ++y) {
        CallScope::look();
        for (int64_t x = 0; x < count[0]; ++x) {
          const auto at = [&](int64_t k, int c) { return (static_cast<double>(k) + 0.5) * step[c]; };
          const Point here{at(x, 0), at(y, 1), p_.dim == 3 ? at(z, 2) : 0.0};
          most = std::max(most, to_walls(p_, here, balls.clearance(here, reach)));
        }
      }
    if (most < reach) return most + 0.5 * std::sqrt(dot(step, step)) + rounding * length_;  // lattices reach the bound
  }
}

// Spheres that touch d + 1 surfaces: where clearance is largest. Found from the ball of lowest number among them.
void Pores::find_vertices() {
  const std::vector<Row> &rows = row_;
  std::vector<Ball> others;
  for (size_t i = 0; i < p_.n(); ++i) {
    CallScope::look();
    const Ball base = balls_.primary(i);
    balls_.near(base.x, base.r + 2.0 * most_, near_, static_cast<int32_t>(i));
    take_rows(base);
    balls_.near(base.x, base.r + 2.0 * most_, others);
    const auto keep = [&](const Ball &s) {
      if (s.r <= most_ && is_free(s, others)) vertex_.push_back(s);
    };
    for (size_t a = 0; a < rows.size(); ++a) {
      CallScope::look();
      for (size_t b = a + 1; b < rows.size(); ++b)
        if (p_.dim == 2)
          solve(base, rows[a], rows[b], in_plane({0.0, 0.0, 1.0}), keep);
        else
          for (size_t c = b + 1; c < rows.size(); ++c) solve(base, rows[a], rows[b], rows[c], keep);
    }
    if (in_tube()) solve_in_tube(base, keep);
    if (!curved()) continue;
    for (size_t a = 0; p_.dim == 3 && a < near_.size(); ++a)
      solve(base, rows[a], rows.back(), in_plane_of(rows[a], rows.back()), keep);
    solve_on_line(base, rows.back(), keep);
  }
  keep_between_walls();
  keep_at_ends();
  balls_.sort_into_boxes(vertex_, vertices_at_);
}

template <class F>
void Pores::solve_in_tube(const Ball &base, const F &f) {
  const Tube tube(0.5 * p_.cell.edge(0));
  found_.clear();
  tube.about_axis(base, found_);
  for (size_t a = 0; a < row_.size(); ++a) {
    CallScope::look();
    tube.widest(base, row_[a], found_);
    for (size_t b = a + 1; b < row_.size(); ++b) tube.touching(base, row_[a], row_[b], found_);
  }
  for (const Ball &s : found_) f(s);
}

// Spheres that touch walls alone, in a closed brick: opposite ones along an axis, and one along each other.
void Pores::keep_between_walls() {
  if (p_.container.round_axes() > 0 || p_.container.open_axes() > 0) return;
  for (int axis = 0; axis < p_.dim; ++axis)
    for (int sides = 0; sides < 1 << p_.dim; ++sides) {
      if (sides >> axis & 1) continue;
      Ball s{{}, 0.5 * p_.cell.edge(axis)};
      for (int c = 0; c < p_.dim; ++c) s.x[static_cast<size_t>(c)] = sides >> c & 1 ? p_.cell.edge(c) - s.r : s.r;
      balls_.near(s.x, s.r, near_);
      if (is_free(s, near_)) vertex_.push_back(s);
    }
}

// Spheres as wide as a cylinder at its flat ends.
void Pores::keep_at_ends() {
  if (!in_tube() || p_.cell.repeats(2)) return;
  const double radius = 0.5 * p_.cell.edge(0);
  for (const double z : {radius, p_.cell.edge(2) - radius}) {
    const Ball s{{radius, radius, z}, radius};
    balls_.near(s.x, s.r, near_);
    if (is_free(s, near_)) vertex_.push_back(s);
  }
}

double Pores::largest_at(const Point &x) {
  const Ball point{x, 0.0};
  double best = clearance(x);
  for (const int32_t v : vertices_at_[balls_.box_of(x)]) {
    const Ball &s = vertex_[static_cast<size_t>(v)];
    const Point d = minus(s.x, x);
    if (s.r > best && dot(d, d) <= s.r * s.r) best = s.r;
  }
  balls_.near(x, 2.0 * most_, near_);
  take_rows(point);
  const auto keep = [&](const Ball &s) {
    const Point d = minus(s.x, x);
    const double reach = s.r + rounding * length_;  // Newton's steps may end at another sphere
    if (s.r > best && s.r <= most_ && dot(d, d) <= reach * reach && is_free(s, near_)) best = s.r;
  };
  for (size_t a = 0; a < row_.size(); ++a) {
    CallScope::look();
    for (size_t b = a + 1; b < row_.size(); ++b) {
      solve(point, row_[a], row_[b], in_plane_of(row_[a], row_[b]), keep);
      for (size_t c = b + 1; p_.dim == 3 && c < row_.size(); ++c) solve(point, row_[a], row_[b], row_[c], keep);
    }
  }
  if (curved()) solve_on_line(point, row_.back(), keep);
  if (in_tube()) {
    const double radius = 0.5 * p_.cell.edge(0);
    keep({{radius, radius, x[2]}, radius});
    solve_in_tube(point, keep);
  }
  return best;
}

}  // namespace

void check_pore_points(const Packing &p, int64_t points) {
  check_has_pores(p);
  if (points < 1 || points > 1000000000)
    fail(JAM_E_ARGUMENT, "points is %lld, it must be in 1..1e9", static_cast<long long>(points));
}

std::vector<std::array<double, 5>> pore_sizes(const Packing &p, int64_t points, int64_t seed) {
  Pores pores(p);
  Rng rng(seed, Stream::pore_points);
  std::vector<std::array<double, 5>> out;
  int64_t misses = 0;
  while (static_cast<int64_t>(out.size()) < points) {
    CallScope::report_share(static_cast<int64_t>(out.size()),
                            static_cast<double>(out.size()) / static_cast<double>(points));
    Point x{};
    for (int c = 0; c < p.dim; ++c) x[c] = rng.uniform() * p.cell.edge(c);
    const double clear = pores.clearance(x);
    if (!(clear > 0.0)) {  // in the solid, or outside of a round wall
      if (++misses > PoreSizeTuning::most_misses)
        fail(JAM_E_STATE, "there is no void: %lld random points in turn lie in spheres",
             static_cast<long long>(misses));
      continue;
    }
    misses = 0;
    const double z = p.dim == 3 ? x[2] : std::numeric_limits<double>::quiet_NaN();
    out.push_back({x[0], x[1], z, clear, pores.largest_at(x)});
  }
  return out;
}

}  // namespace jam::inside
