// The walls of the container as triangles, turned outwards. Planes of a round wall touch it from outside, so that no
// sphere inside passes them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/math.hpp"
#include "pore/solid_mesh.hpp"
#include "pore/sphere_hull.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {
namespace {

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

}  // namespace jam::inside
