// The linear system of every interior-point step on the particle graph, shared by the LP solver and the
// re-linearising crunch:
//     [ A^T D A + diag(box)   -A^T D 1 ] [ds]   [R]
//     [ -1^T D A               1^T D 1 ] [dg] = [h]
// A^T D A has one d x d block a particle and a pair of particles; the Gamma column goes by a Schur complement. So do
// the few columns of strain amplitudes in a free cell; vectors of unknowns then hold them behind the displacements.
#pragma once
#include <functional>

#include "core/pairs.hpp"
#include "linalg/block_cholesky.hpp"

namespace jam::inside {

// Conjugate gradients on one matrix K for several right-hand sides, one after the other. The directions of the first
// ones are kept: later ones begin with the solution along them and stay conjugate to them, so that what the
// preconditioner misses is found once (Erhel and Guyomarc'h, SIAM J. Matrix Anal. Appl. 21, 1279 (2000)).

class ConjugateGradients {
 public:
  // out := a symmetric positive definite matrix times in.
  using Product = std::function<void(const double *in, double *out)>;

  // From now on K is another matrix of so many unknowns.
  void forget(size_t unknowns);
  // x := K^-1 b, each as long as the unknowns, until the error is some `accuracy` of x in the norm of K. precondition:
  // M^-1, nearly K^-1. False when that takes more than `most` products with K, or nothing finite came out. As many
  // directions are kept at most.
  bool solve(const double *b, double accuracy, int most, const Product &precondition, const Product &times_k,
             double *x);

 private:
  struct Direction {
    std::vector<double> along, image;  // p, and K p
    double energy = 0.0;               // p . K p
  };

  std::vector<Direction> kept_;
  size_t count_ = 0;  // of kept_, those of this matrix
  Direction now_;
  std::vector<double> residual_, correction_;
};

class NewtonSystem {
 public:
  // Symbolic part; reused by every factorise() until the pairs change (nothing is done for the same pairs). Images of
  // one pair share a block. keep_order: the elimination order stays, for a graph that got a few pairs more.
  void set_graph(int dim, int32_t n, const PairList &pairs, int threads, bool keep_order = false);
  // Bytes that a crunch takes for `rows` pairs between `edges` pairs of spheres, with so many numbers in the factor and
  // in the fronts beside it. Numbers of the factor in doubles: crunches of all sizes end in doubles. Blocks before
  // elimination; a dozen vectors and the rows themselves for each pair, 45 for each unknown; three pair lists; tables
  // of the symbolic part (an index for each block of the factor among them).
  static double bytes(double dim, double n, double rows, double edges, double factor, double fronts) {
    const double blocks = 8.0 * dim * dim * (n + edges), vectors = 8.0 * (rows * (14.0 + 2.0 * dim) + n * dim * 45.0);
    const double lists = 3.0 * rows * (8.0 + 8.0 * dim), tables = 80.0 * (n + edges) + 8.0 * factor / (dim * dim);
    return 8.0 * (factor + fronts) + blocks + vectors + lists + tables;
  }
  // Frees the memory of the factor; the next call is set_graph.
  void release();
  // Columns of strain for the pairs of set_graph, (pairs, count); kept by pointer. set_graph takes them away.
  void set_strain(const double *strain, int count);
  // a: (pairs, dim) rows; weight: D of each pair; box: a value for each unknown, added to the diagonal. Keeps the
  // pointers a and weight and a copy of box until the next call. False when the numbers are no longer finite.
  bool factorise(const double *a, const double *weight, const double *box, Precision precision = Precision::full);
  // Solves with up to `refine` steps of iterative refinement against the unassembled operator, as long as the residual
  // is above 1e-9 of the right-hand side.
  void solve(const double *rhs, double h, double *ds, double *dg, int refine = 1);

  // Solves by conjugate gradients with the factor at hand as preconditioner, until the error is some `accuracy` of the
  // solution in the norm of the matrix. False when that takes more than `most` products, or nothing finite came out.
  // Later right-hand sides of one matrix take fewer.
  bool solve_near(const double *rhs, double h, double *ds, double *dg, double accuracy, int most);

  // out[k] = a_k . (s_i - s_j)
  void rows_times(const double *a, const double *s, double *out) const;
  // out += sum_k y_k a_k on i, minus on j (out is zeroed first)
  void transpose_times(const double *a, const double *y, double *out) const;

  int factorisations = 0;
  double seconds_factor = 0.0, seconds_assemble = 0.0, seconds_solve = 0.0;
  const BlockCholesky &cholesky() const { return cholesky_; }

 private:
  template <int D>
  void assemble(const double *a, const double *weight);
  void solve_once(const double *rhs, double h, double *ds, double *dg);
  void border();
  double operator_times(const double *ds, double dg, double rest);

  int dim_ = 0, threads_ = 0;
  int32_t n_ = 0;
  std::vector<int32_t> pair_i_, pair_j_, edge_of_pair_;  // edge -1: an image of one sphere with itself, -2: a wall
  size_t edges_ = 0;
  BlockCholesky cholesky_;
  std::vector<double> diag_, off_, box_;        // blocks
  std::vector<double> column_, column_solved_;  // q = A^T D 1 and K^-1 q
  double delta_ = 0.0, schur_ = 0.0;            // 1^T D 1, and minus q . K^-1 q
  const double *a_ = nullptr, *weight_ = nullptr;
  // With strain: F = A^T D B and K^-1 F, column by column, and the inverse of the Schur complement of (g, e).
  const double *strain_ = nullptr;
  int strains_ = 0;
  std::vector<double> border_, border_solved_, corner_;
  std::vector<double> row_work_, work_, residual_, correction_;
  ConjugateGradients gradients_;
  std::vector<double> bordered_rhs_, bordered_;  // displacements, strains, g
};

}  // namespace jam::inside
