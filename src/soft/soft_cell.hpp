// A cell that minimisers of soft spheres may deform. Sphere vectors become r = (1 + E) r0 + du, with E upper-triangular
// and few amplitudes, so that r is linear in the displacements, and at fixed pressure in the amplitudes too.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/cell.hpp"
#include "jam/jam.h"

namespace jam::inside {

// What may change. With a pressure P the enthalpy U + P V is minimised; without, U at fixed volume. A target tensor D
// beyond P adds V0 D_ab E_ab, E from the cell of volume V0 where the pairs were last listed. Such work of fixed loads
// has a potential, which that of a given Cauchy stress has not. Where E = 0 both agree: there the stress is P + D.
struct FreeCell {
  int dim = 0;
  uint32_t axes = 0;  // that may strain (bits): those without walls
  bool volume = false;
  double pressure = 0.0;
  std::vector<double> beyond;    // D, (dim, dim), 0 for components that are not free; empty: none
  std::vector<double> matrices;  // (count, dim, dim): strain of amplitude 1
  int count() const { return dim ? static_cast<int>(matrices.size()) / (dim * dim) : 0; }
  bool open(int c) const { return (axes >> c & 1) != 0; }
  int open_axes() const;
  double open_part(const double *n) const;  // of n^2 = 1, that along these axes; 1 where all are open
};

// strain: bits of jam_free_strain; components: bit c dim + k allows component (c, k), c <= k, of two axes without
// walls.
FreeCell free_cell_of(int dim, int32_t strain, int64_t components, double pressure, uint32_t axes = ~0u);

// The free components are to hold this stress (dim, dim): sets pressure and beyond. JAM_E_ARGUMENT where repulsion
// cannot.
void hold_stress(FreeCell &cell, int32_t strain, const double *stress);

// E with (1 + E) from = to, vector by vector, (dim, dim).
std::vector<double> strain_between(const Cell &from, const Cell &to);

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
