#include "pore/profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/container.hpp"
#include "pore/images.hpp"

namespace jam::inside {
namespace {

// Adds the volume of a ball between equal planes, which begin at 0; it may lie across the end, and repeats there.
void add_slabs(int dim, double radius, double centre, double height, bool repeats, std::vector<double> &volume) {
  const auto bins = static_cast<long>(volume.size());
  const double width = height / static_cast<double>(bins);
  const auto first = static_cast<long>(std::floor((centre - radius) / width));
  const auto last = static_cast<long>(std::floor((centre + radius) / width));
  double below = 0.0;
  for (long k = first; k <= last; ++k) {
    const double next = k == last ? volume_below(dim, radius, radius)
                                  : volume_below(dim, radius, static_cast<double>(k + 1) * width - centre);
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

void add_shells(const Packing &p, const double *x, double radius, double outer, std::vector<double> &volume) {
  const int round = p.container.round_axes();
  const auto bins = static_cast<double>(volume.size());
  double r2 = 0.0;
  for (int c = 0; c < round; ++c) r2 += (x[c] - outer) * (x[c] - outer);
  const double apart = std::sqrt(r2), whole = volume_below(p.dim, radius, radius);
  double inside = 0.0;
  for (size_t k = 0; k < volume.size() && inside < whole; ++k) {
    const double edge = outer * static_cast<double>(k + 1) / bins;
    if (edge <= apart - radius) continue;
    // A sphere may pass the last edge by rounding.
    const double next = k + 1 == volume.size() ? whole
                        : round < p.dim        ? shared_with_cylinder(radius, edge, apart)
                                               : shared_volume(p.dim, radius, edge, apart);
    volume[k] += next - inside;
    inside = next;
  }
}

}  // namespace

Profile solid_profile(const Packing &p, int axis, int bins) {
  check_has_pores(p);
  const bool radial = axis == p.dim;
  if (axis < 0 || axis > p.dim) fail(JAM_E_ARGUMENT, "axis is %d, it must be in 0..%d", axis, p.dim);
  if (bins < 1 || bins > 1000000) fail(JAM_E_ARGUMENT, "bins is %d, it must be in 1..1e6", bins);
  if (radial && p.container.round_axes() == 0)
    fail(JAM_E_UNSUPPORTED, "axis is %d, which is radial: that needs a cylinder or a ball as container", axis);
  const auto count = static_cast<size_t>(bins);
  const double height = radial ? 0.5 * p.cell.edge(0) : p.cell.height(axis);
  std::vector<double> solid(count, 0.0), s(static_cast<size_t>(p.dim));
  for (size_t i = 0; i < p.n(); ++i) {
    CallScope::look();
    const double *x = &p.position[i * static_cast<size_t>(p.dim)], radius = 0.5 * p.diameter[i];
    if (radial) {
      add_shells(p, x, radius, height, solid);
    } else {
      p.cell.fraction(x, s.data());
      add_slabs(p.dim, radius, s[static_cast<size_t>(axis)] * height, height, p.cell.repeats(axis), solid);
    }
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

}  // namespace jam::inside
