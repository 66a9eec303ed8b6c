#include "pore/solid_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/call_scope.hpp"
#include "core/limits.hpp"
#include "pore/sphere_hull.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {
namespace {

class Mesher {
 public:
  Mesher(const Packing &p, const ContactNetwork *network, const jam_mesh_options &o)
      : p_(p), o_(o), grid_(divided_icosahedron(o.edge)), joints_(p, network, o) {}
  SolidMesh make();

 private:
  struct Corner {  // of a triangle: its place relative to the centre, or a point of a joint
    Point x;
    int32_t joint, k;  // joint < 0: none. k < 0: the middle of the joint; else a point of the ring there
    bool second;       // this sphere is the second one of the joint
  };
  struct Part {
    Triangle corner;
    bool surface;
  };
  double radius(int32_t i) const { return joints_.radius(i); }
  void build(int32_t sphere);
  void add_half(const End &e, int32_t first);
  void add_end(const End &e, int32_t sphere, std::vector<Point> &point, std::vector<int32_t> &owner);
  Point place(const Corner &c, const SphereImage &image) const;
  void emit(const SphereImage &image, SolidMesh &mesh) const;
  void put(const Point &a, const Point &b, const Point &c, SolidMesh &mesh) const;

  const Packing &p_;
  const jam_mesh_options &o_;
  SphereGrid grid_;
  Joints joints_;
  std::vector<Corner> corner_;  // of the sphere at hand
  std::vector<Part> part_;
};

// The points of the sphere at one end: of its rim, or the contact itself. `owner` says which corners a rim has.
void Mesher::add_end(const End &e, int32_t sphere, std::vector<Point> &point, std::vector<int32_t> &owner) {
  const Joint &t = joints_.of(e);
  const Point d = joints_.direction(e);
  const auto joint = static_cast<int32_t>(e.joint);
  if (t.kind == JointKind::point) {
    point.push_back(d);
    owner.push_back(-1);
    corner_.push_back({{}, joint, -1, e.second});
    return;
  }
  const double s = t.radius / radius(sphere), c = std::sqrt(1.0 - s * s);
  for (int32_t k = 0; k < t.rim; ++k) {
    const double turns = static_cast<double>(k) / t.rim, co = math::cos_of_turns(turns),
                 si = math::sin(2.0 * math::pi * turns);
    Point x;
    for (size_t q = 0; q < 3; ++q) x[q] = c * d[q] + s * (co * t.u[q] + si * t.v[q]);
    point.push_back(x);
    owner.push_back(static_cast<int32_t>(&e - joints_.ends(sphere).data()));
    for (double &y : x) y *= radius(sphere);
    if (t.kind == JointKind::circle)
      corner_.push_back({{}, joint, k, e.second});  // both spheres have it
    else
      corner_.push_back({x, -1, 0, false});
  }
}

void Mesher::build(int32_t sphere) {
  const std::vector<End> &ends = joints_.ends(sphere);
  std::vector<Point> point;
  std::vector<int32_t> owner;
  corner_.clear(), part_.clear();
  std::vector<int32_t> first;
  for (const End &e : ends) {
    first.push_back(static_cast<int32_t>(point.size()));
    add_end(e, sphere, point, owner);
  }
  for (const Point &x : grid_.point) {
    bool free = true;
    for (const End &e : ends) {
      const double angle = joints_.cap_angle(joints_.of(e), sphere) + MeshTuning::clear_of_points * o_.edge;
      free = free && dot(x, joints_.direction(e)) < math::cos(std::min(angle, math::pi));
    }
    if (!free) continue;
    point.push_back(x);
    owner.push_back(-1);
    corner_.push_back({{radius(sphere) * x[0], radius(sphere) * x[1], radius(sphere) * x[2]}, -1, 0, false});
  }
  for (const Triangle &t : ends.empty() ? grid_.triangle : sphere_hull(point)) {
    const int32_t o = owner[static_cast<size_t>(t[0])];
    const bool cap = o >= 0 && o == owner[static_cast<size_t>(t[1])] && o == owner[static_cast<size_t>(t[2])];
    if (!cap) part_.push_back({t, true});
  }
  for (size_t e = 0; e < ends.size(); ++e) add_half(ends[e], first[e]);
}

// Of a cylinder: its wall up to its middle. Then, and of a circle, the disc that both spheres share.
void Mesher::add_half(const End &e, int32_t first) {
  const Joint &t = joints_.of(e);
  if (t.kind == JointKind::point) return;
  const auto joint = static_cast<int32_t>(e.joint);
  const bool wall = t.kind == JointKind::cylinder;
  const int32_t ring = wall ? static_cast<int32_t>(corner_.size()) : first;
  for (int32_t k = 0; wall && k < t.rim; ++k) corner_.push_back({{}, joint, k, e.second});
  const auto middle = static_cast<int32_t>(corner_.size());
  corner_.push_back({{}, joint, -1, e.second});
  for (int32_t k = 0; k < t.rim; ++k) {
    int32_t a = k, b = (k + 1) % t.rim;
    if (e.second) std::swap(a, b);  // from the other side the ring runs the other way
    if (wall) {
      part_.push_back({{first + a, first + b, ring + b}, true});
      part_.push_back({{first + a, ring + b, ring + a}, true});
    }
    part_.push_back({{ring + a, ring + b, middle}, false});
  }
}

// To the bit the same for both spheres of a joint, since both begin at the image of its first one.
Point Mesher::place(const Corner &c, const SphereImage &image) const {
  Point x = image.centre;
  if (c.joint < 0) {
    for (size_t q = 0; q < 3; ++q) x[q] += c.x[q];
    return x;
  }
  const Joint &t = joints_.all()[static_cast<size_t>(c.joint)];
  std::array<int, 3> cells = image.cells;
  for (size_t q = 0; q < 3 && c.second; ++q) cells[q] += t.cells[q];
  x = image_centre(p_, t.i, cells);
  const double turns = static_cast<double>(c.k) / t.rim;
  const double co = c.k < 0 ? 0.0 : t.radius * math::cos_of_turns(turns);
  const double si = c.k < 0 ? 0.0 : t.radius * math::sin(2.0 * math::pi * turns);
  for (size_t q = 0; q < 3; ++q) x[q] += t.split * t.towards[q] + co * t.u[q] + si * t.v[q];
  return x;
}

// A triangle as the file has it. One that rounding has made an edge is left out: its neighbours then share that edge.
void Mesher::put(const Point &a, const Point &b, const Point &c, SolidMesh &mesh) const {
  std::array<float, 9> t;
  Point rounded[3];
  const Point *const corner[] = {&a, &b, &c};
  for (size_t k = 0; k < 3; ++k)
    for (size_t q = 0; q < 3; ++q) {
      t[3 * k + q] = static_cast<float>((*corner[k])[q]);
      rounded[k][q] = static_cast<double>(t[3 * k + q]);
    }
  if (rounded[0] == rounded[1] || rounded[1] == rounded[2] || rounded[2] == rounded[0]) return;
  mesh.triangle.push_back(t);
  for (Point &x : rounded)
    for (int q = 0; q < 3; ++q) x[static_cast<size_t>(q)] -= 0.5 * p_.cell.edge(q);
  mesh.volume += dot(rounded[0], cross(rounded[1], rounded[2])) / (2.0 * 3.0);
}

// The sphere at hand as cones from its centre, which its parts can be seen from, cut at the faces of the brick.
void Mesher::emit(const SphereImage &image, SolidMesh &mesh) const {
  std::vector<Point> at;
  for (const Corner &c : corner_) at.push_back(place(c, image));
  const auto beyond = [&](const Point &x, int c, bool above) {
    const double y = x[static_cast<size_t>(c)];
    return p_.cell.repeats(c) && (above ? y > p_.cell.edge(c) : y < 0.0);
  };
  std::vector<std::pair<int, bool>> planes;
  for (int c = 0; c < 3; ++c)
    for (const bool above : {false, true})
      if (std::any_of(at.begin(), at.end(), [&](const Point &x) { return beyond(x, c, above); }) ||
          beyond(image.centre, c, above))
        planes.emplace_back(c, above);
  std::vector<Face> piece;
  for (const Part &part : part_) {
    const Point &o = image.centre, &a = at[static_cast<size_t>(part.corner[0])],
                &b = at[static_cast<size_t>(part.corner[1])], &c = at[static_cast<size_t>(part.corner[2])];
    bool whole = true;
    for (const auto &[axis, above] : planes) {
      if (!beyond(o, axis, above) && !beyond(a, axis, above) && !beyond(b, axis, above) && !beyond(c, axis, above))
        continue;
      if (whole) piece = {{{a, b, c}, part.surface}, {{o, b, a}, false}, {{o, c, b}, false}, {{o, a, c}, false}};
      whole = false;
      clip(piece, axis, above ? p_.cell.edge(axis) : 0.0, above);
    }
    if (whole && part.surface) put(a, b, c, mesh);
    for (const Face &f : piece)
      for (size_t k = 2; !whole && f.surface && k < f.corner.size(); ++k)
        put(f.corner[0], f.corner[k - 1], f.corner[k], mesh);
  }
}

SolidMesh Mesher::make() {
  SolidMesh mesh;
  std::vector<double> reach;
  for (size_t i = 0; i < p_.n(); ++i) {
    double far = radius(static_cast<int32_t>(i));
    for (const End &e : joints_.ends(static_cast<int32_t>(i))) {
      const Joint &t = joints_.of(e);
      const double half = e.second ? t.length - t.split : t.split;
      far = std::max(far, std::sqrt(half * half + t.radius * t.radius));
    }
    reach.push_back(far * (1.0 + 1e-12));
  }
  mesh.solid = joints_.volume();
  for (const Joint &t : joints_.all()) mesh.bridges += t.kind == JointKind::cylinder;
  const std::vector<SphereImage> images = images_near_brick(p_, reach);
  CallScope::need_memory(
      static_cast<double>(images.size()) * static_cast<double>(grid_.triangle.size()) * sizeof(std::array<float, 9>),
      "the triangles of a mesh");
  int32_t built = -1;
  for (const SphereImage &image : images) {
    CallScope::look();
    if (image.sphere != built) build(image.sphere);
    built = image.sphere;
    emit(image, mesh);
  }
  return mesh;
}

}  // namespace

