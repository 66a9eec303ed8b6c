// The Hessian of soft spheres with pre-stress on the stable spheres, and its factor.
#pragma once
#include <vector>

#include "linalg/block_cholesky.hpp"
#include "soft/soft_state.hpp"

namespace jam {

class SoftHessian {
 public:
  // Factorises the Hessian of these contacts plus the smallest shift of shift * 10^k that makes it positive definite.
  // `on`: stable_contacts(). One stable sphere is tied to its place, for the translations, and rattlers by a weak
  // spring to theirs. False when no shift is enough.
  bool factorise(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on, double shift,
                 int64_t &factorisations);
  void solve(std::vector<double> &x) const { cholesky_.solve(x.data()); }
  // Whether these are the contacts of the last factorisation.
  bool has_contacts(const SoftState &state, const SoftContacts &contacts) const;
  double shift() const { return shift_; }  // that was needed, in units of the typical stiffness

 private:
  void assemble(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on);

  BlockCholesky cholesky_;
  std::vector<int32_t> ei_, ej_;
  std::vector<double> diag_, off_;
  std::vector<int32_t> analysed_i_, analysed_j_;
  double unit_ = 1.0, shift_ = 0.0;
};

}  // namespace jam
