#include "pore/profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/container.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {
namespace {

// Volumes of balls that planes, balls and cylinders cut.
double clamped(double x) { return std::min(1.0, std::max(-1.0, x)); }

// Integral over [from, to] by tanh-sinh quadrature (Takahasi and Mori, Publ. RIMS 9, 721 (1974)): roots at the ends,
// where shapes begin to cut each other, cost nothing.
template <class F>
double integral(double from, double to, const F &f) {
  constexpr int steps = QuadratureTuning::steps;
  constexpr double step = QuadratureTuning::step;
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (int k = -steps; k <= steps; ++k) {
    const double e = math::exp(k * step), s = 0.25 * math::pi * (e - 1.0 / e), c = 0.25 * math::pi * (e + 1.0 / e);
    const double g = math::exp(2.0 * std::fabs(s));
    const double left = 2.0 / (g + 1.0);  // distance to the nearer end, of 2
    const double weight = 4.0 * g / ((g + 1.0) * (g + 1.0)) * c;
    sum += weight * f(s < 0.0 ? from + half * left : to - half * left);
  }
  return sum * step * half;
}

// Adds the volume of a ball between equal planes, which begin at 0; it may lie across the end, and repeats there.
// below_plane(t): its volume below a plane at t from its centre.
template <class F>
void add_slabs(double radius, double centre, double height, bool repeats, const F &below_plane,
               std::vector<double> &volume) {
  const auto bins = static_cast<long>(volume.size());
  const double width = height / static_cast<double>(bins);
  const auto first = static_cast<long>(std::floor((centre - radius) / width));
  const auto last = static_cast<long>(std::floor((centre + radius) / width));
  double below = 0.0;
  for (long k = first; k <= last; ++k) {
    const double next = below_plane(k == last ? radius : static_cast<double>(k + 1) * width - centre);
    const long bin = repeats ? ((k % bins) + bins) % bins : std::min(std::max(k, 0L), bins - 1);
    volume[static_cast<size_t>(bin)] += next - below;
    below = next;
  }
}

// Volume of the container between the planes, or the shells.
std::vector<double> volumes_of_bins(const Packing &p, int axis, double height, size_t bins) {
  const int round = p.container.round_axes();
  std::vector<double> volume(bins, scene_volume(p) / static_cast<double>(bins));
  if (axis < p.dim && axis < round) {  // across a round container: a ball, or the circle of a cylinder times its length
    const double radius = 0.5 * height, length = round < p.dim ? p.cell.edge(p.dim - 1) : 1.0;
    double below = 0.0;
    for (size_t k = 0; k < bins; ++k) {
      const double share = static_cast<double>(k + 1) / static_cast<double>(bins);
      const double next = length * volume_below(round, radius, height * share - radius);
      volume[k] = next - below;
      below = next;
    }
  } else if (axis == p.dim) {
    for (size_t k = 0; k < bins; ++k) {
      const double a = static_cast<double>(k) / static_cast<double>(bins);
      const double b = static_cast<double>(k + 1) / static_cast<double>(bins);
      volume[k] = scene_volume(p) * (round == 2 ? b * b - a * a : b * b * b - a * a * a);
    }
  }
  return volume;
}

void add_shells(const Packing &p, const Solid &parts, size_t i, double outer, std::vector<double> &volume) {
  const double *const x = &p.position[i * static_cast<size_t>(p.dim)], radius = 0.5 * p.diameter[i];
  const int round = p.container.round_axes();
  const auto bins = static_cast<double>(volume.size());
  double r2 = 0.0;
  for (int c = 0; c < round; ++c) r2 += (x[c] - outer) * (x[c] - outer);
  const double apart = std::sqrt(r2), whole = volume_below(p.dim, radius, radius);
  double inside = 0.0;
  for (size_t k = 0; k < volume.size() && inside < whole; ++k) {
    const double edge = outer * static_cast<double>(k + 1) / bins;
    if (edge <= apart - radius) continue;
    // A whole sphere may pass the last edge by rounding.
    const double next = !parts.is_whole(i)       ? parts.volume_within(i, edge)
                        : k + 1 == volume.size() ? whole
                        : round < p.dim          ? shared_with_cylinder(radius, edge, apart)
                                                 : shared_volume(p.dim, radius, edge, apart);
    volume[k] += next - inside;
    inside = next;
  }
}

// Of the faces that a_axis joins, towards the second one.
Point normal_of_faces(const Packing &p, int axis) {
  Point n{};
  std::array<double, JAM_MAX_DIM> s{};
  for (size_t c = 0; c < static_cast<size_t>(p.dim); ++c) {
    Point unit{};
    unit[c] = 1.0;
    p.cell.fraction(unit.data(), s.data());
    n[c] = s[static_cast<size_t>(axis)] * p.cell.height(axis);
  }
  return n;
}

}  // namespace

