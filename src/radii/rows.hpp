// The rows of the problem with radii among the unknowns, and the matrix of a Newton step.
//
//     maximise sum w_i R_i   subject to   c_k >= 0
//     a pair  c = |r_ij| - R_i - R_j      a wall  c = distance(r_i) - R_i
//     bounds  c = R_i - R_min, R_max - R_i
//
// Sphere i has d + 1 unknowns: its displacement s_i and the growth t_i of its radius. Row k is linear in them with
// n = r_ij / |r_ij|: c + n . (s_i - s_j) - t_i - t_j. As |r + s| >= n . (r + s), no point that keeps the linear rows
// has an overlap, however long the step. In a free cell strains e are unknowns too, and add n . E(e) r. Their volume is
// kept by a common factor >= 1 (core/cell_change.hpp), which opens gaps further.
//
// A round wall bends the other way: |r| <= A - R about its centre, so that steps are tested on true gaps. Its barrier
// is that of the cone, log((A - R)^2 - |r|^2), smooth where r = 0: log c of the nearest point plus log c of the
// opposite one, A + |r| - R, which is a row of the path too. In all, second derivatives of the barrier are
//     -mu a a^T / c^2 of both rows, and -2 mu / (c c_opposite) (P - m m^T) of positions (P, m: core/surface.hpp).
#pragma once
#include <limits>

#include "core/double_double.hpp"
#include "core/packing.hpp"
#include "linalg/block_cholesky.hpp"
#include "linalg/symmetric_eigen.hpp"
#include "lp/packing_lp.hpp"

namespace jam::inside {

// What bounds the radii, and how the cell may deform.
struct RadiiBounds {
  double least = 0.0, most = std::numeric_limits<double>::infinity();
  StrainBasis strain{};  // of lengths: amplitudes times radii_unit
  double volume = 0.0;   // of the cell, which strains keep
  size_t strains() const { return static_cast<size_t>(strain.count()); }
};

class RadiiRows {
 public:
  RadiiRows() = default;
  // All pairs and walls with gaps below reach, and the bounds; p.diameter is twice the radii.
  RadiiRows(const Packing &p, const RadiiBounds &bounds, double reach);
  RadiiRows only(const std::vector<char> &on) const;
  size_t size() const { return gap.size(); }
  size_t spheres() const { return static_cast<size_t>(n_); }
  // (n, d + 1), then the strains.
  size_t unknowns() const { return spheres() * block() + bounds_.strains(); }
  const RadiiBounds &allowed() const { return bounds_; }
  size_t block() const { return static_cast<size_t>(dim_) + 1; }
  size_t bounds() const { return sphere_.size(); }
  bool is_bound(size_t k) const { return k >= pairs.size() && k < linear(); }
  // Rows before those of opposite points; the pair of which row k >= linear() is opposite.
  size_t linear() const { return pairs.size() + sphere_.size(); }
  size_t facing(size_t k) const { return round_[k - linear()]; }

  // Gaps alone, and with the normals. Offsets of pairs follow the cell of p.
  void measure_gaps(const Packing &p, std::vector<double> &out);
  void measure(const Packing &p);
  // out_k = what x, the unknowns, adds to row k.
  void times(const std::vector<double> &x, std::vector<double> &out) const;
  // out = sum_k y_k times row k.
  void transpose_times(const std::vector<double> &y, std::vector<double> &out) const;
  // f(sphere, sign of the normal, coefficient of its t) for the spheres of row k.
  template <class F>
  void parts(size_t k, F &&f) const {
    if (k >= linear()) {
      f(pairs.i[facing(k)], -1.0, -1.0);
    } else if (is_bound(k)) {
      f(sphere_[k - pairs.size()], 0.0, sign_[k - pairs.size()]);
    } else if (pairs.own_image(k)) {
      f(pairs.i[k], 0.0, -2.0);
    } else {
      f(pairs.i[k], 1.0, -1.0);
      if (!pairs.wall(k)) f(pairs.j[k], -1.0, -1.0);
    }
  }

  PairList pairs;                      // rows 0 .. pairs.size() - 1; then the bounds
  std::vector<double> gap;             // c
  std::vector<double> normal, length;  // of pairs and walls: n (rows, dim) and |r|
  std::vector<double> strain;          // of the same, (rows, strains): n . E r
  const double *normal_of(size_t k) const { return &normal[(k < linear() ? k : facing(k)) * (block() - 1)]; }
  // f(u, v, share) for each component of P - m m^T of round wall k.
  template <class F>
  void bending(const Packing &p, size_t k, F &&f) const {
    const Turning turning = p.container[wall_partner(pairs.j[k])].turning();
    for (int u = 0; u < dim_; ++u)
      for (int v = 0; v < dim_; ++v)
        if (turning.along(u) && turning.along(v))
          f(u, v, (u == v ? 1.0 : 0.0) - turning.lean * turning.lean * normal_of(k)[u] * normal_of(k)[v]);
  }

