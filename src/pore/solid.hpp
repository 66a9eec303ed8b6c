// The solid as parts that share no volume: of each sphere what its power cell holds (H. Edelsbrunner, Discrete Comput.
// Geom. 13, 415 (1995)), so that volumes of spheres that overlap add up to that of their union. Walls cut off what lies
// beyond them. Spheres that overlap nothing are whole, and nothing is computed for them.
#pragma once
#include <algorithm>
#include <vector>

#include "core/pairs.hpp"
#include "pore/cut_ball.hpp"

namespace jam::inside {

// Pairs of spheres that share volume, by their radii: in a non-additive mixture contacts may do so. Overlaps below
// SolidTuning::overlap, those of hard spheres by rounding, do not count.
PairList overlapping_pairs(const Packing &p);
// How deep a sphere of radius r at distance `apart` from one of radius q enters it, over the smaller radius.
inline double relative_overlap(double r, double q, double apart) { return (r + q - apart) / std::min(r, q); }

class Solid {
 public:
  explicit Solid(const Packing &p);
  bool is_whole(size_t i) const { return cuts_.empty() || (cuts_[i].empty() && !passes_[i]); }
  // About the centre of sphere i: of other spheres and of flat walls.
  const std::vector<HalfSpace> &cuts(size_t i) const { return cuts_.empty() ? none_ : cuts_[i]; }
  bool passes_round_wall(size_t i) const { return !passes_.empty() && passes_[i]; }
  bool any_passes_round_wall() const;
  // Of its part within one more half-space.
  double volume(size_t i, const HalfSpace &more) const;
  // Of its part within this distance from the axis or the centre of the round container.
  double volume_within(size_t i, double radius) const;

 private:
  void cut_by_walls();
  // Within a round wall of this radius.
  double in_round(size_t i, double radius, const std::vector<HalfSpace> &cuts) const;
  const Packing &p_;
  std::vector<std::vector<HalfSpace>> cuts_;  // of each sphere; empty where all are whole
  std::vector<char> passes_;                  // the round wall
  std::vector<HalfSpace> none_;
};

}  // namespace jam::inside
