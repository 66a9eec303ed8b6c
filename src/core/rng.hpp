// Counter-based random numbers: value = f(seed, stream, counter). Streams do not depend on the order of their use, and
// only the counter has to be saved.
#pragma once
#include <cmath>
#include <cstdint>

#include "core/math.hpp"

namespace jam::inside {

// Every use of randomness has its own number. Never change one: that would change packings.
enum class Stream : uint64_t {
  rsa_positions = 1,
  velocities = 2,
  mk_shift = 3,
  analysis_start = 4,
  run_velocities = 21,  // isoconfigurational runs
  monte_carlo = 22,
  coincident = 23,   // directions in which soft spheres at one centre part
  sizes = 24,        // of jam_diameters
  pore_points = 25,  // of jam_pore_sizes
  recompression = 26,
  soft_saddle = 27,
  radii_saddle = 28,
};

// Finaliser of splitmix64 (Steele, Lea and Flood, OOPSLA 2014): a bijective mix of 64 bits.
inline uint64_t mix64(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

class Rng {
 public:
  Rng(int64_t seed, Stream stream, uint64_t counter = 0)
      : key_(mix64(mix64(static_cast<uint64_t>(seed)) ^ (static_cast<uint64_t>(stream) << 32))), counter_(counter) {}
  uint64_t bits() { return mix64(key_ ^ mix64(counter_++)); }
  // Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  // Standard normal by Box and Muller; the second of the pair is discarded, so that the counter is the only state.
  double normal() {
    const double u = 1.0 - uniform();
    const double v = uniform();
    return std::sqrt(-2.0 * math::log(u)) * math::cos_of_turns(v);
  }

 private:
  uint64_t key_, counter_;
};

}  // namespace jam::inside