 private:
  void enter(const Cell &cell);
  int dim_ = 0;
  int32_t n_ = 0;
  Cell cell_;  // of the offsets
  RadiiBounds bounds_;
  std::vector<int32_t> sphere_;  // of the bounds
  std::vector<double> sign_;     // 1: the lower one
  std::vector<size_t> round_;    // pairs that are round walls
};

// sum_k D_k a_k a_k^T + ridge, factorised, and bordered by strains and by the equations of a goal.
class RadiiMatrix {
 public:
  // ridge: over the mean of the diagonal; larger with equations, whose columns alone act on what no row stops.
  // columns: (equations, n), gradients on the radii; kept by pointer. stiffness: of each radius, added to the diagonal;
  // bending: (n, dim, dim), of each position, or empty.
  void factorise(const RadiiRows &rows, const std::vector<double> &weight, const std::vector<double> &columns,
                 double ridge, int threads, const std::vector<double> &stiffness = {},
                 const std::vector<double> &bending = {});
  // K x + columns^T y = rhs and columns x = given, which is 0 where it is empty. Returns y.
  std::vector<double> solve(std::vector<double> &x, const std::vector<double> &given = {}) const;
  std::vector<double> along_columns(const std::vector<double> &x) const;
  int64_t factorisations = 0;

 private:
  void set_graph(const RadiiRows &rows, int threads);
  void border_strains(const RadiiRows &rows, const std::vector<double> &weight, double ridge,
                      const std::vector<double> &stiffness, const std::vector<double> &bending);
  void border(const std::vector<double> &columns);
  void solve_rows(std::vector<double> &x) const;
  BlockCholesky cholesky_;
  std::vector<int32_t> ei_, ej_, edge_;  // edge_: of each pair; -1 without
  std::vector<double> diag_, off_;
  const std::vector<double> *columns_ = nullptr;
  size_t block_ = 0, spheres_ = 0, strains_ = 0, equations_ = 0;
  std::vector<std::vector<double>> moved_;  // of each strain: all unknowns, where the spheres follow it
  SmallCholesky strained_;                  // of K along them
  std::vector<double> solved_;              // K^-1 columns^T
  SmallCholesky schur_;                     // of columns K^-1 columns^T
};

// What the path maximises, and the equations that radii keep meanwhile.
//
//     sum      sum w_i R_i
//     moments  L ln lambda, while P_q = sum R_i^q is lambda^q M_q for each exponent q; M_q: at the start
//
// With g_q = ln(P_q / M_q) / q, ln lambda is g of the first exponent. The others give one equation each,
// g_q - g_first = 0. Their gradients on the radii are dense columns, which border the matrix of a step.

class RadiiGoal {
 public:
  explicit RadiiGoal(const std::vector<double> &weight);           // of mean 1
  RadiiGoal(const Packing &start, std::vector<double> exponents);  // JAM_E_ARGUMENT where they fix the radii
  bool moments() const { return !exponent_.empty(); }
  size_t equations() const { return moments() ? exponent_.size() - 1 : 0; }
  // Gradients at these radii: of what is maximised, of mean 1; and of the equations, (equations, n), orthonormal.
  void linearise(const Packing &p);
  const std::vector<double> &weight() const { return weight_; }
  const std::vector<double> &columns() const { return column_; }
  // What the forces on each sphere add up to when the columns have these multipliers.
  std::vector<double> carried(const std::vector<double> &multiplier) const;
  // The equations in the basis of the columns: lengths.
  std::vector<double> wrong(const Packing &p) const;
  // What the step, of the unknowns of RadiiRows, gains in this part, from where the goal is linear to the radii of
  // `to`.
  double gain(const std::vector<double> &step, double part, const Packing &to) const;
  // Of each radius the second derivative of the same, negative; 0 where it is positive. Empty for sums.
  std::vector<double> stiffness(const Packing &p, const std::vector<double> &multiplier) const;
  // Second derivative along x, such a step, of what is maximised less the multipliers times the equations.
  double curvature(const Packing &p, const std::vector<double> &multiplier, const std::vector<double> &x) const;

  double lambda(const Packing &p) const;    // moments
  double residual(const Packing &p) const;  // largest |P_q / (lambda^q M_q) - 1|
  // lambda_q for each exponent: in units of lambda the forces on sphere i add up to sum_q lambda_q q R_i^(q - 1).
  std::vector<double> multipliers(const Packing &p, const std::vector<double> &of_columns) const;
  double scale() const { return scale_; }  // L

 private:
  DoubleDouble moment(const Packing &p, double exponent) const;
  double growth(const Packing &p, size_t q) const;  // g_q
  std::vector<double> of_moments(const std::vector<double> &multiplier) const;
  std::vector<double> weight_, column_, exponent_;
  std::vector<double> triangle_;     // (equations, equations), upper: gradients of the equations = columns times this
  std::vector<DoubleDouble> start_;  // M_q, of radii over length_
  DoubleDouble here_;                // P of the first exponent, where the goal is linear
  double length_ = 1.0, scale_ = 1.0;
};

}  // namespace jam::inside
