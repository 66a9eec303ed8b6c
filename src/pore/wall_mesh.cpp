// The walls of the container as triangles, turned outwards. Planes of a round wall touch it from outside, so that no
// sphere inside passes them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "pore/solid_mesh.hpp"
#include "pore/sphere_hull.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {
namespace {

// How many triangles a mesh will have, from the mean numbers of triangles that faces of the brick and cylinders add.

// Triangles of an image whose centre is in the brick: of the sphere, and of its discs in the faces that cut it. A
// sphere is cut as cones from its centre: each cone beyond a face leaves a triangle in it, each that the face passes
// through 2. Of an image beyond a face at h radii, 1 - h of the cones are within or leave a triangle.
double of_image(const Packing &p, const SphereImage &image, double radius, double whole) {
  double share = 1.0, passing = 0.0;
  for (int c = 0; c < 3; ++c) {
    if (!p.cell.repeats(c)) continue;
    for (const double face : {0.0, p.cell.edge(c)}) {
      const double x = image.centre[static_cast<size_t>(c)] - face, h = std::fabs(x) / radius;
      if (h >= 1.0) continue;
      passing += 2.0 * MeshTuning::passed * std::sqrt(whole * (1.0 - h * h));
      if (face > 0.0 ? x > 0.0 : x < 0.0) share *= 1.0 - h;
    }
  }
  return share * (whole + passing);
}

// At an end of a cylinder: two triangles a rim point up to the middle, and at each rim two in the sphere, less those of
// the disc inside and of the grid's points that give way, of which each has sqrt(3) / 2 edge^2.
double of_end(const Joint &t, double cap, double edge) {
  if (t.kind == JointKind::point) return 0.0;
  const double gone = cap + MeshTuning::clear_of_points * edge;
  const double rim = t.rim, lost = 4.0 * math::pi * (1.0 - math::cos(std::min(gone, math::pi)));
  const double in_sphere = rim + 2.0 - lost / (0.5 * std::sqrt(3.0) * edge * edge);
  return in_sphere + (t.kind == JointKind::cylinder ? 2.0 * rim : 0.0);
}

class WallMesher {
 public:
  WallMesher(const Packing &p, const jam_mesh_options &o, SolidMesh &mesh)
      : p_(p), radius_(0.5 * p.cell.edge(0)), side_(0.5 * o.edge * diameter_max(p)), mesh_(mesh) {}
  void make() {
    const int round = p_.container.round_axes();
    if (round == 3) return ball();
    for (int c = 0; c < 3; ++c)
      if (p_.container.flat() >> c & 1) round == 2 ? ends() : faces(c);
    if (round == 2) mantle();
  }

