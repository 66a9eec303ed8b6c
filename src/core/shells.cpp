#include "core/shells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/math.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();
double clamped(double x) { return std::min(1.0, std::max(-1.0, x)); }

// Sums f over [from, to] by the rule of Gauss and Legendre with four points.
template <class F>
double gauss(double from, double to, const F &f) {
  constexpr std::array<double, 2> at{0.33998104358485626, 0.86113631159405258},
      weight{0.65214515486254614, 0.34785484513745386};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (size_t k = 0; k < 2; ++k) sum += weight[k] * (f(middle - half * at[k]) + f(middle + half * at[k]));
  return sum * half;
}
// The same between sorted breaks, with roots at each of them: x = a + (b - a) sin^2 u.
template <class F>
double gauss_with_roots(const std::vector<double> &breaks, const F &f) {
  double sum = 0.0;
  for (size_t k = 0; k + 1 < breaks.size(); ++k) {
    const double from = breaks[k], length = breaks[k + 1] - from;
    if (!(length > 0.0)) continue;
    const auto by_angle = [&](double u) {
      const double s = math::sin(u), c = math::cos(u);
      return 2.0 * s * c * length * f(from + length * s * s);
    };
    sum += gauss(0.0, 0.25 * math::pi, by_angle) + gauss(0.25 * math::pi, 0.5 * math::pi, by_angle);
  }
  return sum;
}

// Area of the part of the unit sphere with x > a, y > b and z > c, none of them negative: angles less what arcs turn by
// (theorem of Gauss and Bonnet).
double corner(double a, double b, double c) {
  if (!(a * a + b * b + c * c < 1.0)) return 0.0;
  constexpr double quarter = 0.5 * math::pi;
  if ((a == 0.0) + (b == 0.0) + (c == 0.0) >= 2) return quarter * (1.0 - std::max({a, b, c}));
  const double at[3] = {a, b, c};
  double sum = -math::pi, ring[3];
  for (int k = 0; k < 3; ++k) ring[k] = std::sqrt(1.0 - at[k] * at[k]);
  for (int k = 0; k < 3; ++k) {
    const int m = (k + 1) % 3, n = (k + 2) % 3;
    const double p = at[k] * at[m];
    sum += p == 0.0 ? quarter : math::acos(clamped(p / (ring[k] * ring[m])));
    if (at[k] == 0.0) continue;
    sum -= at[k] * (math::acos(clamped(at[m] / ring[k])) + math::acos(clamped(at[n] / ring[k])) - quarter);
  }
  return std::max(0.0, sum);
}

// Walls as seen from a point, all moved inwards by the radius of the spheres that they hold.
class View {
 public:
  View(const Packing &p, const double *x, double radius) : dim_(p.dim) {
    const Container &c = p.container;
    for (auto &ends : flat_) ends = {far_away, far_away};
    bool inside = true;
    for (int w = 0; w < c.count(); ++w) {
      const double room = c[w].distance(x) - radius;
      inside = inside && room >= 0.0;
      if (!c[w].curved()) {
        flat_[static_cast<size_t>(c[w].axis())][static_cast<size_t>(c[w].side())] = room;
        breaks_.push_back(std::fabs(room));
        continue;
      }
      round_axes_ = c.round_axes();
      off_ = 1.0 / c[w].curvature(x);
      round_ = room + off_;
      breaks_.push_back(std::fabs(room)), breaks_.push_back(round_ + off_);
    }
    std::sort(breaks_.begin(), breaks_.end());
    clear_ = inside ? breaks_.front() : 0.0;
  }
  // Volume of the part within the walls of the shell from `low` to `high`.
  double shell(double low, double high) const {
    double sum = 0.0, from = low;
    const auto area = [&](double r) { return (dim_ == 2 ? 2.0 * math::pi * r : 4.0 * math::pi * r * r) * share(r); };
    for (const double at : breaks_)
      if (at > from && at < high) sum += gauss(from, at, area), from = at;
    return sum + gauss(from, high, area);
  }

