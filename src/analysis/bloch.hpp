// Modes and flexes at a wave vector. A field on all copies of the cell, u_j exp(2 pi i q . s) on sphere j of the copy
// at sum s_c a_c, has in one cell the row n . (u_i - u_j exp(-2 pi i q . s)) for a contact whose partner stands s cells
// back. So the rigidity matrix and the Hessian of m copies fall into m complex ones of one cell (Bloch's theorem).
//
// A complex Hermitian matrix A + i B is computed as the symmetric ((A, -B), (B, A)), which has every eigenvalue twice.
#pragma once
#include "analysis/modes.hpp"
#include "network/tile.hpp"
#include "verdict/verdict.hpp"

namespace jam::inside {

// For each contact the cells s from its partner back to it.
using CellsBack = std::vector<std::array<int32_t, JAM_MAX_DIM>>;
CellsBack cells_back(const Packing &p, const ContactNetwork &net);

// JAM_E_UNSUPPORTED where a sphere touches its own image and `net` does not list it, unless both move alike at q.
void refuse_own_images_at(const Packing &p, const ContactNetwork &net, const double *q);
struct WavePhase {
  double cosine, sine;
};
// exp(-2 pi i q . s); whole turns are taken off first, so that it is exact where it is real.
WavePhase phase_of(const double *q, const std::array<int32_t, JAM_MAX_DIM> &s, int dim);
// Whether all phases are: then the matrix is.
bool is_real(const CellsBack &back, const double *q, int dim);
// JAM_E_MEMORY before any work.
void need_memory_for_bloch(const RigidityMatrix &g, const CellsBack &back, const double *q);
// Modes of the Hessian at the wave vector q (dim): lambda ascending; vector (d N', nodes, dim, 2), of unit length, left
// out unless requested.
Modes bloch_modes(const RigidityMatrix &g, const ContactWeights &w, const CellsBack &back, const double *q,
                  bool vectors);

// The collective test of copies of a packing.
struct BlochFlexes {
  std::vector<double> wave;     // (copies, dim)
  std::vector<int64_t> flexes;  // beyond translations
  std::vector<double> margin;   // least eigenvalue of S^T S that is no translation or flex; NaN without K+
  int64_t total = 0;            // of the flexes
  Verdict jammed = Verdict::undecided;
};
// verdict: that of the collective test of p. By the average over all copies of any balanced forces, contacts carry
// force in the copies where they do in one cell. Own images, which a fixed cell ignores, are contacts of two copies.
BlochFlexes bloch_flexes(const Packing &p, const PackingVerdict &verdict, const Copies &copies);

}  // namespace jam::inside