 private:
  void put(const Point &a, const Point &b, const Point &c) {
    std::array<float, 9> t;
    const Point *const corner[] = {&a, &b, &c};
    for (size_t k = 0; k < 9; ++k) t[k] = static_cast<float>((*corner[k / 3])[k % 3]);
    mesh_.triangle.push_back(t);
  }
  // Two rectangles across axis c, each from the corner that all others are counted from.
  void faces(int axis) {
    const auto c = static_cast<size_t>(axis), u = (c + 1) % 3, v = (c + 2) % 3;
    for (const bool high : {false, true}) {
      Point x[4]{};
      for (size_t k = 0; k < 4; ++k) {
        x[k][c] = high ? p_.cell.edge(axis) : 0.0;
        x[k][u] = k == 1 || k == 2 ? p_.cell.edge(static_cast<int>(u)) : 0.0;
        x[k][v] = k >= 2 ? p_.cell.edge(static_cast<int>(v)) : 0.0;
      }
      if (!high) std::swap(x[1], x[3]);
      put(x[0], x[1], x[2]), put(x[0], x[2], x[3]);
    }
  }
  int corners() const {
    const double wanted = std::ceil(2.0 * math::pi * radius_ / side_);
    return static_cast<int>(std::min(MeshTuning::most_corners, std::max(MeshTuning::fewest_corners, wanted)));
  }
  Point rim(int k, double z) const {
    const int all = corners();
    const double turns = static_cast<double>(k % all) / all, far = radius_ / math::cos(math::pi / all);
    return {radius_ + far * math::cos_of_turns(turns), radius_ + far * math::sin(2.0 * math::pi * turns), z};
  }
  void mantle() {
    const double top = p_.cell.edge(2);
    for (int k = 0; k < corners(); ++k) {
      put(rim(k, 0.0), rim(k + 1, 0.0), rim(k + 1, top));
      put(rim(k, 0.0), rim(k + 1, top), rim(k, top));
    }
  }
  void ends() {
    const double top = p_.cell.edge(2);
    for (int k = 0; k < corners(); ++k) {
      put({radius_, radius_, 0.0}, rim(k + 1, 0.0), rim(k, 0.0));
      put({radius_, radius_, top}, rim(k, top), rim(k + 1, top));
    }
  }
  void ball() {
    const SphereGrid grid = divided_icosahedron(std::min(1.0, std::max(MeshTuning::shortest_edge, side_ / radius_)));
    const auto at = [&](int32_t k) { return grid.point[static_cast<size_t>(k)]; };
    double nearest = 1.0;  // of the planes
    for (const Triangle &t : grid.triangle) {
      const Point n = cross(minus(at(t[1]), at(t[0])), minus(at(t[2]), at(t[0])));
      nearest = std::min(nearest, dot(n, at(t[0])) / std::sqrt(dot(n, n)));
    }
    const auto place = [&](int32_t k) {
      Point x = at(k);
      for (double &y : x) y = radius_ * (1.0 + y / nearest);
      return x;
    };
    for (const Triangle &t : grid.triangle) put(place(t[0]), place(t[1]), place(t[2]));
  }

  const Packing &p_;
  double radius_, side_;
  SolidMesh &mesh_;
};

}  // namespace

void add_walls(const Packing &p, const jam_mesh_options &o, SolidMesh &mesh) {
  if (!p.container) fail(JAM_E_ARGUMENT, "this packing has no walls that a mesh could show");
  const size_t first = mesh.triangle.size();
  WallMesher(p, o, mesh).make();
  if (o.walls != JAM_MESH_WALLS) return;
  mesh.volume = mesh.solid = std::numeric_limits<double>::quiet_NaN();
  if (p.container.open_axes() > 0) return;  // they enclose nothing
  mesh.volume = 0.0, mesh.solid = p.container.volume();
  for (size_t k = first; k < mesh.triangle.size(); ++k) {
    Point x[3];
    for (size_t q = 0; q < 9; ++q)
      x[q / 3][q % 3] = static_cast<double>(mesh.triangle[k][q]) - 0.5 * p.cell.edge(static_cast<int>(q % 3));
    mesh.volume += dot(x[0], cross(x[1], x[2])) / (2.0 * 3.0);
  }
}

int32_t points_of_rim(const jam_mesh_options &o) {
  return std::max(8, static_cast<int32_t>(std::ceil(2.0 * math::pi * o.bridge / o.edge)));
}

int64_t estimated_triangles(const Packing &p, const ContactNetwork *network, const jam_mesh_options &o) {
  check_mesh(p, o);
  const double whole = static_cast<double>(divided_icosahedron(o.edge).triangle.size());
  const double factor = o.contacts == JAM_MESH_SHRUNK ? o.factor : 1.0;
  std::vector<double> radius;
  for (const double s : p.diameter) radius.push_back(0.5 * factor * s);
  double sum = 0.0;
  if (o.walls != JAM_MESH_SPHERES) {
    SolidMesh walls;
    add_walls(p, o, walls);
    sum += static_cast<double>(walls.triangle.size());
  }
  if (o.walls == JAM_MESH_WALLS) return std::llround(sum);
  for (const SphereImage &image : images_near_brick(p, radius))
    sum += of_image(p, image, radius[static_cast<size_t>(image.sphere)], whole);
  const Joints joints(p, network, o);
  for (const Joint &t : joints.all())
    for (const int32_t s : {t.i, t.j}) sum += of_end(t, joints.cap_angle(t, s), o.edge);
  return std::llround(sum);
}

}  // namespace jam::inside