 private:
  // Share of the sphere of radius r about the point. Out of line: gauss() asks it at four places.
  [[gnu::noinline]] double share(double r) const {
    if (r <= clear_) return 1.0;
    if (dim_ == 2) return circle(r);
    if (round_axes_ == 3) return 0.5 * (1.0 + cosine_out(r));
    if (round_axes_ == 0) return box(r);
    const double below = std::max(-r, std::min(r, flat_[2][0])), above = std::max(-r, std::min(r, flat_[2][1]));
    if (below + above <= 0.0) return 0.0;
    // A slice at height z is a circle; equal heights hold equal shares of a sphere (Archimedes).
    std::vector<double> breaks{-below, above};
    const auto note = [&](double squared) {
      const double z = std::sqrt(std::max(0.0, r * r - squared));
      if (r * r > squared)
        for (const double at : {-z, z})
          if (at > -below && at < above) breaks.push_back(at);
    };
    note((round_ - off_) * (round_ - off_)), note((round_ + off_) * (round_ + off_));
    std::sort(breaks.begin(), breaks.end());
    return gauss_with_roots(breaks, [&](double z) { return circle(std::sqrt(std::max(0.0, r * r - z * z))); }) /
           (2.0 * r);
  }
  // Between flat walls: of each octant what lies beyond one bound along each axis and within the other, as corners with
  // signs. Octants with the same bound are taken together.
  double box(double r) const {
    struct Bound {
      double at, sign;
    };
    std::array<std::array<Bound, 3>, 3> bounds;
    std::array<size_t, 3> count{};
    for (size_t c = 0; c < 3; ++c)
      for (size_t side = 0; side < 2; ++side) {
        const double low = std::max(0.0, -flat_[c][1 - side] / r), high = flat_[c][side] / r;
        if (!(low < std::min(1.0, high))) continue;
        const auto add = [&](double at, double sign) {
          if (count[c] > 0 && bounds[c][0].at == at)
            bounds[c][0].sign += sign;
          else
            bounds[c][count[c]++] = {at, sign};
        };
        add(low, 1.0);
        if (high < 1.0) add(high, -1.0);
      }
    double seen = 0.0;
    for (size_t x = 0; x < count[0]; ++x)
      for (size_t y = 0; y < count[1]; ++y)
        for (size_t z = 0; z < count[2]; ++z)
          seen += bounds[0][x].sign * bounds[1][y].sign * bounds[2][z].sign *
                  corner(bounds[0][x].at, bounds[1][y].at, bounds[2][z].at);
    return std::min(1.0, std::max(0.0, seen / (4.0 * math::pi)));
  }
  // Points at the distance r are within the round wall when the cosine of their angle to the outward direction is less.
  double cosine_out(double r) const {
    if (off_ == 0.0) return r < round_ ? 1.0 : -1.0;
    return clamped((round_ * round_ - off_ * off_ - r * r) / (2.0 * off_ * r));
  }
  // Share of a circle of the first two axes.
  [[gnu::noinline]] double circle(double r) const {
    if (!(r > 0.0)) return std::min({flat_[0][0], flat_[0][1], flat_[1][0], flat_[1][1]}) >= 0.0 && round_ >= off_;
    if (round_axes_ == 2) return 1.0 - math::acos(cosine_out(r)) / math::pi;
    // Each wall hides an arc about its direction. A quarter is seen between the arcs of its two walls, or less where
    // the arc of one on the other side is longer than a quarter.
    std::array<std::array<double, 2>, 2> arc;
    for (size_t c = 0; c < 2; ++c)
      for (size_t s = 0; s < 2; ++s) arc[c][s] = math::acos(clamped(flat_[c][s] / r));
    constexpr double quarter = 0.5 * math::pi;
    double seen = 0.0;
    for (size_t x = 0; x < 2; ++x)
      for (size_t y = 0; y < 2; ++y) {
        const double from = std::max({0.0, arc[0][x], arc[1][1 - y] - quarter}),
                     to = std::min({quarter, math::pi - arc[0][1 - x], quarter - arc[1][y]});
        seen += std::max(0.0, to - from);
      }
    return seen / (2.0 * math::pi);
  }

  int dim_, round_axes_ = 0;
  std::array<std::array<double, 2>, 3> flat_;  // distances to the walls at 0 and at the edge
  double off_ = 0.0, round_ = 0.0;             // of the point from the axis or centre; radius of the wall
  std::vector<double> breaks_;                 // distances where a shell begins or ends to meet a wall
  double clear_ = 0.0;                         // nearer than this it meets none
};

// Spheres of nearly one radius.
struct SizeGroup {
  double radius, count;
};
// Radii in classes: exact when there are few, else of equal numbers with their mean radius.
std::vector<SizeGroup> size_groups(const Packing &p, const std::vector<char> &with) {
  std::vector<double> radii;
  for (size_t i = 0; i < p.n(); ++i)
    if (with[i]) radii.push_back(0.5 * p.diameter[i]);
  std::sort(radii.begin(), radii.end());
  std::vector<SizeGroup> all;
  for (const double r : radii) {
    if (all.empty() || all.back().radius != r) all.push_back({r, 0.0});
    all.back().count += 1.0;
  }
  constexpr size_t most = ShellsTuning::size_classes;
  if (all.size() <= most) return all;
  all.clear();
  for (size_t k = 0; k < most; ++k) {
    const size_t begin = radii.size() * k / most, end = radii.size() * (k + 1) / most;
    double sum = 0.0;
    for (size_t i = begin; i < end; ++i) sum += radii[i];
    if (end > begin) all.push_back({sum / static_cast<double>(end - begin), static_cast<double>(end - begin)});
  }
  return all;
}

// Where the centres of spheres of this radius can be.
double room_of_centres(const Packing &p, double radius) {
  const Container &c = p.container;
  double volume = c.volume();
  for (int w = 0; w < c.count(); ++w) {
    const double length = c.volume() / c[w].area();  // edge of the cell; of a round wall R_c over its axes
    if (!c[w].curved())
      volume *= c[w].side() ? 1.0 : std::max(0.0, 1.0 - 2.0 * radius / length);
    else
      volume *= math::pow(std::max(0.0, 1.0 - radius / (c.round_axes() * length)), c.round_axes());
  }
  return volume;
}

}  // namespace

std::vector<double> pairs_of_even_spread(const Packing &p, const std::vector<char> &of, const std::vector<char> &with,
                                         const std::vector<double> &edge, bool of_contact) {
  if (p.dim > 3) fail(JAM_E_UNSUPPORTED, "g(r) between walls is there for d = 2 and 3, this system has d = %d", p.dim);
  std::vector<double> out(edge.size() - 1, 0.0);
  for (const SizeGroup &size : size_groups(p, with)) {
    const double room = room_of_centres(p, size.radius);
    if (!(room > ShellsTuning::least_room * p.container.volume()))
      fail(JAM_E_UNSUPPORTED, "g(r): spheres of diameter %g are as wide as the container and have no room to spread in",
           2.0 * size.radius);
    for (size_t i = 0; i < p.n(); ++i) {
      CallScope::look();
      if (!of[i]) continue;
      const View view(p, &p.position[i * static_cast<size_t>(p.dim)], size.radius);
      const double unit = of_contact ? 0.5 * p.diameter[i] + size.radius : 1.0;
      for (size_t k = 0; k < out.size(); ++k)
        out[k] += size.count / room * view.shell(unit * edge[k], unit * edge[k + 1]);
    }
  }
  return out;
}

}  // namespace jam::inside
