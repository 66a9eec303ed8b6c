// The rows of the problem with radii among the unknowns, and the matrix of a Newton step.
//
//     maximise sum w_i R_i   subject to   c_k >= 0
//     a pair  c = |r_ij| - R_i - R_j      a wall  c = distance(r_i) - R_i
//     bounds  c = R_i - R_min, R_max - R_i
//
// Sphere i has d + 1 unknowns: its displacement s_i and the growth t_i of its radius. Row k is linear in them with
// n = r_ij / |r_ij|: c + n . (s_i - s_j) - t_i - t_j. As |r + s| >= n . (r + s), no point that keeps the linear rows
// has an overlap, however long the step.
#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "core/packing.hpp"
#include "core/pairs.hpp"
#include "linalg/block_cholesky.hpp"
#include "linalg/small_cholesky.hpp"

namespace jam::inside {

struct RadiiBounds {
  double least = 0.0, most = std::numeric_limits<double>::infinity();
};

class RadiiRows {
 public:
  RadiiRows() = default;
  // All pairs and walls with gaps below reach, and the bounds; p.diameter is twice the radii.
  RadiiRows(const Packing &p, const RadiiBounds &bounds, double reach);
  RadiiRows only(const std::vector<char> &on) const;
  size_t size() const { return gap.size(); }
  size_t unknowns() const { return static_cast<size_t>(n_) * block(); }
  size_t block() const { return static_cast<size_t>(dim_) + 1; }
  size_t bounds() const { return sphere_.size(); }
  bool is_bound(size_t k) const { return k >= pairs.size(); }

  // Gaps alone, and with the normals.
  void measure_gaps(const Packing &p, std::vector<double> &out) const;
  void measure(const Packing &p);
  // out_k = what x, (n, d + 1), adds to row k.
  void times(const std::vector<double> &x, std::vector<double> &out) const;
  // out = sum_k y_k times row k.
  void transpose_times(const std::vector<double> &y, std::vector<double> &out) const;
  // f(sphere, sign of the normal, coefficient of its t) for the spheres of row k.
  template <class F>
  void parts(size_t k, F &&f) const {
    if (is_bound(k)) {
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

 private:
  int dim_ = 0;
  int32_t n_ = 0;
  RadiiBounds bounds_;
  std::vector<int32_t> sphere_;  // of the bounds
  std::vector<double> sign_;     // 1: the lower one
};

// sum_k D_k a_k a_k^T + ridge, factorised, and bordered by the equations of a goal.
class RadiiMatrix {
 public:
  // ridge: over the mean of the diagonal; larger with equations, whose columns alone act on what no row stops.
  // columns: (equations, n), gradients on the radii; kept by pointer. stiffness: of each radius, added to the diagonal.
  void factorise(const RadiiRows &rows, const std::vector<double> &weight, const std::vector<double> &columns,
                 double ridge, int threads, const std::vector<double> &stiffness = {});
  // K x + columns^T y = rhs and columns x = given, which is 0 where it is empty. Returns y.
  std::vector<double> solve(std::vector<double> &x, const std::vector<double> &given = {}) const;
  std::vector<double> along_columns(const std::vector<double> &x) const;
  int64_t factorisations = 0;

 private:
  void set_graph(const RadiiRows &rows, int threads);
  void border(const std::vector<double> &columns, size_t block);
  BlockCholesky cholesky_;
  std::vector<int32_t> ei_, ej_, edge_;  // edge_: of each pair; -1 without
  std::vector<double> diag_, off_;
  const std::vector<double> *columns_ = nullptr;
  size_t block_ = 0, equations_ = 0;
  std::vector<double> solved_;  // K^-1 columns^T
  SmallCholesky schur_;         // of columns K^-1 columns^T
};

}  // namespace jam::inside
