// A packing in another cell: given, strained or deformed; and what the notes say of its vectors.
#pragma once
#include <optional>

#include "core/cell_reduction.hpp"
#include "core/notes.hpp"
#include "core/pairs.hpp"

namespace jam::inside {

// The spheres of p in that cell: positions and velocities are rotated with it, then wrapped.
void enter_cell(Packing &p, const NormalCell &normal);
// Notes, once, what became of vectors that were not kept. `spheres`: they were there before, and went with the cell.
void note_cell(const NormalCell &normal, bool spheres, Notes &notes);
// The vectors of a cell that deforms, where they have become extreme: upright ones, or else those of reduce_cell,
// before they exceed what readers keep. The cell that p has entered, if any; Mari-Kurchan systems keep theirs.
std::optional<NormalCell> shorten_cell(Packing &p, Notes &notes);
// Upright vectors for extreme ones. The spheres, and lattice vectors between them, stay.
void straighten_cell(Packing &p, Notes &notes);
// r -> (1 + strain) r for cell vectors and positions; strain is (dim, dim). Returns the cell that p has entered.
// JAM_E_UNSUPPORTED where shifts are not kept.
NormalCell strain_affinely(Packing &p, const double *strain);

// The one way in which a crunch moves a packing: displacements, growth of all diameters, and a strain of the cell.

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
