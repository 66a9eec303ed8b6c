// A cell that minimisers of soft spheres may deform. Sphere vectors become r = (1 + E) r0 + du, with E upper-triangular
// and few amplitudes, so that r is linear in the displacements, and at fixed pressure in the amplitudes too.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "jam/jam.h"

namespace jam::inside {

// What may change. With a pressure P the enthalpy U + P V is minimised; without, U at fixed volume.
struct FreeCell {
  int dim = 0;
  bool volume = false;
  double pressure = 0.0;
  std::vector<double> matrices;  // (count, dim, dim): strain of amplitude 1
  int count() const { return dim ? static_cast<int>(matrices.size()) / (dim * dim) : 0; }
};

// strain: bits of jam_free_strain; components: bit c dim + k allows component (c, k), c <= k.
FreeCell free_cell_of(int dim, int32_t strain, int64_t components, double pressure);

struct CellStrain {
  std::vector<double> e;      // E, (dim, dim)
  std::vector<double> slope;  // dE / d amplitude, (count, dim, dim)
  double log_volume = 0.0;    // ln det(1 + E)
};

// E = lambda (1 + sum_k a_k M_k) - 1, where lambda = 1 with a free volume, else that which keeps the volume.
CellStrain strain_of(const FreeCell &cell, const double *amplitude);
// Second derivatives of V(E) at fixed pressure, and of U through lambda at fixed volume, at E = 0: both are
// (tr M_k tr M_l - sum_c M_kcc M_lcc) pressure V. (count, count)
std::vector<double> volume_curvature(const FreeCell &cell);

}  // namespace jam::inside
