// The container: which walls enclose the spheres. This file and its .cpp have the geometry of walls: the distance of a
// point, the inward normal, the curvature, areas and volume, where a sphere fits, and when a moving and growing sphere
// meets a wall. Another shape (a cone, a rounded box) also needs the code that distinguishes round walls from flat ones
// (round_axes, is_round).
//
// The container lies in the brick of its cell and touches its faces. Along `closed` axes nothing repeats (Cell::close).
// Molecular dynamics is periodic nevertheless: images of a container do not overlap each other, so that spheres
// inside it never meet across a wall before they meet the wall. That holds for additive contact distances, and for
// smaller ones.
//
// Walls are numbered w = 0, 1, ...: the flat ones axis by axis, the one at 0 first; then the round one. A table that
// names the partner of a contact by j has j = -1 - w for a wall. A wall is a contact with the mirror image of the
// sphere: h = distance / radius - 1.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/cell.hpp"
#include "core/double_double.hpp"
#include "core/rng.hpp"
#include "jam/jam.h"

namespace jam::inside {

struct Packing;

// How a sphere nears a wall: it touches when gap - 2 slope t - bend t^2 has fallen to 0. Of a flat wall the gap is
// distance - radius; of a round one, of radius R_c about the origin, (R_c - radius)^2 - |r|^2.
struct Approach {
  double gap, slope, bend;

  // Time of contact from now; infinity without one, 0 for a sphere at the wall that moves towards it.
  double time() const {
    constexpr double never = std::numeric_limits<double>::infinity();
    const double disc = slope * slope + bend * gap;
    if (gap <= 0.0 && slope > 0.0) return 0.0;
    if (slope > 0.0) return disc < 0.0 ? never : gap / (slope + std::sqrt(disc));
    // It recedes: only a round wall comes back to it. Without a root, by rounding, the time of least overlap.
    return bend > 0.0 ? (std::sqrt(disc > 0.0 ? disc : 0.0) - slope) / bend : never;
  }
};

inline int32_t wall_partner(int w) { return -1 - w; }  // its own inverse

class Container {
 public:
  Container() = default;  // none
  // JAM_E_ARGUMENT, JAM_E_UNSUPPORTED where the cell has no such container.
  Container(int32_t kind, int32_t walls, const Cell &cell);

  explicit operator bool() const { return count() > 0; }
  int32_t kind() const { return kind_; }       // jam_container
  int32_t flat() const { return flat_; }       // axes with flat walls: bits, as jam_create_options have them
  uint32_t closed() const { return closed_; }  // axes along which nothing repeats
  int count() const { return static_cast<int>(flat_walls_) + (round_axes_ > 0 ? 1 : 0); }
  bool is_round(int w) const { return w >= flat_walls_; }
  int axis(int w) const { return is_round(w) ? dim_ : axis_[w / 2]; }
  int side(int w) const { return is_round(w) ? 1 : w % 2; }
  int round_axes() const { return round_axes_; }  // the round wall is about the origin of the first so many axes
  double volume() const { return volume_; }
  double area(int w) const;
  const char *word() const;       // of files: "brick", "cylinder", "ball"
  std::string name(int w) const;  // "the wall x = 0"
  int open_axes() const {
    int open = dim_;
    for (int c = 0; c < dim_; ++c) open -= static_cast<int>(closed_ >> c & 1);
    return open;
  }
  // Of the d components of the total momentum, the share that collisions with walls keep.
  double momentum_kept() const { return dim_ > 0 ? static_cast<double>(open_axes()) / dim_ : 1.0; }
  // Rigid motions of all spheres that the walls allow: translations along open axes, and rotations about the centre of
  // the round wall in the planes of two of its axes.
  int rotations() const { return round_axes_ * (round_axes_ - 1) / 2; }
  int symmetries() const { return open_axes() + rotations(); }
  // Velocity at x of rotation q.
  void rotation(int q, const double *x, double *v) const;
  // Widest sphere that fits.
  double widest() const { return widest_; }

