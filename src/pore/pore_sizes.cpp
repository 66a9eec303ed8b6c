#include "pore/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "pore/tube_spheres.hpp"

namespace jam::inside {
namespace {

constexpr double rounding = PoreSizeTuning::rounding;

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
    for (int w = 0; w < p.container.count(); ++w) least = std::min(least, p.container[w].distance(x.data()));
    return least;
  }
  // Rows of the surfaces that a sphere which touches the base can touch too: of `near_` and of walls.
  void take_rows(const Ball &base) {
    row_.clear();
    for (const Ball &b : near_) row_.push_back(touching(base, b));
    for (int w = 0; w < p_.container.count(); ++w)
      if (p_.container[w].distance(base.x.data()) <= base.r + 2.0 * most_ && !(in_tube() && p_.container[w].curved()))
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
  // Whether one pore may touch two surfaces. Walls are not asked.
  bool may_share(size_t a, size_t b) const {
    if (std::max(a, b) >= near_.size()) return true;
    const Point d = minus(near_[a].x, near_[b].x);
    const double most = near_[a].r + near_[b].r + 2.0 * most_ + rounding * length_;
    return dot(d, d) <= most * most;
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
    const auto clear = [&](int64_t x, int64_t y, int64_t z) {
      const auto at = [&](int64_t k, int c) { return (static_cast<double>(k) + 0.5) * step[c]; };
      const Point here{at(x, 0), at(y, 1), p_.dim == 3 ? at(z, 2) : 0.0};
      return to_walls(p_, here, balls.clearance(here, reach));
    };
    // Blocks of three points along each axis: the middle ones first, then the blocks that may have a better one.
    std::vector<double> middle;
    double most = 0.0;
    const auto middle_of = [&](int64_t first, int c) { return std::min(first + 1, count[c] - 1); };
    const auto each_block = [&](const auto &f) {
      for (int64_t z = 0; z < count[2]; z += 3)
        for (int64_t y = 0; y < count[1]; y += 3) {
          CallScope::look();
          for (int64_t x = 0; x < count[0]; x += 3) f(x, y, z);
        }
    };
    each_block([&](int64_t x, int64_t y, int64_t z) {
      middle.push_back(clear(middle_of(x, 0), middle_of(y, 1), middle_of(z, 2)));
      most = std::max(most, middle.back());
    });
    const double diagonal = std::sqrt(dot(step, step));
    size_t block = 0;
    each_block([&](int64_t x, int64_t y, int64_t z) {
      if (middle[block++] + diagonal + rounding * length_ < most) return;
      for (int64_t c = z; c < std::min(z + 3, count[2]); ++c)
        for (int64_t b = y; b < std::min(y + 3, count[1]); ++b)
          for (int64_t a = x; a < std::min(x + 3, count[0]); ++a) most = std::max(most, clear(a, b, c));
    });
    if (most < reach) return most + 0.5 * diagonal + rounding * length_;  // lattices reach the bound
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
    std::sort(others.begin(), others.end(), [&](const Ball &a, const Ball &b) {  // those that stop most pores first
      const Point u = minus(a.x, base.x), v = minus(b.x, base.x);
      return std::sqrt(dot(u, u)) - a.r < std::sqrt(dot(v, v)) - b.r;
    });
    const auto keep = [&](const Ball &s) {
      if (s.r <= most_ && is_free(s, others)) vertex_.push_back(s);
    };
    for (size_t a = 0; a < rows.size(); ++a) {
      CallScope::look();
      for (size_t b = a + 1; b < rows.size(); ++b) {
        if (!may_share(a, b)) continue;
        if (p_.dim == 2) solve(base, rows[a], rows[b], in_plane({0.0, 0.0, 1.0}), keep);
        for (size_t c = b + 1; p_.dim == 3 && c < rows.size(); ++c)
          if (may_share(a, c) && may_share(b, c)) solve(base, rows[a], rows[b], rows[c], keep);
      }
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
      if (!may_share(a, b)) continue;
      solve(point, row_[a], row_[b], in_plane_of(row_[a], row_[b]), keep);
      for (size_t c = b + 1; p_.dim == 3 && c < row_.size(); ++c)
        if (may_share(a, c) && may_share(b, c)) solve(point, row_[a], row_[b], row_[c], keep);
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
