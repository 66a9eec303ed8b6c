// Balls near a point, by boxes: spheres and their images around the brick.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/math.hpp"
#include "core/packing.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {

// Spheres and their images in the brick of the cell, which repeats as the cell does: the part of all images inside the
// brick is the solid of one cell.

// A sphere and the lattice vector that takes it there, in whole cell vectors.
struct SphereImage {
  int32_t sphere;
  std::array<int, 3> cells;
  std::array<double, 3> centre;  // by image_centre, which gives the same bits for the same image
};
std::array<double, 3> image_centre(const Packing &p, int32_t sphere, const std::array<int, 3> &cells);

// All images within reach[i] of the brick, sorted by sphere; d = 2, 3.
std::vector<SphereImage> images_near_brick(const Packing &p, const std::vector<double> &reach);

// JAM_E_UNSUPPORTED in other dimensions, and for Mari-Kurchan spheres, which have no places beside each other.
void check_has_pores(const Packing &p);

// The whole vectors of a lattice vector.
std::array<int, 3> cells_of(const Cell &cell, const double *offset);

using Point = std::array<double, 3>;
struct Ball {
  Point x;
  double r;
};

inline double dot(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point cross(const Point &a, const Point &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The unit of lengths of pores: the mean diameter, or a share of the mean distance of spheres where this is longer. So
// the numbers of boxes and of points stay the same as spheres shrink.
inline double spacing(const Packing &p) {
  return std::max(diameter_mean(p),
                  BallsTuning::of_distance * math::pow(p.cell.volume() / static_cast<double>(p.n()), 1.0 / p.dim));
}

class Balls {
 public:
  // All balls whose surface is within `reach` of the brick.
  Balls(const Packing &p, double reach) : p_(p) {
    std::vector<double> far(p.n());
    for (size_t i = 0; i < p.n(); ++i) {
      far[i] = 0.5 * p.diameter[i] + reach;
      widest_ = std::max(widest_, 0.5 * p.diameter[i]);
    }
    const double side = std::max(spacing(p), BallsTuning::of_reach * reach);
    for (int c = 0; c < p.dim; ++c) {
      low_[c] = -(reach + widest_);
      const double length = p.cell.edge(c) - 2.0 * low_[c];
      count_[c] = static_cast<int64_t>(std::min(BallsTuning::most_cells, std::ceil(length / side)));
      side_[c] = length / static_cast<double>(count_[c]);
    }
    at_.resize(static_cast<size_t>(count_[0] * count_[1] * count_[2]));
    for (const SphereImage &s : images_near_brick(p, far)) {
      at_[box_of(s.centre)].push_back(static_cast<int32_t>(ball_.size()));
      ball_.push_back({s.centre, 0.5 * p.diameter[static_cast<size_t>(s.sphere)]});
      own_.push_back(s.sphere);
      first_.push_back(s.cells == std::array<int, 3>{});
    }
  }
  Ball primary(size_t i) const { return {image_centre(p_, static_cast<int32_t>(i), {}), 0.5 * p_.diameter[i]}; }
  size_t box_of(const Point &x) const {
    return static_cast<size_t>((box(x[2], 2) * count_[1] + box(x[1], 1)) * count_[0] + box(x[0], 0));
  }

  // Balls whose surface is at most s from x. With `from`: only those of spheres of this number and above; of sphere
  // `from` its images alone.
  void near(const Point &x, double s, std::vector<Ball> &out, int32_t from = -1) const {
    out.clear();
    each_near(x, s, [&](size_t k, double distance) {
      if (distance <= s && (from < 0 || own_[k] > from || (own_[k] == from && !first_[k]))) out.push_back(ball_[k]);
    });
  }
  // Distance to the nearest surface, negative inside; s where none is nearer.
  double clearance(const Point &x, double s) const {
    double least = s;
    each_near(x, s, [&](size_t, double distance) { least = std::min(least, distance); });
    return least;
  }
  // Which balls of a list, with their images in the brick, reach into each box.
  void sort_into_boxes(std::vector<Ball> &balls, std::vector<std::vector<int32_t>> &at) const {
    Packing p = p_;
    p.position.clear(), p.diameter.clear();
    std::vector<double> reach;
    for (const Ball &b : balls) {
      p.position.insert(p.position.end(), b.x.begin(), b.x.begin() + p.dim);
      p.diameter.push_back(2.0 * b.r);
      reach.push_back(b.r);
    }
    balls.clear();
    at.assign(at_.size(), {});
    for (const SphereImage &s : images_near_brick(p, reach)) {
      const double r = reach[static_cast<size_t>(s.sphere)];
      each_box(s.centre, r, [&](size_t k) { at[k].push_back(static_cast<int32_t>(balls.size())); });
      balls.push_back({s.centre, r});
    }
  }

 private:
  int64_t box(double x, int c) const {
    if (c >= p_.dim) return 0;
    return std::min(count_[c] - 1, std::max<int64_t>(0, static_cast<int64_t>(std::floor((x - low_[c]) / side_[c]))));
  }
  template <class F>
  void each_box(const Point &x, double r, const F &f) const {
    for (int64_t z = box(x[2] - r, 2); z <= box(x[2] + r, 2); ++z)
      for (int64_t y = box(x[1] - r, 1); y <= box(x[1] + r, 1); ++y)
        for (int64_t k = box(x[0] - r, 0); k <= box(x[0] + r, 0); ++k)
          f(static_cast<size_t>((z * count_[1] + y) * count_[0] + k));
  }
  template <class F>
  void each_near(const Point &x, double s, const F &f) const {
    each_box(x, s + widest_, [&](size_t b) {
      for (const int32_t k : at_[b]) {
        const Ball &ball = ball_[static_cast<size_t>(k)];
        const Point d = minus(ball.x, x);
        f(static_cast<size_t>(k), std::sqrt(dot(d, d)) - ball.r);
      }
    });
  }
  const Packing &p_;
  double widest_ = 0.0;
  Point low_{}, side_{1.0, 1.0, 1.0};
  std::array<int64_t, 3> count_{1, 1, 1};
  std::vector<Ball> ball_;
  std::vector<int32_t> own_;
  std::vector<char> first_;
  std::vector<std::vector<int32_t>> at_;
};

}  // namespace jam::inside
