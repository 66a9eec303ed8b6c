// Narrow LPs, where the wide one leaves it open which contacts carry force. Doubles then cannot distinguish a weak
// force from a narrow gap: a force of 1e-7 across a gap of 1e-8 is below the tolerance of an LP, and near a saddle the
// slope of the density is smaller still. In units of a narrow bound both are plain. A simplex vertex is exact: rows in
// its basis are closed to rounding, however many close together. The next LP starts from the same basis; the bound
// follows the steps, which shrink as those of Newton's method do.
#pragma once
#include "crunch/state.hpp"

namespace jam {

Phase narrow_lps(CrunchState &s);

}  // namespace jam
