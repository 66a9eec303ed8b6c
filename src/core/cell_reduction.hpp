// Any lattice brought to the normal form of Cell: short vectors, lower-triangular rows.
#pragma once
#include <cstdint>
#include <vector>

#include "core/packing.hpp"

namespace jam::inside {

struct ReducedCell {
  Cell cell;
  std::vector<int64_t> transform;  // (dim, dim) T: the short vectors are T times the rows given
  std::vector<double> rotation;    // (dim, dim) Q: rows given = T^-1 (cell) Q, so a point x goes to Q x
  bool rotated = false;            // false: Q is exactly 1
};

// Lovasz' reduction (Lenstra, Lenstra, Lovasz, Math. Ann. 261, 515 (1982)) and Gram-Schmidt. Rows that already are in
// normal form stay as they are, to the last bit. JAM_E_NONFINITE, JAM_E_ARGUMENT: a left-handed, singular or flat cell,
// or a size outside the limits.
ReducedCell reduce_cell(int dim, const double *rows);
// The spheres of p in that cell: positions and velocities are rotated with it, then wrapped.
void enter_cell(Packing &p, const ReducedCell &reduced);
// Mari-Kurchan shifts are fractions of the cell vectors: with other vectors the system is another one.
bool keeps_shifts(const Packing &p, const ReducedCell &reduced);
// r -> (1 + strain) r for cell vectors and positions; strain is (dim, dim). JAM_E_UNSUPPORTED where shifts are not
// kept.
void strain_affinely(Packing &p, const double *strain);

}  // namespace jam::inside
