// The spheres of the engine in its order, and their distances at contact.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/pair_rule.hpp"
#include "dynamics/event_driven/lattice.hpp"

namespace jam::inside {

// Order of the spheres along a Morton curve: neighbours in space are near in memory.
std::vector<int32_t> curve_order(const Packing &p);

template <int D>
struct Spheres {
  int32_t n;
  double non_additivity;
  double reach_factor;  // largest contact distance over the sum of the radii
  std::vector<Body<D>> body;
  std::vector<int32_t> user;  // number of each sphere for the user
  std::vector<double> mass;   // empty: all 1; else of mean 1
  uint32_t closed;            // axes along which walls take momentum

  explicit Spheres(const Packing &p)
      : n(static_cast<int32_t>(p.n())),
        non_additivity(p.non_additivity),
        reach_factor(1.0 + std::max(0.0, p.non_additivity)),
        body(p.n()),
        user(curve_order(p)),
        closed(p.cell.closed()) {
    std::memset(static_cast<void *>(body.data()), 0, body.size() * sizeof(Body<D>));  // with the ends that mean nothing
    const std::vector<double> of_user = sphere_masses(p);
    for (size_t i = 0; i < of_user.size(); ++i) mass.push_back(of_user[user[i]]);
  }
  // Places, velocities and radii of the packing in integers, `scale` to V^(1/d).
  void take(const Packing &p, double scale) {
    for (int32_t i = 0; i < n; ++i) {
      const size_t u = static_cast<size_t>(user[i]);
      Body<D> &b = body[i];
      for (int c = 0; c < D; ++c) {
        const double x = p.position[u * D + c] / p.cell.side();
        b.x[c] = static_cast<uint64_t>((p.cell.cube() ? wrap(x, 1.0) : x) * scale);
        b.v[c] = p.velocity[u * D + c] * scale;
      }
      b.time = 0.0;
      b.radius = std::llrint(0.5 * p.diameter[u] / p.cell.side() * scale);
    }
  }

  double mass_of(int32_t i) const { return mass.empty() ? 1.0 : mass[i]; }
  // Contact distance of two bodies at the origin of time, by the rule of core/pair_rule.hpp; kernel/loops.hpp has the
  // same in vectors.
  int64_t contact_sum(const Body<D> &a, const Body<D> &b) const {
    const int64_t sum = wrapping_sum(a.radius, b.radius);
    if (non_additivity == 0.0 || a.radius == b.radius) return sum;
    return wrapping_sum(sum, std::llrint(static_cast<double>(sum) * non_additivity));
  }
  double mean_radius() const {
    double sum = 0.0;
    for (const Body<D> &b : body) sum += static_cast<double>(b.radius);
    return sum / n;
  }
  double largest_radius() const {
    double largest = 0.0;
    for (const Body<D> &b : body) largest = std::max(largest, static_cast<double>(b.radius));
    return largest;
  }
  // Sum of m v^2 about the centre of mass, of velocities times `unit`; along walls in full. One sphere without walls
  // has no motion but this one, so it counts.
  double twice_kinetic(double unit) const {
    double sum = 0.0, momentum[D] = {};
    for (int32_t i = 0; i < n; ++i) {
      const double m = mass_of(i);
      for (int c = 0; c < D; ++c) {
        sum += m * (body[i].v[c] * unit) * (body[i].v[c] * unit);
        momentum[c] += m * (body[i].v[c] * unit);
      }
    }
    if (n > 1 || closed)
      for (int c = 0; c < D; ++c)
        if (!(closed >> c & 1)) sum -= momentum[c] * momentum[c] / n;
    return sum;
  }
  // Root of the mean squared velocity towards walls.
  double speed_to_walls(double unit) const {
    double sum = 0.0;
    for (int32_t i = 0; i < n; ++i)
      for (int c = 0; c < D; ++c)
        if (closed >> c & 1) sum += (body[i].v[c] * unit) * (body[i].v[c] * unit);
    return std::sqrt(sum / n);
  }
  // Root of the mean squared velocity of two spheres against each other; 0 where all move as one.
  double relative_speed(double unit) const {
    // Of velocities against the mean one: a difference of sums would leave rounding where the spheres move as one.
    double mean[D] = {}, own = 0.0, all = 0.0;
    for (int32_t i = 0; i < n; ++i)
      for (int c = 0; c < D; ++c) mean[c] += mass_of(i) * body[i].v[c] / n;
    for (int32_t i = 0; i < n; ++i)
      for (int c = 0; c < D; ++c) {
        const double v = body[i].v[c], u = v - mean[c];
        own += mass_of(i) * (u * unit) * (u * unit);
        all += mass_of(i) * (v * unit) * (v * unit);
      }
    if (n < 2 || !(own > CollisionTuning::motion_as_one * all)) return 0.0;
    return std::sqrt(2.0 * own / static_cast<double>(n));
  }
};

}  // namespace jam::inside
