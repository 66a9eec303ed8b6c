// The surface of the solid in the brick, as triangles: closed, each edge twice, once each way.
#pragma once
#include <array>
#include <deque>
#include <vector>

#include "core/packing.hpp"
#include "jam/jam.h"
#include "network/contact_network.hpp"

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
// (mesh_estimate.cpp).
int64_t estimated_triangles(const Packing &p, const ContactNetwork *network, const jam_mesh_options &o);

}  // namespace jam::inside