jam_mesh_options default_mesh_options() {
  jam_mesh_options o{};
  o.struct_size = sizeof o;
  o.contacts = JAM_MESH_KEPT;
  o.edge = 0.2;
  o.factor = 0.99;
  o.bridge = 0.2;
  return o;
}

void check_mesh(const Packing &p, const jam_mesh_options &o) {
  check_enum(o.contacts, JAM_MESH_KEPT, JAM_MESH_BRIDGED, "contacts", "jam_mesh_contacts");
  if (!(o.edge >= MeshTuning::shortest_edge && o.edge <= 1.0))
    fail(JAM_E_ARGUMENT, "edge is %g, it must be in 0.03..1", o.edge);
  if (!(o.factor > 0.0 && o.factor < 1.0)) fail(JAM_E_ARGUMENT, "factor is %g, it must lie between 0 and 1", o.factor);
  if (!(o.bridge >= MeshTuning::thinnest_bridge && o.bridge <= MeshTuning::widest_bridge))
    fail(JAM_E_ARGUMENT, "bridge is %g, it must be in 0.02..0.45", o.bridge);
  if (!(o.bridge_gap >= 0.0 && o.bridge_gap <= 1.0))
    fail(JAM_E_ARGUMENT, "bridge_gap is %g, it must be in 0..1", o.bridge_gap);
  check_enum(o.walls, JAM_MESH_SPHERES, JAM_MESH_WALLS, "walls", "jam_mesh_walls");
  check_has_pores(p);
  if (p.dim != 3) fail(JAM_E_UNSUPPORTED, "a mesh of triangles needs d = 3, this packing has d = %d", p.dim);
  const double smallest = *std::min_element(p.diameter.begin(), p.diameter.end());
  const double side = 0.5 * o.edge * smallest * (o.contacts == JAM_MESH_SHRUNK ? o.factor : 1.0);
  const double step = 0x1p-24 * std::max({p.cell.edge(0), p.cell.edge(1), p.cell.edge(2)});
  if (side < MeshTuning::least_steps * step)
    fail(JAM_E_ARGUMENT, "triangles of %g would be lost in the floats of an STL file, whose step is up to %g here",
         side, step);
}

SolidMesh solid_mesh(const Packing &p, const ContactNetwork *network, const jam_mesh_options &o) {
  check_mesh(p, o);
  SolidMesh mesh;
  if (o.walls != JAM_MESH_WALLS) mesh = Mesher(p, network, o).make();
  if (o.walls != JAM_MESH_SPHERES) add_walls(p, o, mesh);
  return mesh;
}

}  // namespace jam::inside
