// Vibrational modes: dense, by LAPACK where the build has it, or few by Lanczos.
#pragma once
#include <functional>
#include <vector>
#include "analysis/tuning.hpp"
#include "core/monitor.hpp"
#include "network/hessian.hpp"

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
// All eigenvalues (and vectors) of a dense symmetric matrix, whose lower triangle a (a lapack_array) gives
// column-major; the vectors overwrite it. `stop` is asked between stages. False when stopped. By LAPACK where the build
// has it (JAM_LAPACK): its bits depend on the processor.
bool dense_eigen(int n, std::vector<double> &a, std::vector<double> &lambda, bool vectors,
                 const std::function<bool(double)> &stop);
// The same by own loops: for eigenvalues that decide something. With all vectors it takes longer than LAPACK.
bool dense_eigen_builtin(int n, std::vector<double> &a, std::vector<double> &lambda, bool vectors,
                         const std::function<bool(double)> &stop);
// modes_dense.cpp: eigenvalues and vectors of the whole Hessian; JAM_CANCELLED when stopped.
jam_status all_modes(const BlockMatrix &h, Monitor &monitor, Modes &out);
// Reduces them to the modes requested. The d translations are removed first.
void select_modes(const RigidityMatrix &g, const jam_modes_options &o, Modes &all);
// Y = sum |v_i|^4 / (sum |v_i|^2)^2 of a field (nodes, dim).
double inverse_participation(int dim, int32_t nodes, const double *v);

}  // namespace jam::inside
