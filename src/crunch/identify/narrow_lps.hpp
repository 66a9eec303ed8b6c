// Narrow LPs, where the wide one leaves it open which contacts carry force. Doubles then cannot distinguish a weak
// force from a narrow gap: a force of 1e-7 across a gap of 1e-8 is below the tolerance of an LP, and near a saddle the
// slope of the density is smaller still. In units of a narrow bound both are plain: the duality gap of a narrow LP is
// as much smaller as its bound. The bound follows the steps, which shrink as those of Newton's method do, down to the
// motion whose square is rounding. What an interior point leaves open Clp's simplex method solves once more: rows in
// the basis of a vertex are closed to rounding, however many close together. It is slower, for layers by a factor
// of 50. No diagonal holds the spheres: a sphere between nearly opposite contacts, as in layers at a wall, finds its
// third one by a force that such a diagonal would take.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

Phase narrow_lps(CrunchState &s);
// Some solver has not tried them since the last wide LP.
bool narrow_lps_left(const CrunchState &s);

}  // namespace jam::inside