void check_solid_profile(const Packing &p, int axis, int bins) {
  check_has_pores(p);
  if (axis < 0 || axis > p.dim) fail(JAM_E_ARGUMENT, "axis is %d, it must be in 0..%d", axis, p.dim);
  if (bins < 1 || bins > 1000000) fail(JAM_E_ARGUMENT, "bins is %d, it must be in 1..1e6", bins);
  if (axis == p.dim && p.container.round_axes() == 0)
    fail(JAM_E_UNSUPPORTED, "axis is %d, which is radial: that needs a cylinder or a ball as container", axis);
}

Profile solid_profile(const Packing &p, int axis, int bins) {
  const bool radial = axis == p.dim;
  const auto count = static_cast<size_t>(bins);
  const double height = radial ? 0.5 * p.cell.edge(0) : p.cell.height(axis);
  std::vector<double> solid(count, 0.0), s(static_cast<size_t>(p.dim));
  const Solid parts(p);
  const Point across = radial ? Point{} : normal_of_faces(p, axis);
  for (size_t i = 0; i < p.n(); ++i) {
    CallScope::look();
    const double *x = &p.position[i * static_cast<size_t>(p.dim)], radius = 0.5 * p.diameter[i];
    if (radial) {
      add_shells(p, parts, i, height, solid);
      continue;
    }
    p.cell.fraction(x, s.data());
    const double centre = s[static_cast<size_t>(axis)] * height;
    const bool repeats = p.cell.repeats(axis);
    if (parts.is_whole(i))
      add_slabs(
          radius, centre, height, repeats, [&](double t) { return volume_below(p.dim, radius, t); }, solid);
    else
      add_slabs(
          radius, centre, height, repeats,
          [&](double t) {
            return parts.volume(i, {across, t});
          },
          solid);
  }
  Profile out;
  const std::vector<double> whole = volumes_of_bins(p, axis, height, count);
  for (size_t k = 0; k < count; ++k) {
    out.low.push_back(height * static_cast<double>(k) / bins);
    out.high.push_back(height * static_cast<double>(k + 1) / bins);
    out.solid.push_back(solid[k] / whole[k]);
  }
  return out;
}

double volume_below(int dim, double radius, double t) {
  const double u = clamped(t / radius);
  if (dim == 2) return radius * radius * (0.5 * math::pi + math::asin(u) + u * std::sqrt(1.0 - u * u));
  return math::pi * radius * radius * radius * (1.0 + u) * (1.0 + u) * (2.0 - u) / 3.0;
}

double shared_volume(int dim, double a, double b, double apart) {
  const double small = std::min(a, b), large = std::max(a, b);
  if (small <= 0.0 || apart >= a + b) return 0.0;
  if (apart <= large - small) return volume_below(dim, small, small);
  // The plane of the common circle is at these distances from the centres, on each one's far side when negative.
  const double to_large = 0.5 * (apart + (large - small) * (large + small) / apart), to_small = apart - to_large;
  return volume_below(dim, large, -to_large) + volume_below(dim, small, -to_small);
}

double shared_with_cylinder(double ball, double cylinder, double apart) {
  if (cylinder <= 0.0 || apart >= ball + cylinder) return 0.0;
  if (apart + ball <= cylinder) return volume_below(3, ball, ball);
  // At height z the ball is a disk; where its radius is one of these it begins to cut the circle, or to contain it.
  const auto height = [&](double r) { return std::sqrt(std::max(0.0, (ball - r) * (ball + r))); };
  const std::array<double, 4> ends{0.0, height(cylinder + apart), height(std::fabs(cylinder - apart)), ball};
  double sum = 0.0;
  for (size_t k = 0; k < 3; ++k)
    sum += integral(ends[k], ends[k + 1], [&](double z) {
      return shared_volume(2, std::sqrt(std::max(0.0, (ball - z) * (ball + z))), cylinder, apart);
    });
  return 2.0 * sum;
}

}  // namespace jam::inside
