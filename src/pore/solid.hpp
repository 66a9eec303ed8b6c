// The solid as parts that share no volume: of each sphere what its power cell holds (H. Edelsbrunner, Discrete Comput.
// Geom. 13, 415 (1995)), so that volumes of spheres that overlap add up to that of their union. Walls cut off what lies
// beyond them. Spheres that overlap nothing are whole, and nothing is computed for them.
#pragma once
#include <algorithm>

#include "core/pairs.hpp"
#include "pore/balls.hpp"

namespace jam::inside {

// Balls cut by half-spaces, and by one more ball or a cylinder: their volumes, in closed form except for the cylinder.

// The points x with normal . x <= offset; |normal| = 1. x counts from the centre of the ball. In d = 2 normal[2] is 0.
struct HalfSpace {
  Point normal;
  double offset;
};
// As seen from another origin.
HalfSpace seen_from(const Point &origin, const HalfSpace &h);
// Points of smaller power |x - c|^2 - R^2 about the origin, of radius R = `own`, than about `centre` with `radius`.
// Where the two centres are one point, all of them or none. `first` decides between equal balls.
HalfSpace nearer_by_power(double own, const Point &centre, double radius, bool first);

// Volume (d = 2: area) of the part of a ball that lies in all half-spaces.
double cut_volume(int dim, double radius, const std::vector<HalfSpace> &cuts);
// The same within one more ball.
double cut_volume_in_ball(int dim, double radius, const std::vector<HalfSpace> &cuts, const Ball &other);
// The same in d = 3 within a cylinder about a line through `axis.x` along z, by quadrature: CutTuning::error.
double cut_volume_in_cylinder(double radius, const std::vector<HalfSpace> &cuts, const Ball &axis);

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
