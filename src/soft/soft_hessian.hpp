// The Hessian of soft spheres with pre-stress on the stable spheres, and its factor.
#pragma once
#include <vector>

#include "linalg/block_cholesky.hpp"
#include "soft/relaxation.hpp"

namespace jam::inside {

class SoftHessian {
 public:
  // Factorises the Hessian of these contacts plus the smallest shift of shift * 10^k that makes it positive definite.
  // `on`: stable_contacts(). One stable sphere is tied to its place, for the translations, and rattlers by a weak
  // spring to theirs. False when no shift is enough.
  bool factorise(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on, double shift,
                 int64_t &factorisations);
  // Numbers that its factor would have, without computing it.
  size_t factor_numbers(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on);
  // x: displacements, and behind them the strains of a free cell.
  void solve(std::vector<double> &x) const;
  // Whether these are the contacts of the last factorisation.
  bool has_contacts(const SoftState &state, const SoftContacts &contacts) const;
  double shift() const { return shift_; }  // that was needed, in units of the typical stiffness

 private:
  void assemble(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on);
  void add_border(const SoftState &state, const SoftContacts &contacts, const CellStrain &strain, size_t contact);
  // False when the matrix with the strains is not positive definite.
  bool factorise_border(double shift);

  BlockCholesky cholesky_;
  std::vector<int32_t> ei_, ej_;
  std::vector<double> diag_, off_;
  // Strains: their columns (spheres, strains), these by the inverse of the matrix of spheres, what couples strains to
  // strains, and the inverse of its Schur complement.
  size_t strains_ = 0;
  std::vector<double> border_, border_solved_, corner_, schur_;
  std::vector<int32_t> analysed_i_, analysed_j_;
  double unit_ = 1.0, shift_ = 0.0;
};

// As hybrid() of relaxation.hpp. convex: that the last factor of the Hessian was positive as it is; kept without one.
DescentEnd hybrid(Relaxation &r, double tolerance, bool near_minimum, bool &convex);

}  // namespace jam::inside
