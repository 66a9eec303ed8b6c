// A free cell: path and LPs with strain amplitudes start from the optimum at fixed cell. They end in a
// strictly jammed packing, with d (N' - 1) + d (d + 1) / 2 contacts when it is disordered (Torquato and Jiao, Phys.
// Rev. E 82, 061302 (2010)).
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

// Whether the cell is to be freed, after the packing has reached its optimum at fixed cell.
bool frees_cell(const CrunchState &s);
// The strains join the LPs.
Phase free_cell(CrunchState &s);

}  // namespace jam::inside