  // Of a point and wall w: distance, the direction away from the wall, and 1 / |r| of a round wall: there the Hessian
  // of the distance is -(1 - n n^T) / |r| along the round axes. A flat wall has none.
  template <class Real = double>
  Real distance(int w, const double *x) const {
    if (!is_round(w)) return side(w) ? Real(edge_[axis(w)]) - Real(x[axis(w)]) : Real(x[axis(w)]);
    Real r2(0.0);
    for (int c = 0; c < round_axes_; ++c) r2 = r2 + (Real(x[c]) - Real(radius_)) * (Real(x[c]) - Real(radius_));
    return Real(radius_) - square_root(r2);
  }
  void normal(int w, const double *x, double *n) const;
  double curvature(int w, const double *x) const;
  // How much the distance changes when a point goes from x to x + u, without cancellation. n: the normal there.
  double displaced(int w, const double *x, const double *u, double *n) const;
  // Whether a sphere at x lies inside all walls.
  bool holds(const double *x, double radius) const {
    for (int w = 0; w < count(); ++w)
      if (distance(w, x) < radius) return false;
    return true;
  }
  // The vector to x from the nearest point of the wall: the r_ij of a contact. Returns its squared length.
  double vector(int w, const double *x, double *r) const {
    const double h = distance(w, x);
    normal(w, x, r);
    for (int c = 0; c < dim_; ++c) r[c] *= h;
    return h * h;
  }
  // A uniform point of the brick where a sphere of this radius may fit between flat walls.
  void random_point(const Cell &cell, Rng &rng, double radius, double *x) const;

  // Molecular dynamics: the same from integers that are exact, `edge` those of the cell; an edge of 2^64 is 0.
  template <int D>
  Approach approach(int w, const uint64_t *x, const double *v, int64_t radius, double growth,
                    const std::array<uint64_t, D> &edge) const {
    if (!is_round(w)) {
      const int c = axis(w);
      const uint64_t away = side(w) ? edge[c] - x[c] : x[c];
      const double speed = side(w) ? -v[c] : v[c];
      return {static_cast<double>(static_cast<__int128>(away) - radius), 0.5 * (growth - speed), 0.0};
    }
    const uint64_t half = half_of(edge[0]);
    const auto room = static_cast<__int128>(half) - radius;
    unsigned __int128 rest = square(room);
    double rv = 0.0, vv = 0.0;
    for (int c = 0; c < round_axes_ && c < D; ++c) {
      const auto r = static_cast<int64_t>(x[c] - half);
      rest -= square(r);
      rv += static_cast<double>(r) * v[c];
      vv += v[c] * v[c];
    }
    return {static_cast<double>(static_cast<__int128>(rest)), rv + static_cast<double>(room) * growth,
            vv - growth * growth};
  }
  // The same in doubles for a sphere at this distance from the round wall.
  Approach approach(const double *x, const double *v, double radius, double growth, double distance) const {
    double r2 = 0.0, rv = 0.0, vv = 0.0;
    for (int c = 0; c < round_axes_; ++c) {
      const double r = x[c] - radius_;
      r2 += r * r, rv += r * v[c], vv += v[c] * v[c];
    }
    const double room = radius_ - radius;
    return {(distance - radius) * (room + std::sqrt(r2)), rv + room * growth, vv - growth * growth};
  }
  // Whether the gap above means something: a sphere wider than a round wall has none.
  template <int D>
  bool has_room(int64_t radius, const std::array<uint64_t, D> &edge) const {
    return round_axes_ == 0 || static_cast<uint64_t>(radius) < half_of(edge[0]);
  }
  // -h of a sphere whose gap is negative; edge as above.
  template <int D>
  double overlap(int w, double gap, int64_t radius, const std::array<uint64_t, D> &edge) const {
    const auto r = static_cast<double>(radius);
    if (!is_round(w)) return -gap / r;
    const double room = static_cast<double>(half_of(edge[0])) - r;
    return -gap / ((room + std::sqrt(room * room - gap)) * r);
  }
  template <int D>
  void normal(int w, const uint64_t *x, const std::array<uint64_t, D> &edge, double *n) const {
    double r[D], r2 = 0.0;
    for (int c = 0; c < D; ++c) n[c] = 0.0;
    if (!is_round(w)) {
      n[axis(w)] = side(w) ? -1.0 : 1.0;
      return;
    }
    for (int c = 0; c < round_axes_ && c < D; ++c) {
      r[c] = static_cast<double>(static_cast<int64_t>(x[c] - half_of(edge[0])));
      r2 += r[c] * r[c];
    }
    const double inverse = r2 > 0.0 ? -1.0 / std::sqrt(r2) : 0.0;
    for (int c = 0; c < round_axes_ && c < D; ++c) n[c] = r[c] * inverse;
    if (!(r2 > 0.0)) n[0] = 1.0;
  }

