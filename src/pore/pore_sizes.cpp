#include "pore/pore_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "jam/jam.h"
#include "pore/balls.hpp"
#include "pore/tuning.hpp"

namespace jam {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = PoreSizeTuning::rounding;

// One equation d . c + q r = b for the centre c and radius r of a sphere that touches a ball; c from a base point.
struct Row {
  Point d;
  double q, b;
};
Row touching(const Ball &base, const Ball &ball) {
  const Point d = minus(ball.x, base.x);
  return {d, ball.r - base.r, 0.5 * (dot(d, d) - ball.r * ball.r + base.r * base.r)};
}
Row in_plane(const Point &normal) { return {normal, 0.0, 0.0}; }

// Calls f with each sphere of positive radius that solves three rows and touches the base (of radius 0: passes
// through it). The rows give c = u + w r, and |c| = r + R of the base is quadratic in r.
template <class F>
void solve(const Ball &base, const Row &i, const Row &j, const Row &k, const F &f) {
  const Point jk = cross(j.d, k.d), ki = cross(k.d, i.d), ij = cross(i.d, j.d);
  const double det = dot(i.d, jk);
  if (det == 0.0) return;
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

class Pores {
 public:
  explicit Pores(const Packing &p)
      : p_(p), length_(diameter_mean(p)), most_(bound_radius()), balls_(p, 2.0 * most_ + 0.5 * diameter_max(p)) {
    find_vertices();
  }
  double clearance(const Point &x) const { return balls_.clearance(x, 2.0 * most_); }
  double largest_at(const Point &x);

 private:
  // No pore is wider: clearance grows by no more than the way from the nearest point of a grid.
  double bound_radius() const;
  void find_vertices();
  bool is_free(const Ball &s, const std::vector<Ball> &near) const {
    for (const Ball &b : near) {
      const Point d = minus(b.x, s.x);
      const double least = s.r + b.r - rounding * length_;
      if (dot(d, d) < least * least) return false;
    }
    return true;
  }
  const Packing &p_;
  double length_, most_;
  Balls balls_;
  std::vector<Ball> near_;
  std::vector<Row> row_;
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
          most = std::max(most, balls.clearance({at(x, 0), at(y, 1), p_.dim == 3 ? at(z, 2) : 0.0}, reach));
        }
      }
    if (most < reach) return most + 0.5 * std::sqrt(dot(step, step));
  }
}

// Spheres that touch d + 1 balls: where clearance is largest. Found from the ball of lowest number among them.
void Pores::find_vertices() {
  std::vector<Row> rows;
  std::vector<Ball> others;
  for (size_t i = 0; i < p_.n(); ++i) {
    CallScope::look();
    const Ball base = balls_.primary(i);
    balls_.near(base.x, base.r + 2.0 * most_, near_, static_cast<int32_t>(i));
    rows.clear();
    for (const Ball &b : near_) rows.push_back(touching(base, b));
    balls_.near(base.x, base.r + 2.0 * most_, others);
    const auto keep = [&](const Ball &s) {
      if (s.r <= most_ && is_free(s, others)) vertex_.push_back(s);
    };
    for (size_t a = 0; a < rows.size(); ++a)
      for (size_t b = a + 1; b < rows.size(); ++b)
        if (p_.dim == 2)
          solve(base, rows[a], rows[b], in_plane({0.0, 0.0, 1.0}), keep);
        else
          for (size_t c = b + 1; c < rows.size(); ++c) solve(base, rows[a], rows[b], rows[c], keep);
  }
  balls_.sort_into_boxes(vertex_, vertices_at_);
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
  row_.clear();
  for (const Ball &b : near_) row_.push_back(touching(point, b));
  const auto keep = [&](const Ball &s) {
    if (s.r > best && s.r <= most_ && is_free(s, near_)) best = s.r;
  };
  for (size_t a = 0; a < row_.size(); ++a)
    for (size_t b = a + 1; b < row_.size(); ++b) {
      solve(point, row_[a], row_[b], in_plane(cross(row_[a].d, row_[b].d)), keep);
      for (size_t c = b + 1; p_.dim == 3 && c < row_.size(); ++c) solve(point, row_[a], row_[b], row_[c], keep);
    }
  return best;
}

}  // namespace

void check_pore_points(const Packing &p, int64_t points) {
  check_has_pores(p);
  refuse_walls(p, "searched for pore sizes");
  if (points < 1 || points > 1000000000)
    fail(JAM_E_ARGUMENT, "points is %lld, it must be in 1..1e9", static_cast<long long>(points));
}

std::vector<std::array<double, 5>> pore_sizes(const Packing &p, int64_t points, int64_t seed) {
  Pores pores(p);
  Rng rng(seed, Stream::pore_points);
  std::vector<std::array<double, 5>> out;
  while (static_cast<int64_t>(out.size()) < points) {
    CallScope::report_share(static_cast<int64_t>(out.size()),
                            static_cast<double>(out.size()) / static_cast<double>(points));
    Point x{};
    for (int c = 0; c < p.dim; ++c) x[c] = rng.uniform() * p.cell.edge(c);
    const double clear = pores.clearance(x);
    if (!(clear > 0.0)) continue;
    const double z = p.dim == 3 ? x[2] : std::numeric_limits<double>::quiet_NaN();
    out.push_back({x[0], x[1], z, clear, pores.largest_at(x)});
  }
  return out;
}

}  // namespace jam
