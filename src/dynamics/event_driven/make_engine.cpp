// The choice of an engine, the order of spheres in memory, and what needs no dimension.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/with_dimension.hpp"
#include "dynamics/dynamics.hpp"
#include "dynamics/event_driven/engine_of.hpp"
#include "dynamics/event_driven/velocities.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {
namespace {

// Whether the motion of the centre of mass is none of the heat. Of one sphere without walls it is the only motion.
bool drifts(const Packing &p) { return p.n() > 1 || p.container; }

double mean_velocity(const Packing &p, const std::vector<double> &mass, size_t c) {
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  double mean = 0.0;
  for (size_t i = 0; i < n; ++i) mean += mass[i] * p.velocity[i * d + c];
  return mean / static_cast<double>(n);  // masses have mean 1
}

double energy_of(const Packing &p, const std::vector<double> &mass) {
  double sum = 0.0;
  for (size_t k = 0; k < p.velocity.size(); ++k)
    sum += mass[k / static_cast<size_t>(p.dim)] * p.velocity[k] * p.velocity[k];
  return sum;
}

std::vector<double> masses_of(const Packing &p) {
  std::vector<double> mass = sphere_masses(p);
  if (mass.empty()) mass.assign(p.n(), 1.0);
  return mass;
}

std::unique_ptr<Engine> choose(const Packing &p, const EngineOptions &o, bool images, Archive *from) {
  return with_dimension(p.dim, [&](auto d) -> std::unique_ptr<Engine> {
    if (images) return std::make_unique<EngineOf<d, Offsets::listed>>(p, o, from);
    return std::make_unique<EngineOf<d, Offsets::wrapped>>(p, o, from);
  });
}

}  // namespace

int32_t only_entry(const int32_t *list, int32_t count, int32_t k) {
  int32_t entry = -1, times = 0;
  for (int32_t e = 0; e < count; ++e) {  // without branches the compiler processes four entries at a time
    entry = list[e] == k ? e : entry;
    times += list[e] == k;
  }
  return times == 1 ? entry : -1;
}

// Numbers of the spheres along a Morton curve: neighbours in space become neighbours in memory.
std::vector<int32_t> curve_order(const Packing &p) {
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  const int bits = static_cast<int>(std::min<size_t>(16, 62 / d));
  std::vector<uint64_t> key(n, 0);
  for (size_t i = 0; i < n; ++i)
    for (size_t c = 0; c < d; ++c) {
      const auto x =
          static_cast<uint64_t>(wrap(p.position[i * d + c] / p.cell.side(), 1.0) * static_cast<double>(1u << bits));
      for (int b = 0; b < bits; ++b) key[i] |= (x >> b & 1u) << (static_cast<size_t>(b) * d + c);
    }
  std::vector<int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) { return key[a] < key[b]; });
  return order;
}

std::unique_ptr<Engine> make_engine(const Packing &p, const EngineOptions &o) {
  const bool images = p.model == JAM_MODEL_MK || !p.cell.cube() ||
                      !Lists<2, Offsets::wrapped>::fit_wrapped(contact_distance_max(p) / p.cell.side());
  return choose(p, o, images, nullptr);
}

std::unique_ptr<Engine> make_engine(const Packing &p, Archive &from) {
  int64_t images = 0;
  from(images);
  if (images == not_begun) return nullptr;
  Archive::check(images == 1 || (images == 0 && p.model == JAM_MODEL_EUCLID && p.cell.cube()));
  return choose(p, EngineOptions{}, images == 1, &from);
}

double twice_kinetic(const Packing &p) {
  const std::vector<double> mass = masses_of(p);
  const size_t d = static_cast<size_t>(p.dim);
  double drift = 0.0;
  for (size_t c = 0; c < d && drifts(p); ++c) {
    if (!p.cell.repeats(static_cast<int>(c))) continue;  // walls take momentum
    double momentum = 0.0;
    for (size_t i = 0; i < p.n(); ++i) momentum += mass[i] * p.velocity[i * d + c];
    drift += momentum * momentum / static_cast<double>(p.n());  // masses have mean 1
  }
  return energy_of(p, mass) - drift;
}

bool take_drift(Packing &p) {
  const std::vector<double> mass = masses_of(p);
  const size_t d = static_cast<size_t>(p.dim);
  const double all = energy_of(p, mass);
  for (size_t c = 0; c < d && drifts(p); ++c) {
    if (!p.cell.repeats(static_cast<int>(c))) continue;  // walls take momentum
    const double mean = mean_velocity(p, mass, c);
    if (!(static_cast<double>(p.n()) * mean * mean > CollisionTuning::motion_as_one * all)) continue;
    for (size_t i = 0; i < p.n(); ++i) p.velocity[i * d + c] -= mean;
  }
  return energy_of(p, mass) > CollisionTuning::motion_as_one * all;
}

void scale_velocities(Packing &p) {
  const double factor = std::sqrt(static_cast<double>(p.velocity.size()) / twice_kinetic(p));
  for (double &v : p.velocity) v *= factor;
}

void draw_velocities(Packing &p, Rng &rng) {
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  const std::vector<double> mass = masses_of(p);
  for (size_t k = 0; k < n * d; ++k) p.velocity[k] = rng.normal() / std::sqrt(mass[k / d]);
  for (size_t c = 0; c < d && drifts(p); ++c) {
    if (!p.cell.repeats(static_cast<int>(c))) continue;
    const double mean = mean_velocity(p, mass, c);
    for (size_t i = 0; i < n; ++i) p.velocity[i * d + c] -= mean;
  }
  p.has_velocity = true;
}

}  // namespace jam::inside
