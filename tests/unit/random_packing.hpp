// Spheres at random points of a cube of side 1, which overlap: starts of soft spheres.
#pragma once
#include <cmath>

#include "core/packing.hpp"
#include "core/rng.hpp"

namespace jam::inside {

// mixture: every other sphere is 1.4 times as large.
inline Packing random_packing(int dim, int n, double phi, int64_t seed, bool mixture) {
  Packing p;
  p.set_cube(dim, 1.0);
  p.seed = seed;
  Rng rng(seed, Stream::rsa_positions);
  p.position.resize(static_cast<size_t>(n) * dim);
  for (double &x : p.position) x = rng.uniform();
  p.diameter.assign(n, 1.0);
  if (mixture)
    for (int i = 0; i < n; i += 2) p.diameter[i] = 1.4;
  const double scale = std::pow(phi / packing_fraction(p), 1.0 / dim);
  for (double &s : p.diameter) s *= scale;
  p.velocity.assign(p.position.size(), 0.0);
  return p;
}
// Disks are mixed, so that they do not order.
inline Packing random_packing(int dim, int n, double phi, int64_t seed) {
  return random_packing(dim, n, phi, seed, dim == 2);
}

}  // namespace jam::inside
