// A packing in another cell: given, strained or deformed; and what the notes say of its vectors.
#pragma once
#include "core/cell_reduction.hpp"
#include "core/notes.hpp"

namespace jam::inside {

// The spheres of p in that cell: positions and velocities are rotated with it, then wrapped.
void enter_cell(Packing &p, const NormalCell &normal);
// Notes, once, what became of vectors that were not kept. `spheres`: they were there before, and went with the cell.
void note_cell(const NormalCell &normal, bool spheres, Notes &notes);
// The vectors of a cell that deforms, where they have become extreme: upright ones, or else those of reduce_cell,
// before they exceed what readers keep. True if p has other vectors now; Mari-Kurchan systems keep theirs.
bool shorten_cell(Packing &p, Notes &notes);
// Upright vectors for extreme ones. The spheres, and lattice vectors between them, stay.
void straighten_cell(Packing &p, Notes &notes);
// r -> (1 + strain) r for cell vectors and positions; strain is (dim, dim). Returns the cell that p has entered.
// JAM_E_UNSUPPORTED where shifts are not kept.
NormalCell strain_affinely(Packing &p, const double *strain);

}  // namespace jam::inside
