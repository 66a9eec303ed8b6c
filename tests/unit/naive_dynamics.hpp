// Event-driven dynamics that looks at every pair and image each time, in long double: the oracle of the engine.
#pragma once
#include <cmath>
#include <memory>
#include <vector>

#include "core/create.hpp"
#include "core/monitor.hpp"
#include "core/pair_rule.hpp"
#include "core/pairs.hpp"
#include "core/rng.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/run.hpp"

#include "test.h"

namespace jamtest {

using namespace jam::inside;

// A monitor of a call that begins now.
inline Monitor &begun() {
  static Monitor monitor;
  monitor.begin();
  return monitor;
}

inline void draw_velocities(Packing &p, int64_t seed) {
  Rng rng(seed, Stream::velocities, 1000000);
  for (double &v : p.velocity) v = rng.normal();
  p.has_velocity = true;
}

// rows: of a cell (dim, dim), or NULL for the unit cube.
inline Packing random_packing(int dim, int n, double fraction, double ratio, int64_t seed, double non_additivity = 0.0,
                              int32_t model = JAM_MODEL_EUCLID, const double *rows = nullptr) {
  jam_create_options o = default_create_options();
  o.dim = dim;
  o.n = n;
  o.seed = seed;
  o.packing_fraction = fraction;
  o.non_additivity = non_additivity;
  o.model = model;
  std::vector<double> diameters(n, 1.0);
  for (int i = 0; i < n; ++i) diameters[i] = std::pow(ratio, n > 1 ? static_cast<double>(i) / (n - 1) : 0.0);
  Packing p = make_packing(o, nullptr, 0, diameters.data(), diameters.size(), rows);
  draw_velocities(p, seed);
  return p;
}

// Takes lattice vectors off r until no component is longer than half an edge.
inline void to_brick(const Cell &cell, long double *r) {
  for (int c = cell.dim() - 1; c >= 0; --c) {
    const long double m = std::round(r[c] / cell.edge(c));
    for (int k = 0; k <= c; ++k) r[k] -= m * cell.row(c)[k];
  }
}

// Velocities after i and j met at the distance `at`, with diameters that grow by `rate` of themselves.
inline void collide(const Packing &p, int i, int j, const long double *at, long double rate,
                    std::vector<long double> &v) {
  const int d = p.dim;
  long double rr = 0, rv = 0;
  for (int c = 0; c < d; ++c) rr += at[c] * at[c], rv += at[c] * (v[i * d + c] - v[j * d + c]);
  const long double push = contact_distance<long double>(p, i, j) * rate - rv / std::sqrt(rr);
  for (int c = 0; c < d; ++c) {
    v[i * d + c] += push * at[c] / std::sqrt(rr);
    v[j * d + c] -= push * at[c] / std::sqrt(rr);
  }
}

inline void write_back(Packing &p, const std::vector<long double> &x, const std::vector<long double> &v,
                       long double side, long double growth) {
  for (size_t k = 0; k < x.size(); ++k) {
    p.position[k] = static_cast<double>(x[k]);
    p.velocity[k] = static_cast<double>(v[k] / side);
  }
  wrap_positions(p);
  for (double &s : p.diameter) s *= static_cast<double>(growth);
}

// Makes `collisions` on p; diameters grow as sigma (1 + rate t). Images lie up to `reach` cell vectors off the brick.
inline void naive(Packing &p, int collisions, long double rate, int reach = 1) {
  const int d = p.dim, n = static_cast<int>(p.n()), width = 2 * reach + 1;
  // Lengths in box sides, so that velocities are what they are in the engine.
  Cell cell = p.cell;
  const long double side = cell.side();
  std::vector<long double> x(p.position.begin(), p.position.end()), v(p.velocity.begin(), p.velocity.end());
  for (long double &u : v) u *= side;
  long double now = 0.0L;
  int images = 1;
  for (int c = 0; c < d; ++c) images *= width;
  std::vector<long double> shift(static_cast<size_t>(images * d), 0.0L);
  for (int k = 0; k < images; ++k)
    for (int c = 0, m = k; c < d; ++c, m /= width)
      for (int q = 0; q <= c; ++q) shift[k * d + q] += (m % width - reach) * static_cast<long double>(cell.row(c)[q]);
  for (int done = 0; done < collisions; ++done) {
    long double best = 1e30L, at[8] = {};
    int bi = -1, bj = -1;
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        long double first[8], w[8], vv = 0;
        for (int c = 0; c < d; ++c) {
          first[c] = x[i * d + c] - x[j * d + c], w[c] = v[i * d + c] - v[j * d + c];
          vv += w[c] * w[c];
        }
        to_brick(cell, first);
        const long double s0 = contact_distance<long double>(p, i, j), s = s0 * (1 + rate * now), g = s0 * rate,
                          a = vv - g * g;
        for (int m = 0; m < images; ++m) {
          long double r[8], rv = 0, rr = 0;
          for (int c = 0; c < d; ++c) r[c] = first[c] + shift[m * d + c], rv += r[c] * w[c], rr += r[c] * r[c];
          const long double b = rv - s * g, gap = rr - s * s, disc = b * b - a * gap;
          if (b >= 0 || disc < 0) continue;
          const long double t = gap <= 0 ? 0 : gap / (std::sqrt(disc) - b);
          if (!(t < best)) continue;
          best = t, bi = i, bj = j;
          for (int c = 0; c < d; ++c) at[c] = r[c] + w[c] * t;
        }
      }
    assert_true(bi >= 0);
    for (size_t k = 0; k < x.size(); ++k) x[k] += v[k] * best;
    now += best;
    collide(p, bi, bj, at, rate, v);
  }
  write_back(p, x, v, side, 1 + rate * now);
}

inline double furthest(const Packing &a, const Packing &b) {
  const int d = a.dim;
  double worst = 0.0;
  for (size_t i = 0; i < a.n(); ++i) {
    long double r[8];
    for (int c = 0; c < d; ++c) r[c] = a.position[i * d + c] - b.position[i * d + c];
    to_brick(a.cell, r);
    for (int c = 0; c < d; ++c) {
      const auto x = static_cast<double>(std::fabs(r[c]));
      worst = std::fmax(worst, std::fmax(x, std::fabs(a.velocity[i * d + c] - b.velocity[i * d + c])));
    }
  }
  return worst;
}

// As many collisions of the engine lead p to where the naive ones led.
inline std::unique_ptr<Engine> agrees(Packing &p, const Packing &expected, const EngineOptions &o, int collisions,
                                      double tolerance) {
  auto engine = make_engine(p, o);
  assert_int_equal(engine->advance(collisions, begun()), Halt::window);
  engine->write_state(p);
  const double distance = furthest(p, expected);
  if (!(distance < tolerance))
    fail_msg("d %d, n %zu, growth %g, cells %d: %g", p.dim, p.n(), o.growth, static_cast<int>(o.cells), distance);
  assert_true(std::fabs(diameter_mean(p) / diameter_mean(expected) - 1.0) < 1e-9);
  return engine;
}

// All images of all pairs are looked at when the growth is over.
inline void grows_without_overlap(Packing p, double growth, double pressure) {
  jam_md_report report{};
  const jam_status status = run_stage(p, {growth, pressure, never, 1e5, 300.0}, begun(), report);
  const double gap = closest_pair(p).gap;
  if (status != JAM_OK || !(gap > -1e-14 && report.max_overlap < 1e-13 && report.pressure >= pressure))
    fail_msg("d %d, n %zu: status %d, p %g, gap %g, overlap %g", p.dim, p.n(), status, report.pressure, gap,
             report.max_overlap);
}

}  // namespace jamtest
