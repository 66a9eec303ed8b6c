// What joins two spheres of a mesh: a common point, the circle where they overlap, or a cylinder.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "jam/jam.h"
#include "network/contact_network.hpp"
#include "pore/balls.hpp"

namespace jam::inside {

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
