// The container: which walls enclose the spheres. Each wall is a Surface (core/surface.hpp), which this file joins to a
// closed or open room: its volume, its symmetries, and where a sphere fits. Shapes are the rows of a table in the .cpp;
// a shape of new surfaces needs its row, and code in core/surface.hpp.
//
// The container lies in the brick of its cell and touches its faces. Along `closed` axes nothing repeats (Cell::close).
// Molecular dynamics is periodic nevertheless: images of a container do not overlap each other, so that spheres
// inside it never meet across a wall before they meet the wall. That holds for additive contact distances, and for
// smaller ones.
//
// Walls are numbered w = 0, 1, ...: the flat ones axis by axis, the one at 0 first; then the curved one. A table that
// names the partner of a contact by j has j = -1 - w for a wall. A wall is a contact with the mirror image of the
// sphere: h = distance / radius - 1.
#pragma once
#include <limits>

#include "core/cell.hpp"
#include "core/rng.hpp"
#include "core/surface.hpp"

namespace jam::inside {

struct Packing;

inline int32_t wall_partner(int w) { return -1 - w; }  // its own inverse

class Container {
 public:
  Container() = default;  // none
  // JAM_E_ARGUMENT, JAM_E_UNSUPPORTED where the cell has no such container.
  Container(int32_t kind, int32_t walls, const Cell &cell);

  explicit operator bool() const { return !walls_.empty(); }
  int32_t kind() const { return kind_; }       // jam_container
  int32_t flat() const { return flat_; }       // axes with flat walls: bits, as jam_create_options have them
  uint32_t closed() const { return closed_; }  // axes along which nothing repeats
  int count() const { return static_cast<int>(walls_.size()); }
  auto begin() const { return walls_.begin(); }
  auto end() const { return walls_.end(); }
  const Surface &operator[](int w) const { return walls_[static_cast<size_t>(w)]; }
  // Axes along which a wall is curved: such a wall may hold spheres with fewer contacts than a plane.
  uint32_t curved() const { return walls_.empty() ? 0u : walls_.back().turning().axes; }
  double volume() const { return volume_; }
  const char *word() const;  // of files: "brick", "cylinder", "ball"
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
  // Whether a sphere at x lies inside all walls.
  bool holds(const double *x, double radius) const {
    for (const Surface &wall : walls_)
      if (wall.distance(x) < radius) return false;
    return true;
  }
  // A uniform point of the brick where a sphere of this radius may fit between flat walls.
  void random_point(const Cell &cell, Rng &rng, double radius, double *x) const;
  // For formulae of the room between planes, and within a cylinder or a circle (2) or a ball (3): refuses others.
  int round_axes() const { return know("this call"), round_axes_; }
  // JAM_E_UNSUPPORTED for a call that has formulae for these shapes alone.
  void know(const char *call) const;
  // What a page draws: circles of the curved wall, of this radius about a point, in the plane of two axes.
  struct Ring {
    std::array<int, 2> axes;
    std::array<double, 3> centre;
    double radius;
  };
  std::vector<Ring> rings() const;

 private:
  int32_t kind_ = JAM_CONTAINER_BRICK, flat_ = 0;
  uint32_t closed_ = 0;
  int dim_ = 0, round_axes_ = 0;
  std::array<double, JAM_MAX_DIM> edge_{};
  double volume_ = 0.0, widest_ = std::numeric_limits<double>::infinity();
  std::vector<Surface> walls_;
};

// V of packing fractions, pressures and densities: of the container, else of the cell.
double scene_volume(const Packing &p);
// What jam_create_options name of a container.
struct Enclosure {
  int32_t container = JAM_CONTAINER_BRICK, walls = 0;
  bool closes(int c) const;  // axis c
  int count(int dim) const;  // of walls
  bool needs_space() const;  // whether it has three dimensions at least
  bool any() const { return container != JAM_CONTAINER_BRICK || walls != 0; }
  bool operator==(const Enclosure &other) const { return container == other.container && walls == other.walls; }
};
// The cell of these vectors, (dim, dim): no vector is replaced by a shorter one, as walls lie on the axes given.
Cell walled_cell(int dim, const double *rows, const Enclosure &given);
// The jam_container of a word of files; -1: none.
int32_t container_of_word(const char *word);
std::string container_words();  // "brick, cylinder and ball"
// Gives the packing its container; the cell repeats no longer along walls.
void enclose(Packing &p, const Enclosure &given);
// Throws `code` where the widest sphere does not fit between walls, and JAM_E_OVERLAP where a centre lies outside.
void refuse_too_wide(const Packing &p, jam_status code);
// why: what follows the name of the wall.
constexpr char wrong_origin[] =
    "positions count from the corner of the cell; if yours count from its centre, add half of each edge";
constexpr char pushed_out[] =
    "the overlaps pushed it out, and the packing is as before; give a lower density or pressure";
void refuse_outside(const Packing &p, const char *why);
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
