// Files of the pore space: a mesh of the solid (STL), and an image of it (NumPy, MetaImage, VTK).
#pragma once
#include <functional>

#include "pore/profile.hpp"
#include "pore/solid_mesh.hpp"

namespace jam::inside {

// Binary STL. Returns its bytes.
int64_t stl_bytes(int64_t triangles);
int64_t write_stl(const SolidMesh &mesh, const char *path);

int64_t bytes_of_image(const VoxelGrid &grid, int lines);  // without headers
// The ending sets the format: .npy, .mha, .vti, others are JAM_E_UNSUPPORTED. Values: a byte each, 0 void, 1 solid, 2
// outside the container; with lines > 0 a float each, the share or -1. Calls f with each layer.
void write_image(const VoxelImage &image, const VoxelGrid &grid, int dim, int lines, const char *path,
                 const std::function<void(const double *layer)> &f);

}  // namespace jam::inside
