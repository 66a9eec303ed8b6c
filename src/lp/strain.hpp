// Strains of a free cell that a linear program may choose: r -> (1 + E) r with E upper-triangular, so that the cell
// stays lower-triangular, and traceless, because growth of all diameters already is a change of volume. Axes that walls
// close keep their length and their direction.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace jam::inside {

struct StrainBasis {
  int dim = 0;
  std::vector<double> matrices;  // (count, dim, dim)
  int count() const { return dim ? static_cast<int>(matrices.size()) / (dim * dim) : 0; }
};

// Which components of the cell may change along these axes (bits): the edges a_cc, the tilts a_ck, or both.
StrainBasis strain_basis(int dim, bool edges, bool tilts, uint32_t axes = ~0u);
// An option of a call at fixed volume: JAM_STRAIN_NONE .. JAM_STRAIN_FREE.
void check_strain(int32_t strain, const char *call);
// Largest part of a strain (dim, dim) that leaves half of each edge. In a thin cell that is far from jammed the bound
// of an LP lets several amplitudes shorten one edge, by more than there is of it.
double strain_part(int dim, const std::vector<double> &strain);
// E = sum_k amplitude_k B_k, (dim, dim).
std::vector<double> strain_matrix(const StrainBasis &basis, const std::vector<double> &amplitude, double scale);
// r . (B_k r) of every pair, times scale_e: (pairs, count).
std::vector<double> strain_rows(const StrainBasis &basis, const std::vector<double> &vectors,
                                const std::vector<double> &scale);

}  // namespace jam::inside
