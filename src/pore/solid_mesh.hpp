// The surface of the solid in the brick, as triangles: closed, each edge twice, once each way.
#pragma once
#include <deque>

#include "network/contact_network.hpp"
#include "pore/balls.hpp"

namespace jam::inside {

struct SolidMesh {
  std::deque<std::array<float, 9>> triangle;  // three corners; there may be 1e8 of them, which a vector would copy
  int64_t bridges = 0;
  double volume = 0.0;  // that the triangles enclose
  double solid = 0.0;   // of the spheres and cylinders that they represent
};

jam_mesh_options default_mesh_options();
// network: NULL where there is none; BRIDGED needs it, unless bridge_gap is given. JAM_E_ARGUMENT also where bridges
// would meet each other or another sphere, JAM_E_UNSUPPORTED where spheres overlap so that the mesh would cut itself,
// and in other dimensions than 3.
SolidMesh solid_mesh(const Packing &p, const ContactNetwork *network, const jam_mesh_options &o);
// Adds the walls (wall_mesh.cpp). Of the walls alone the volumes are those of the container, NaN where it is open.
void add_walls(const Packing &p, const jam_mesh_options &o, SolidMesh &mesh);
// Points round a cylinder.
int32_t points_of_rim(const jam_mesh_options &o);
// What solid_mesh refuses before any work.
void check_mesh(const Packing &p, const jam_mesh_options &o);
// About how many triangles it has, to some 10 % (30 % where spheres overlap in wide circles), before any work
// (wall_mesh.cpp).
int64_t estimated_triangles(const Packing &p, const ContactNetwork *network, const jam_mesh_options &o);

// What joins two spheres of a mesh: a common point, the circle where they overlap, or a cylinder.

enum class JointKind { point, circle, cylinder };

// A joint as its first sphere describes it. Both spheres take from here what they share, to the bit.
struct Joint {
  JointKind kind;
  int32_t i, j;
  std::array<int, 3> cells;  // the image of i that touches j
  Point towards;             // unit vector from i to j
  double length, split;      // distance of the centres; of i and the middle of the joint
  double radius;             // of the circle or the cylinder; 0 of a point
  int32_t rim;               // points around it
  Point u, v;                // across
  bool overlaps;             // the spheres share volume
};

struct End {  // of a joint at one sphere
  size_t joint;
  bool second;
};

class Joints {
 public:
  // network: NULL where there is none. JAM_E_ARGUMENT where two joints, or a cylinder and a sphere, would meet;
  // JAM_E_UNSUPPORTED for a sphere in another.
  Joints(const Packing &p, const ContactNetwork *network, const jam_mesh_options &o);
  const std::vector<Joint> &all() const { return joint_; }
  const std::vector<End> &ends(int32_t sphere) const { return ends_[static_cast<size_t>(sphere)]; }
  const Joint &of(const End &e) const { return joint_[e.joint]; }
  double radius(int32_t i) const { return 0.5 * factor_ * p_.diameter[static_cast<size_t>(i)]; }
  // Angle at the centre of a sphere between the axis of a joint and its rim.
  double cap_angle(const Joint &t, int32_t sphere) const;
  Point direction(const End &e) const;
  // What the spheres and cylinders fill, volume that they share counted once.
  double volume() const;

 private:
  void take_overlaps();
  void take_pairs(const PairList &pairs, const ContactNetwork *network);
  void add(const Packing &p, const PairList &pairs, size_t k, bool overlaps);
  void check_ends() const;
  void check_cylinders() const;
  void refuse_third_sphere(const Joint &t, const Point &x, double r, int32_t sphere) const;
  const Packing &p_;
  const jam_mesh_options &o_;
  double factor_;
  std::vector<Joint> joint_;
  std::vector<std::vector<End>> ends_;
};

}  // namespace jam::inside
