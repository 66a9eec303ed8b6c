// The barrier problem at one mu: maximise log Gamma + mu * sum_k log c_k over positions and the common factor of the
// diameters, with the true gaps c_k = |r_k|^2 / (Gamma sigma_k^2) - 1 (a free volume in the sense of cell theory).
#pragma once
#include <array>

#include "lp/mixed_factor.hpp"
#include "lp/packing_lp.hpp"

namespace jam::inside {

// Change of positions and strain amplitudes s (mean diameters), of Gamma g, and with it of the linearised rows w and
// the multipliers y.
struct BarrierStep {
  std::vector<double> s, w, y;
  double g = 0.0;
};

class BarrierProblem {
 public:
  PairList pairs;
  PackingLp lp;           // rows at the present positions
  std::vector<double> y;  // multipliers of the rows
  double unit = 1.0, mu = 0.0;
  StrainBasis strain;  // empty: a fixed cell

  // Rows at the true distances of p. False when a gap is no longer positive.
  bool linearise(const Packing &p);
  double duality_gap() const;
  // Minus the slope of the barrier function along x over mu: the squared Newton decrement.
  double decrement(const BarrierStep &x) const;
  // Largest displacement of a sphere, and norm of the strain.
  double longest_move(const BarrierStep &x) const;
  double strain_norm(const BarrierStep &x) const;
  // (dim, dim) times alpha; empty in a fixed cell.
  std::vector<double> strain_of(const BarrierStep &x, double alpha) const;
  double longest_dual(const BarrierStep &x) const;
  // Row k after alpha x, with the bending that the linear row omits: c + alpha w + alpha^2 |s_i - s_j + E r|^2 /
  // sigma^2; of a flat wall the part of s_i along its normal. A round wall bends the other way, and not as a square:
  // its distance is computed again.
  double gap_after(const BarrierStep &x, size_t k, double alpha) const {
    if (!curved_.empty() && curved_of_[k] >= 0) return curved_gap(x, k, alpha);
    return lp.c[k] + alpha * (x.w[k] + alpha * bend_[k]);
  }

  // A bound of the second derivatives of round walls, times y, to the diagonal of the matrix: without them a sphere
  // that the curvature of its wall holds would take steps of any length.
  void add_wall_bending(std::vector<double> &diagonal) const;

  struct Best {
    double alpha, merit;
  };
  // The best step along x: a few passes over the rows, where a factorisation costs hundreds. `merit` is by how much it
  // makes the negative of the barrier function larger (below zero: better).
  Best search(const BarrierStep &x);

 private:
  struct CurvedRow {
    size_t k;
    int w;                              // the wall
    std::array<double, JAM_MAX_DIM> x;  // of the sphere
    double radius, distance, bending;   // 2nd derivative of the row across the normal, in units
  };
  void list_curved_walls(const Packing &p);
  double curved_gap(const BarrierStep &x, size_t k, double alpha) const;
  double time_to_curved_wall(const BarrierStep &x, const CurvedRow &row) const;
  void bend(const BarrierStep &x);
  double max_feasible_alpha(const BarrierStep &x) const;
  double merit(const BarrierStep &x, double alpha) const;

  std::vector<double> bend_, sigma2_, vector_;  // vector_: r_ij in units, of a free cell
  Container container_;
  std::vector<CurvedRow> curved_;
  std::vector<int32_t> curved_of_;  // row -> CurvedRow, -1: another; empty without curved walls
};

// The matrix of a Newton step on the barrier path: which rows couple spheres in it, and its numbers.
class PathMatrix {
 public:
  PathMatrix(NewtonSystem &system, int threads, const SinglePrecision &single)
      : system_(system), factor_(system, single), threads_(threads) {}

  // Call this when the pair list changes.
  void reset(size_t rows, size_t unknowns);
  // The numbers of the matrix at the present rows, with `proximal` on its diagonal.
  void weigh(const Packing &p, const BarrierProblem &b, double proximal);
  // In single precision where that is faster and was good enough so far.
  bool factorise(double gap);
  // Changes ds, dg for the right-hand sides rhs, h. Where single precision does not do, the matrix is factorised again;
  // false when that fails.
  bool solve(const double *rhs, double h, double *ds, double *dg);

  // y / c of every row.
  const std::vector<double> &weight() const { return weight_; }
  size_t coupled() const { return coupled_.size(); }

 private:
  void choose_coupled(const Packing &p, const BarrierProblem &b);

  NewtonSystem &system_;
  MixedFactor factor_;
  const int threads_;
  size_t ordered_rows_ = 0;      // at the last elimination order; 0: none for this list
  std::vector<size_t> coupled_;  // rows in the matrix, ascending
  PairList pairs_;
  std::vector<double> a_, strain_, coupled_weight_, weight_, diagonal_;
};

}  // namespace jam::inside
