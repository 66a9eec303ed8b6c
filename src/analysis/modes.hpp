// Vibrational modes: dense, by LAPACK where the build has it, or few by Lanczos.
#pragma once
#include <functional>

#include "analysis/tuning.hpp"
#include "core/monitor.hpp"
#include "network/self_stress.hpp"
#include "network/tile.hpp"
#include "verdict/verdict.hpp"

namespace jam::inside {

struct Modes {
  std::vector<double> lambda;         // ascending
  std::vector<double> vector;         // (modes, nodes, dim), unit length
  std::vector<double> participation;  // inverse participation ratio Y, 1/N' .. 1
};

jam_modes_options default_modes_options();
// JAM_E_ARGUMENT, JAM_E_MEMORY (with the estimate) before any work.
void check_modes_options(const jam_modes_options &o, const RigidityMatrix &g);
// Returns JAM_OK, JAM_CANCELLED (nothing given) or JAM_NOT_CONVERGED (the modes that converged).
jam_status find_modes(const RigidityMatrix &g, const ContactWeights &w, const jam_modes_options &o, Monitor &monitor,
                      Modes &out);

// Zeros for LAPACK, with room behind them that is allocated but not used.
inline std::vector<double> lapack_array(size_t count) {
  std::vector<double> out;
  out.reserve(count + DenseTuning::read_behind);
  out.resize(count);
  return out;
}
// All eigenvalues and vectors of a dense symmetric matrix, whose lower triangle a (a lapack_array) gives column-major;
// the vectors overwrite it. `stop` is asked between stages. False when stopped. By LAPACK where the build has it
// (JAM_LAPACK) and an int can count its workspace: its bits depend on the processor.
bool dense_eigen(int n, std::vector<double> &a, std::vector<double> &lambda, const std::function<bool(double)> &stop);
// The same by own loops, or the eigenvalues alone: for those that decide something. With vectors it takes longer than
// LAPACK.
bool dense_eigen_builtin(int n, std::vector<double> &a, std::vector<double> &lambda, bool vectors,
                         const std::function<bool(double)> &stop);
// dense_builtin.cpp: eigenvalues and vectors of the whole Hessian; JAM_CANCELLED when stopped.
jam_status all_modes(const BlockMatrix &h, Monitor &monitor, Modes &out);
// Reduces them to the modes requested. The d translations are removed first.
void select_modes(const RigidityMatrix &g, const jam_modes_options &o, Modes &all);
// Y = sum |v_i|^4 / (sum |v_i|^2)^2 of a field (nodes, dim).
double inverse_participation(int dim, int32_t nodes, const double *v);

// Density of states and elastic moduli from a Hessian without its modes.
jam_dos_options default_dos_options();
struct DensityOfStates {
  std::vector<double> omega;  // middle of each bin, from -sqrt(-lambda_min) with pre-stress (omega^2 < 0: unstable)
  std::vector<double> density, density_error;        // D(omega) there
  std::vector<double> cumulative, cumulative_error;  // share of modes below the upper end of the bin
  double step = 0.0;                                 // width of a bin
};
void check_dos_options(const jam_dos_options &o);
// Kernel polynomial method (Weisse et al., Rev. Mod. Phys. 78, 275 (2006)).
DensityOfStates density_of_states(const RigidityMatrix &g, const ContactWeights &w, const jam_dos_options &o);

// Second derivatives of the energy a volume by the gradients E_ab and E_cd of x -> (1 + E) x, tables (d, d, d, d):
// spheres moved by it alone, and relaxed. JAM_E_STATE when pre-stress makes the network unstable.
struct ElasticTensor {
  std::vector<double> affine, relaxed;
};
ElasticTensor elastic_tensor(const Packing &p, const RigidityMatrix &g, const ContactWeights &w);
// Moduli from that tensor.
jam_moduli_report elastic_moduli(const Packing &p, const RigidityMatrix &g, const ContactWeights &w);

// Floppy modes: displacements when one contact opens, in a packing with a single state of self-stress.

struct FloppyModes {
  std::vector<double> median;     // b: median |dr_i| over |dr|
  std::vector<double> weight;     // W: f over the median |dr_i| of the field for s = 1
  std::vector<double> s_plus;     // opening at which, to first order, the next contact forms
  std::vector<double> s_star;     // opening of least diameter: f / sum_k f_k |dr_perp,k|^2 / r_k
  std::vector<double> stability;  // s_star / s_plus
  std::vector<double> s_return;   // opening at which the diameters are back: 2 s_star
  void resize(size_t m);
};

// To first order in the opening s of contact l all other contacts stay closed when the diameters change by a common
// factor 1 + gamma s: S dr = s (e_l + gamma sigma), which has a solution since f is orthogonal to the right side for
// gamma = -f_l / sum f sigma. dr has no net translation and is given for s = 1.
class FloppySolver {
 public:
  // JAM_E_STATE unless there is exactly one state of self-stress and translations are the only zero modes.
  FloppySolver(const Packing &p, const ContactNetwork &network, const RigidityMatrix &g);
  // dr (count, nodes, dim) of contacts first .. first + count - 1.
  void fields(size_t first, int count, std::vector<double> &dr) const;
  double inflation(size_t contact) const { return -force_[contact] / force_sigma_; }
  // Entry `at` of all figures, from the field dr of contact l.
  void measure(size_t l, const double *dr, FloppyModes &out, size_t at) const;

 private:
  const RigidityMatrix &g_;
  NullSpace space_;
  std::vector<double> force_;
  double force_sigma_ = 0.0;
  std::vector<double> uniform_;  // H^+ S^T sigma
  // pairs of stable spheres that are no contacts, h < 1
  std::vector<int32_t> i_, j_;
  std::vector<double> normal_, open_, sigma_;
};

// Of these contacts, which are solved in blocks of consecutive ones. vector: (contacts, nodes, dim), or NULL.
FloppyModes floppy_modes(const Packing &p, const ContactNetwork &network, const RigidityMatrix &g,
                         const std::vector<size_t> &contacts, std::vector<double> *vector);

// Modes and flexes at a wave vector. A field on all copies of the cell, u_j exp(2 pi i q . s) on sphere j of the copy
// at sum s_c a_c, has in one cell the row n . (u_i - u_j exp(-2 pi i q . s)) for a contact whose partner stands s cells
// back. So the rigidity matrix and the Hessian of m copies fall into m complex ones of one cell (Bloch's theorem).
//
// A complex Hermitian matrix A + i B is computed as the symmetric ((A, -B), (B, A)), which has every eigenvalue twice.

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
