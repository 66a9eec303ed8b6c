// How many triangles a mesh will have, from the mean numbers of triangles that faces of the brick and cylinders add.
#include <algorithm>
#include <cmath>

#include "core/math.hpp"
#include "pore/images.hpp"
#include "pore/joints.hpp"
#include "pore/solid_mesh.hpp"
#include "pore/sphere_hull.hpp"
#include "pore/tuning.hpp"

namespace jam::inside {
namespace {

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

}  // namespace

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
