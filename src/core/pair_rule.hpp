// The rule of a pair: at which distance two spheres touch, and in the Mari-Kurchan model by which vector their distance
// is shifted. Inner loops of dynamics and Monte Carlo repeat it for speed, proofs in exact numbers.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/packing.hpp"
#include "core/rng.hpp"

namespace jam::inside {

// Contact distance sigma_ij; of a wall, j < 0, the radius. Additive: (sigma_i + sigma_j) / 2. Non-additive mixture: (1
// + Delta) times that for spheres of unequal diameters.
template <class Real = double>
Real contact_distance(const Packing &p, int32_t i, int32_t j) {
  if (j < 0) return Real(0.5) * static_cast<Real>(p.diameter[i]);
  const Real mean = Real(0.5) * (static_cast<Real>(p.diameter[i]) + p.diameter[j]);
  if (p.non_additivity == 0.0 || p.diameter[i] == p.diameter[j]) return mean;
  return (Real(1.0) + p.non_additivity) * mean;
}

// An upper bound of contact_distance over all pairs.
inline double contact_distance_max(const Packing &p) {
  return (1.0 + std::max(0.0, p.non_additivity)) * diameter_max(p);
}

// Quenched shifts of the Mari-Kurchan model (J. Chem. Phys. 135, 124504 (2011)), from a counter-based generator: only
// the few pairs whose shift was drawn again when the start was planted are stored.
class MkShifts {
 public:
  explicit MkShifts(const Packing &p)
      : dim_(p.dim),
        zeta_(p.mk_zeta),
        uniform_(!std::isfinite(p.mk_zeta)),
        key_(mix64(mix64(static_cast<uint64_t>(p.seed)) ^ static_cast<uint64_t>(Stream::mk_shift))),
        redrawn_(p.mk_redrawn) {}

  // Shift of the pair in box sides, each component in [-1/2, 1/2]: r_ij = r_i - r_j + box * shift, antisymmetric.
  void get(int32_t i, int32_t j, double *shift) const {
    const int32_t a = std::min(i, j), b = std::max(i, j);
    draw(a, b, attempt(a, b), i < j ? 1.0 : -1.0, shift);
  }
  void draw(int32_t a, int32_t b, int32_t attempt, double sign, double *shift) const {
    const uint64_t pair = pair_key(a, b);
    for (int c = 0; c < dim_; ++c) shift[c] = sign * component(pair, attempt, c);
  }
  // The parts of draw, for loops that give up after the first component; a < b.
  uint64_t pair_key(int32_t a, int32_t b) const {
    return mix64(key_ ^ mix64(static_cast<uint64_t>(a) << 32 | static_cast<uint64_t>(b)));
  }
  double component(uint64_t pair, int32_t attempt, int c) const {
    const uint64_t bits = mix64(pair + static_cast<uint64_t>(attempt) * 16 + static_cast<uint64_t>(c));
    const double x = static_cast<double>(static_cast<int64_t>(bits >> 11)) * 0x1.0p-53 - 0.5;
    if (uniform_) return x;
    return x * zeta_ - std::nearbyint(x * zeta_);
  }
  const std::vector<MkRedrawn> &redrawn() const { return redrawn_; }
  uint64_t key() const { return key_; }
  double zeta() const { return zeta_; }

 private:
  int32_t attempt(int32_t a, int32_t b) const {
    const auto at =
        std::lower_bound(redrawn_.begin(), redrawn_.end(), MkRedrawn{a, b, 0},
                         [](const MkRedrawn &x, const MkRedrawn &y) { return x.i != y.i ? x.i < y.i : x.j < y.j; });
    return at != redrawn_.end() && at->i == a && at->j == b ? at->attempt : 0;
  }
  int dim_;
  double zeta_;
  bool uniform_;
  uint64_t key_;
  std::vector<MkRedrawn> redrawn_;
};

}  // namespace jam::inside