 private:
  static double square_root(double x) { return std::sqrt(x); }
  static DoubleDouble square_root(DoubleDouble x) { return jam::inside::square_root(x); }
  static uint64_t half_of(uint64_t edge) { return edge ? edge / 2 : uint64_t{1} << 63; }
  static unsigned __int128 square(__int128 x) {
    const auto m = static_cast<unsigned __int128>(x < 0 ? -x : x);
    return m * m;
  }

  int32_t kind_ = JAM_CONTAINER_BRICK, flat_ = 0;
  uint32_t closed_ = 0;
  int dim_ = 0, flat_walls_ = 0, round_axes_ = 0;
  std::array<int, JAM_MAX_DIM> axis_{};
  std::array<double, JAM_MAX_DIM> edge_{};
  double radius_ = 0.0, volume_ = 0.0, widest_ = std::numeric_limits<double>::infinity();
};

// V of packing fractions, pressures and densities: of the container, else of the cell.
double scene_volume(const Packing &p);
// What jam_create_options name of a container.
struct Enclosure {
  int32_t container = JAM_CONTAINER_BRICK, walls = 0;
  bool closes(int c) const {  // axis c
    return (walls >> c & 1) != 0 || container == JAM_CONTAINER_BALL || (container == JAM_CONTAINER_CYLINDER && c < 2);
  }
  bool any() const { return container != JAM_CONTAINER_BRICK || walls != 0; }
  bool operator==(const Enclosure &other) const { return container == other.container && walls == other.walls; }
};
// The cell of these vectors, (dim, dim): no vector is replaced by a shorter one, as walls lie on the axes given.
Cell walled_cell(int dim, const double *rows, const Enclosure &given);
// The jam_container of a word of files; -1: none.
int32_t container_of_word(const char *word);
// Gives the packing its container; the cell repeats no longer along walls.
void enclose(Packing &p, const Enclosure &given);
// Throws `code` where the widest sphere does not fit between walls, and JAM_E_OVERLAP where a centre lies outside.
void refuse_too_wide(const Packing &p, jam_status code);
void refuse_outside(const Packing &p);
// Smallest h of a sphere and wall w, and of all walls; +inf without walls.
struct ClosestWall {
  double gap;
  int32_t sphere;
  int w;
};
ClosestWall closest_to_wall(const Packing &p, int w);
ClosestWall closest_wall(const Packing &p);
// Rigid motions of all spheres that keep every distance: d translations of a periodic cell.
inline int symmetries(const Container &c, int dim) { return c ? c.symmetries() : dim; }
// JAM_E_UNSUPPORTED for a call that does not know walls: "a scene with walls cannot be <done> yet".
void refuse_walls(const Packing &p, const char *done);
// JAM_E_UNSUPPORTED for a call that needs so many axes without walls.
void refuse_closed(const Packing &p, int needed, const char *call);

}  // namespace jam::inside
