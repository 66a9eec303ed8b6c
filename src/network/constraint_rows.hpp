// The rows of a jamming test, A = [S E]: relative normal displacement of every contact from displacements of the nodes
// and, when the cell may change its shape, from a traceless symmetric strain; and linear systems with A^T D A.
#pragma once
#include "linalg/block_cholesky.hpp"
#include "network/rigidity_matrix.hpp"

namespace jam::inside {

// Orthonormal basis of the traceless symmetric d x d matrices with no component off these axes (bits): of all d,
// (d (d + 1) / 2 - 1, d, d).
std::vector<double> traceless_basis(int dim, uint32_t axes = ~0u);
// Their number.
inline int traceless_strains(int dim, uint32_t axes) {
  int m = 0;
  for (int c = 0; c < dim; ++c) m += static_cast<int>(axes >> c & 1u);
  return m > 0 ? m * (m + 1) / 2 - 1 : 0;
}

// Only axes without walls strain. Walls keep their places, and their normals have no component along such an axis.
// Unknowns: displacements (nodes, dim), then the coefficients of the strain in units of 1 / mean contact distance.
struct ConstraintRows {
  ConstraintRows(const RigidityMatrix &g, bool with_strain);
  const RigidityMatrix &g;
  int strains = 0;
  double length = 1.0;    // mean contact distance
  std::vector<double> e;  // (contacts, strains)
  size_t rows() const { return g.contacts(); }
  size_t columns() const { return g.unknowns() + static_cast<size_t>(strains); }
  void multiply(const double *x, double *y) const;       // y (rows) = A x
  void transpose(const double *f, double *y) const;      // y (columns) = A^T f
  std::vector<double> strain_of(const double *x) const;  // (dim, dim)
};

// (A^T D A + shift)^-1. The sparse part is factored; the few columns of strain go by their Schur complement.
class NormalSolver {
 public:
  explicit NormalSolver(const ConstraintRows &rows);
  ~NormalSolver();
  // D: one weight a row. The smallest shift of start * 10^k that gives a positive definite matrix.
  void factorise(const std::vector<double> &weight, double start);
  void solve(double *x, int count = 1) const;
  double shift() const { return factor_->shift(); }

 private:
  struct Border;
  const ConstraintRows &rows_;
  BlockMatrix h_;
  std::unique_ptr<ShiftedFactor> factor_;
  std::unique_ptr<Border> border_;
};

// With a solver of unit weights: f := its part with A^T f = 0, refined until the residual |A^T f| stops falling.
void project_on_balance(const ConstraintRows &rows, const NormalSolver &solver, std::vector<double> &f);
// x with A x nearest to y, refined likewise.
std::vector<double> nearest_motion(const ConstraintRows &rows, const NormalSolver &solver,
                                   const std::vector<double> &y);

}  // namespace jam::inside
