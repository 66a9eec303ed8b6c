// Points in the local order of a dense packing and their neighbour graphs, for benchmarks of factorisations.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/rng.hpp"

namespace jam::inside {

struct Points {
  double box = 1.0;  // edge; positions in [0, box)
  std::vector<double> x;
  size_t size() const { return x.size() / 3; }
};

struct Pairs {
  std::vector<int32_t> i, j;
};

inline Pairs pairs_within(const Points &p, double radius) {
  const int cells = std::max(1, static_cast<int>(p.box / radius));
  std::vector<std::vector<int32_t>> cell(static_cast<size_t>(cells) * cells * cells);
  const auto index = [&](int a, int b, int c) {
    const auto wrap = [&](int v) { return (v + cells) % cells; };
    return (static_cast<size_t>(wrap(a)) * cells + wrap(b)) * cells + wrap(c);
  };
  const auto of = [&](double v) { return std::min(cells - 1, static_cast<int>(v / p.box * cells)); };
  for (size_t k = 0; k < p.size(); ++k)
    cell[index(of(p.x[3 * k]), of(p.x[3 * k + 1]), of(p.x[3 * k + 2]))].push_back(static_cast<int32_t>(k));
  Pairs out;
  for (int32_t k = 0; k < static_cast<int32_t>(p.size()); ++k) {
    std::vector<int32_t> found;
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b)
        for (int c = -1; c <= 1; ++c)
          for (int32_t l : cell[index(of(p.x[3 * k]) + a, of(p.x[3 * k + 1]) + b, of(p.x[3 * k + 2]) + c)]) {
            if (l <= k) continue;
            double r2 = 0.0;
            for (int q = 0; q < 3; ++q) {
              double t = p.x[3 * k + q] - p.x[3 * l + q];
              t -= p.box * std::nearbyint(t / p.box);
              r2 += t * t;
            }
            if (r2 < radius * radius) found.push_back(l);
          }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (int32_t l : found) out.i.push_back(k), out.j.push_back(l);
  }
  return out;
}

// Random points pushed apart by soft spheres of the diameter that fills 0.64 of the box: a few sweeps give the local
// order of a dense packing.
inline Points relaxed_points(size_t n) {
  Points p;
  p.x.resize(3 * n);
  Rng rng(static_cast<int64_t>(n), Stream::rsa_positions);
  for (double &v : p.x) v = rng.uniform();
  const double sigma = std::cbrt(0.64 * 6.0 / 3.14159265358979 / static_cast<double>(n));
  std::vector<double> push(3 * n);
  for (int sweep = 0; sweep < 60; ++sweep) {
    const Pairs near = pairs_within(p, 1.1 * sigma);
    std::fill(push.begin(), push.end(), 0.0);
    for (size_t k = 0; k < near.i.size(); ++k) {
      double t[3], r2 = 1e-30;
      for (int q = 0; q < 3; ++q) {
        t[q] = p.x[3 * near.i[k] + q] - p.x[3 * near.j[k] + q];
        t[q] -= std::nearbyint(t[q]);
        r2 += t[q] * t[q];
      }
      const double strength = 0.3 * (1.1 * sigma / std::sqrt(r2) - 1.0);
      for (int q = 0; q < 3; ++q)
        push[3 * near.i[k] + q] += strength * t[q], push[3 * near.j[k] + q] -= strength * t[q];
    }
    for (size_t k = 0; k < p.x.size(); ++k) {
      p.x[k] += std::max(-0.2 * sigma, std::min(0.2 * sigma, push[k]));
      p.x[k] -= std::floor(p.x[k]);
    }
  }
  return p;
}

// The radius that gives `degree` pairs a particle.
inline Pairs pairs_of_degree(const Points &p, double degree) {
  double low = 0.0, high = 2.0 * p.box / std::cbrt(static_cast<double>(p.size()));
  Pairs out;
  for (int step = 0; step < 16; ++step) {
    const double middle = 0.5 * (low + high);
    out = pairs_within(p, middle);
    const double found = static_cast<double>(out.i.size()) / static_cast<double>(p.size());
    if (std::fabs(found - degree) < 0.02) break;
    (found < degree ? low : high) = middle;
  }
  return out;
}

// A^T D A + box with weights over ten decades, as in the middle of an interior point.
inline void make_values(const Points &p, const Pairs &e, std::vector<double> &diag, std::vector<double> &off) {
  Rng rng(7, Stream::velocities);
  diag.assign(9 * p.size(), 0.0), off.resize(9 * e.i.size());
  for (size_t i = 0; i < p.size(); ++i)
    for (int q = 0; q < 3; ++q) diag[9 * i + 4 * q] = 1e-2;
  for (size_t k = 0; k < e.i.size(); ++k) {
    double t[3];
    for (int q = 0; q < 3; ++q) {
      t[q] = p.x[3 * e.i[k] + q] - p.x[3 * e.j[k] + q];
      t[q] -= p.box * std::nearbyint(t[q] / p.box);
    }
    const double weight = std::pow(10.0, 6.0 * rng.uniform() - 2.0) / (t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
    for (int a = 0; a < 9; ++a) {
      const double v = weight * t[a / 3] * t[a % 3];
      diag[9 * e.i[k] + a] += v, diag[9 * e.j[k] + a] += v, off[9 * k + a] = -v;
    }
  }
}

}  // namespace jam::inside
