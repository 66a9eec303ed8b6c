// The largest Gamma near a packing, to two doubles, by linear programs in doubles.
#pragma once
#include "proof/scene.hpp"

namespace jam::inside {

// Each LP of displacements counts gaps in units of its step, and the next step is shorter by what LPs leave (A. M.
// Gleixner, D. E. Steffy, K. Wolter, INFORMS J. Comput. 28, 449 (2016)). Linear gaps are never wider than true ones, so
// that no step makes an overlap. At the end contacts are all pairs that are closed, with the multipliers of the last LP
// as forces, some of them 0. Directions in which multipliers are below the tolerance of an LP (1e-9 of the mean) stay
// open: the contacts then leave a flex. The scene is as it was without Clp, above proof_tuning::largest_lp rows, and
// where steps come to no end.
enum class LpsEnd { closed, without_clp, too_many_rows, no_end };
LpsEnd close_by_lps(ProofScene &scene);

}  // namespace jam::inside
