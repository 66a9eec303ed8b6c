// Spheres and their images in the brick of the cell, which repeats as the cell does: the part of all images inside the
// brick is the solid of one cell.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/packing.hpp"

namespace jam::inside {

// A sphere and the lattice vector that takes it there, in whole cell vectors.
struct SphereImage {
  int32_t sphere;
  std::array<int, 3> cells;
  std::array<double, 3> centre;  // by image_centre, which gives the same bits for the same image
};
std::array<double, 3> image_centre(const Packing &p, int32_t sphere, const std::array<int, 3> &cells);

// All images within reach[i] of the brick, sorted by sphere; d = 2, 3.
std::vector<SphereImage> images_near_brick(const Packing &p, const std::vector<double> &reach);

// JAM_E_UNSUPPORTED in other dimensions, and for Mari-Kurchan spheres, which have no places beside each other.
void check_has_pores(const Packing &p);

// The whole vectors of a lattice vector.
std::array<int, 3> cells_of(const Cell &cell, const double *offset);

}  // namespace jam::inside
