// The one way in which a crunch moves a packing: displacements, growth of all diameters, and a strain of the cell.
#pragma once
#include <vector>

#include "core/packing.hpp"
#include "core/pairs.hpp"

namespace jam::inside {

// The cell that a strain leaves, of lower-triangular rows. Entries below this, over V^(1/d), are rounding of zeros and
// become 0: they move nothing, and their squares would leave the range of doubles in proofs.
constexpr double least_cell_entry = 1e-60;
// Walls keep their places; their areas follow the cell.
void take_strained_cell(Packing &p, std::vector<double> rows);

// Deforms positions, cell and offsets by 1 + E, E upper-triangular (dim, dim), divided by det^(1/m) along the m axes
// that no wall closes: the volume stays, or becomes `kept` again where rounding changed it. E has no component off
// these axes. det <= 1 for a traceless E, so this opens gaps.
void strain_at_fixed_volume(Packing &p, PairList &pairs, const std::vector<double> &strain, double kept = 0.0);

// Strains the cell (strain empty: it is fixed), moves the spheres by `length` s, s (n, dim), multiplies all diameters
// by `growth` and wraps. The offsets of the pairs follow.
void move_packing(Packing &p, PairList &pairs, const double *s, double length, double growth,
                  const std::vector<double> &strain = {});

}  // namespace jam::inside
