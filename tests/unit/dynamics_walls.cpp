// Walls in molecular dynamics against an engine that knows no lists, no integers and no core/container: long double,
// every pair and every wall at each step, formulae of its own.
#include "core/container.hpp"
#include "core/pairs.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "naive_dynamics.hpp"

using namespace jamtest;

namespace {

struct Scene {
  const char *name;
  int dim;
  int32_t container, walls;
  double edge[3];
};

const Scene scenes[] = {
    {"between lines", 2, JAM_CONTAINER_BRICK, 2, {1.0, 1.0, 0}},
    {"in a rectangle", 2, JAM_CONTAINER_BRICK, 3, {2.0, 1.0, 0}},
    {"in a circle", 2, JAM_CONTAINER_BALL, 0, {1.0, 1.0, 0}},
    {"in a slit", 3, JAM_CONTAINER_BRICK, 4, {1.0, 1.0, 1.0}},
    {"in a long slit", 3, JAM_CONTAINER_BRICK, 1, {0.7, 1.5, 1.1}},
    {"in a box", 3, JAM_CONTAINER_BRICK, 7, {1.0, 1.0, 1.0}},
    {"in a tube", 3, JAM_CONTAINER_CYLINDER, 0, {1.0, 1.0, 1.7}},
    {"in a can", 3, JAM_CONTAINER_CYLINDER, 4, {1.0, 1.0, 1.0}},
    {"in a ball", 3, JAM_CONTAINER_BALL, 0, {1.0, 1.0, 1.0}},
    {"in a cone", 3, JAM_CONTAINER_CONE, 4, {1.0, 1.0, 1.2}},
};

Packing start(const Scene &s, int n, double fraction, double ratio, int64_t seed) {
  jam_create_options o = default_create_options();
  o.dim = s.dim;
  o.n = n;
  o.seed = seed;
  o.packing_fraction = fraction;
  std::vector<double> diameters(n), rows(static_cast<size_t>(s.dim) * s.dim, 0.0);
  for (int i = 0; i < n; ++i) diameters[i] = std::pow(ratio, n > 1 ? static_cast<double>(i) / (n - 1) : 0.0);
  for (int c = 0; c < s.dim; ++c) rows[c * s.dim + c] = s.edge[c];
  o.container = s.container, o.walls = s.walls;
  Packing p = make_packing(o, nullptr, 0, diameters.data(), diameters.size(), rows.data());
  draw_velocities(p, seed);
  return p;
}

// Of the generators of a cone whose upper end is half as wide: their angle with the axis.
struct Slope {
  long double tan, cos;
};
Slope slope_of(const Scene &s) {
  if (s.container != JAM_CONTAINER_CONE) return {0.0L, 1.0L};
  const long double tan = 0.25L * s.edge[0] / s.edge[2];
  return {tan, 1.0L / std::sqrt(1.0L + tan * tan)};
}

// Time until the sphere meets wall w, the smallest positive root by the formula of a quadratic; 1e30: never.
long double to_wall(const Scene &s, int axis, int side, const long double *x, const long double *v, long double radius,
                    long double speed) {
  if (axis < s.dim) {
    const long double gap = (side ? s.edge[axis] - x[axis] : x[axis]) - radius;
    const long double closing = speed + (side ? v[axis] : -v[axis]);
    return closing > 0 ? std::fmax(0.0L, gap) / closing : 1e30L;
  }
  const int round = s.container == JAM_CONTAINER_BALL ? s.dim : 2;
  const Slope cone = slope_of(s);
  const long double half = 0.5L * s.edge[0], room = half - cone.tan * x[s.dim - 1] - radius / cone.cos;
  const long double narrows = cone.tan * v[s.dim - 1] + speed / cone.cos;
  long double rr = 0, rv = 0, vv = 0;
  for (int c = 0; c < round; ++c) {
    rr += (x[c] - half) * (x[c] - half);
    rv += (x[c] - half) * v[c];
    vv += v[c] * v[c];
  }
  // |r + v t|^2 = (room - narrows t)^2
  const long double a = vv - narrows * narrows, b = rv + room * narrows, c = rr - room * room;
  const long double disc = std::fmax(0.0L, b * b - a * c), end = (-b + std::sqrt(disc)) / a;
  if (c >= -1e-17L && b > 0) return 0;
  return end > 0 ? end : 1e30L;
}

int naive_walls(const Scene &s, Packing &p, int collisions, long double rate) {
  const int d = p.dim, n = static_cast<int>(p.n());
  const long double side = p.cell.side();
  std::vector<long double> x(p.position.begin(), p.position.end()), v(p.velocity.begin(), p.velocity.end());
  for (long double &u : v) u *= side;
  bool open[3];
  for (int c = 0; c < d; ++c)
    open[c] = !(s.walls >> c & 1) &&
              (s.container == JAM_CONTAINER_BRICK || (s.container == JAM_CONTAINER_CYLINDER && c == 2));
  long double now = 0;
  int at_walls = 0;
  for (int done = 0; done < collisions; ++done) {
    long double best = 1e30L, at[3] = {};
    int bi = -1, bj = -1, axis = -1, end = 0;
    for (int i = 0; i < n; ++i) {
      const long double radius = 0.5L * p.diameter[i];
      for (int c = 0; c <= d; ++c)
        for (int up = 0; up < 2; ++up) {
          if (c < d ? !(s.walls >> c & 1) : s.container == JAM_CONTAINER_BRICK || up == 0) continue;
          const long double t = to_wall(s, c, up, &x[i * d], &v[i * d], radius * (1 + rate * now), radius * rate);
          if (t < best) best = t, bi = i, bj = -1, axis = c, end = up;
        }
      for (int j = i + 1; j < n; ++j)
        for (int m = 0; m < 27; ++m) {
          long double r[3], rv = 0, vv = 0, rr = 0;
          int digits = m;
          bool wanted = true;
          for (int c = 0; c < 3; ++c, digits /= 3) {
            const int shift = digits % 3 - 1;
            if (c >= d || !open[c]) {
              wanted = wanted && shift == 0;
              if (c >= d) continue;
            }
            r[c] = x[i * d + c] - x[j * d + c];
            if (open[c]) r[c] += (shift - std::round(r[c] / s.edge[c])) * s.edge[c];
          }
          if (!wanted) continue;
          for (int c = 0; c < d; ++c) {
            const long double w = v[i * d + c] - v[j * d + c];
            rv += r[c] * w, vv += w * w, rr += r[c] * r[c];
          }
          const long double s0 = 0.5L * (p.diameter[i] + p.diameter[j]), sum = s0 * (1 + rate * now), g = s0 * rate;
          const long double a = vv - g * g, b = rv - sum * g, gap = rr - sum * sum, disc = b * b - a * gap;
          if (b >= 0 || disc < 0) continue;
          const long double t = gap <= 0 ? 0 : gap / (std::sqrt(disc) - b);
          if (!(t < best)) continue;
          best = t, bi = i, bj = j;
          for (int c = 0; c < d; ++c) at[c] = r[c] + (v[i * d + c] - v[j * d + c]) * t;
        }
    }
    assert_true(bi >= 0 && best < 1e29L);
    for (size_t k = 0; k < x.size(); ++k) x[k] += v[k] * best;
    now += best;
    if (bj < 0) {
      ++at_walls;
      long double normal[3] = {}, rr = 0, vn = 0;
      if (axis < d) {
        normal[axis] = end ? -1 : 1;
      } else {
        const int round = s.container == JAM_CONTAINER_BALL ? d : 2;
        const Slope cone = slope_of(s);
        for (int c = 0; c < round; ++c) normal[c] = 0.5L * s.edge[0] - x[bi * d + c], rr += normal[c] * normal[c];
        for (int c = 0; c < round; ++c) normal[c] *= cone.cos / std::sqrt(rr);
        if (round < d) normal[2] = -cone.tan * cone.cos;
      }
      for (int c = 0; c < d; ++c) vn += normal[c] * v[bi * d + c];
      for (int c = 0; c < d; ++c) v[bi * d + c] += 2 * (0.5L * p.diameter[bi] * rate - vn) * normal[c];
      continue;
    }
    collide(p, bi, bj, at, rate, v);
  }
  write_back(p, x, v, side, 1 + rate * now);
  return at_walls;
}

// A perturbation grows about tenfold each collision of a sphere, so 60 collisions of 8 spheres leave 1e-15 below 1e-6.
CASE(brute_force_makes_the_same_collisions) {
  const struct {
    int n;
    double fraction;
    int64_t seed;
  } starts[] = {{8, 0.15, 1}, {8, 0.15, 2}, {8, 0.15, 3}, {24, 0.2, 4}, {40, 0.04, 5}};  // the last: cells alone
  for (const Scene &s : scenes)
    for (const double rate : {0.0, 0.3})
      for (const auto &from : starts) {
        Packing p = start(s, from.n, from.fraction, 1.5, from.seed), brute = p;
        EngineOptions o;
        o.growth = rate * diameter_mean(p) / p.cell.side();
        const int at_walls = naive_walls(s, brute, 60, rate);
        assert_in_range(at_walls, 5, 60);
        agrees(p, brute, o, 60, 1e-6);
        assert_true(closest_wall(p).gap > -1e-14 && closest_pair(p).gap > -1e-13);
      }
}

// Volume by counting random points.
CASE(volumes_hold_that_share_of_random_points) {
  for (const Scene &s : scenes) {
    const Packing p = start(s, 2, 0.01, 1.0, 1);
    Rng rng(9, Stream::velocities);
    const int many = 200000;
    int inside = 0;
    for (int k = 0; k < many; ++k) {
      double x[3];
      for (int c = 0; c < s.dim; ++c) x[c] = s.edge[c] * rng.uniform();
      inside += p.container.holds(x, 0.0);
    }
    const double share = p.container.volume() / p.cell.volume(), sigma = std::sqrt(share * (1.0 - share) / many);
    assert_true(std::fabs(inside / static_cast<double>(many) - share) <= 5.0 * sigma + 1e-12);
    assert_true(std::fabs(scene_volume(p) - p.container.volume()) == 0.0);
  }
}

}  // namespace
