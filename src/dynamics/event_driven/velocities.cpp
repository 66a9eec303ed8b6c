#include "dynamics/event_driven/velocities.hpp"

#include <cmath>

namespace jam::inside {

namespace {
// Whether the motion of the centre of mass is none of the heat. Of one sphere without walls it is the only motion.
bool drifts(const Packing &p) { return p.n() > 1 || p.container; }
}  // namespace

double twice_kinetic(const Packing &p) {
  std::vector<double> mass = sphere_masses(p);
  if (mass.empty()) mass.assign(p.n(), 1.0);
  const size_t d = static_cast<size_t>(p.dim);
  double sum = 0.0, drift = 0.0;
  for (size_t k = 0; k < p.velocity.size(); ++k) sum += mass[k / d] * p.velocity[k] * p.velocity[k];
  for (size_t c = 0; c < d && drifts(p); ++c) {
    if (!p.cell.repeats(static_cast<int>(c))) continue;  // walls take momentum
    double momentum = 0.0;
    for (size_t i = 0; i < p.n(); ++i) momentum += mass[i] * p.velocity[i * d + c];
    drift += momentum * momentum / static_cast<double>(p.n());  // masses have mean 1
  }
  return sum - drift;
}

void scale_velocities(Packing &p) {
  const double factor = std::sqrt(static_cast<double>(p.velocity.size()) / twice_kinetic(p));
  for (double &v : p.velocity) v *= factor;
}

void draw_velocities(Packing &p, Rng &rng) {
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  std::vector<double> mass = sphere_masses(p);
  if (mass.empty()) mass.assign(n, 1.0);
  for (size_t k = 0; k < n * d; ++k) p.velocity[k] = rng.normal() / std::sqrt(mass[k / d]);
  for (size_t c = 0; c < d && drifts(p); ++c) {
    if (!p.cell.repeats(static_cast<int>(c))) continue;
    double mean = 0.0;
    for (size_t i = 0; i < n; ++i) mean += mass[i] * p.velocity[i * d + c];
    mean /= static_cast<double>(n);
    for (size_t i = 0; i < n; ++i) p.velocity[i * d + c] -= mean;
  }
  p.has_velocity = true;
}

}  // namespace jam::inside
