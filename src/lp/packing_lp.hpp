// The linear program of one crunch step, and its answer.
//
// Units: lengths in mean diameters, each row divided by sigma_ij^2, so that with s the displacements and
// g = Gamma - 1 the published LP (Artiaco et al., Phys. Rev. E 106, 055310 (2022), eq. 3) reads
//     maximise g   subject to   w_e = c_e + a_e . (s_i - s_j) - g >= 0,   |s_ik| <= bound,
//     a_e = 2 r_ij / sigma_ij^2,   c_e = |r_ij|^2 / sigma_ij^2 - 1.
// A wall (pair_vector, contact_distance) has s_j = 0. The tangent of a flat wall is the wall, so its row is safe as
// that of a pair is; a round wall curves inward from its tangent: crunch/approach/lp_step.cpp. Multipliers y_e =
// lambda_e sigma_e^2 then obey sum_e y_e = 1 and sum_j y_e a_e = 0 on every particle. In a free cell strain amplitudes
// e_k join, within the same bound: w_e gets sum_k b_ek e_k with b_ek = 2 r_ij . (B_k r_ij) / sigma_ij^2, B_k from
// StrainBasis. Then also sum_e y_e b_ek = 0 (Donev, Torquato, Stillinger, Connelly, J. Comput. Phys. 197, 139
// (2004)).
#pragma once
#include <limits>

#include "core/monitor.hpp"
#include "core/pairs.hpp"
#include "linalg/block_matrix.hpp"
#include "lp/tuning.hpp"

namespace jam::inside {

// Strains of a free cell that a linear program may choose: r -> (1 + E) r with E upper-triangular, so that the cell
// stays lower-triangular, and traceless, because growth of all diameters already is a change of volume. Axes that walls
// close keep their length and their direction.
struct StrainBasis {
  int dim = 0;
  std::vector<double> matrices;  // (count, dim, dim)
  int count() const { return dim ? static_cast<int>(matrices.size()) / (dim * dim) : 0; }
};

// Which components of the cell may change along these axes (bits): the edges a_cc, the tilts a_ck, or both.
StrainBasis strain_basis(int dim, bool edges, bool tilts, uint32_t axes = ~0u);
// An option of a call at fixed volume: JAM_STRAIN_NONE .. JAM_STRAIN_FREE.
void check_strain(int32_t strain, const char *call);
// Largest part of a strain (dim, dim) that leaves half of each edge. In a thin cell that is far from jammed the bound
// of an LP lets several amplitudes shorten one edge, by more than there is of it.
double strain_part(int dim, const std::vector<double> &strain);
// E = sum_k amplitude_k B_k, (dim, dim).
std::vector<double> strain_matrix(const StrainBasis &basis, const std::vector<double> &amplitude, double scale);
// r . (B_k r) of every pair, times scale_e: (pairs, count).
std::vector<double> strain_rows(const StrainBasis &basis, const std::vector<double> &vectors,
                                const std::vector<double> &scale);

struct PackingLp {
  int dim = 3;
  int32_t n = 0;
  const PairList *pairs = nullptr;
  std::vector<double> a;                                   // (pairs, dim)
  std::vector<double> c;                                   // pairs
  int strains = 0;                                         // amplitudes of strain, 0 in a fixed cell
  std::vector<double> strain;                              // b, (pairs, strains)
  double bound = std::numeric_limits<double>::infinity();  // on each |s_ik|, mean diameters
  size_t rows() const { return c.size(); }
  // a . (s_i - s_j) + b . e of row k.
  double change(size_t k, const double *s, const double *e) const {
    const auto d = static_cast<size_t>(dim), m = static_cast<size_t>(strains);
    const double *si = s + static_cast<size_t>(pairs->i[k]) * d;
    double sum = 0.0;
    if (pairs->wall(k)) {
      for (size_t q = 0; q < d; ++q) sum += a[k * d + q] * si[q];
    } else {
      const double *sj = s + static_cast<size_t>(pairs->j[k]) * d;
      for (size_t q = 0; q < d; ++q) sum += a[k * d + q] * (si[q] - sj[q]);
    }
    for (size_t q = 0; q < m; ++q) sum += strain[k * m + q] * e[q];
    return sum;
  }
  size_t spheres() const { return static_cast<size_t>(n) * static_cast<size_t>(dim); }  // displacements among unknowns
  size_t unknowns() const { return spheres() + static_cast<size_t>(strains); }
};

struct LpSolution {
  std::vector<double> s;       // (n, dim)
  std::vector<double> strain;  // amplitudes
  double g = 0.0;
  std::vector<double> y, w;  // multipliers and slacks of the rows
  int iterations = 0, factorisations = 0;
  bool solved = false;                            // the solver's own word; check_lp decides
  std::vector<double> basis_rows, basis_columns;  // of Clp: the status of each, plus 1; 0: not known
};

// Where the next problem on nearly the same rows may start.
struct Multipliers {
  PairList pairs;
  std::vector<double> y;
};

// Puts multipliers near the central path of slacks w: those known (y > 0) are scaled to sum 1, their mean product with
// w over about `carrying` rows is mu, and each is pulled to within a factor of mu / w; the rest gets mu / w. None
// known: all on the path, sum 1. Returns mu.
double centre_multipliers(std::vector<double> &y, const std::vector<double> &w, double carrying);

// Residuals of an answer, computed here from the LP alone and not by a solver.
struct LpCheck {
  double infeasibility;  // largest violation of a row or bound
  double balance;        // largest |sum y a|_k of a particle whose bounds are slack, over the mean of y |a|
  double gamma;          // |sum y - 1|
  double gap;            // upper bound - g, from sum y c + bound * sum |A^T y|
};

// Rows from the true distances of p. sigma_unit: the length that counts as 1.
PackingLp make_lp(const Packing &p, const PairList &pairs, double sigma_unit, const StrainBasis &basis = {});
LpCheck check_lp(const PackingLp &lp, const LpSolution &answer);

// Unknowns: the displacements, then strain amplitudes.
inline void rows_times(const PackingLp &lp, const double *s, double *out) {
  rows_times(lp.dim, lp.pairs->i, lp.pairs->j, lp.a.data(), s, out);
  add_columns_times(lp.strain.data(), static_cast<size_t>(lp.strains), lp.rows(), s + lp.spheres(), out);
}
inline void transpose_times(const PackingLp &lp, const double *y, double *out) {
  transpose_times(lp.dim, lp.n, lp.pairs->i, lp.pairs->j, lp.a.data(), y, out);
  columns_transpose_times(lp.strain.data(), static_cast<size_t>(lp.strains), lp.rows(), y, out + lp.spheres());
}

// Whether this build has Clp (JAM_CLP). Without it solve_lp_clp gives no answer, and the log says why.
bool clp_is_built();
// Clp's simplex on the same LP, an independent and slower solver. Thread-safe: each call has its own model. monitor,
// which may be NULL, can interrupt it between two pivots. start: a basis from a former answer with rows for this LP (0:
// not known), or NULL.
LpSolution solve_lp_clp(const PackingLp &lp, double tolerance = lp_rounding, const Monitor *monitor = nullptr,
                        const LpSolution *start = nullptr);

}  // namespace jam::inside
