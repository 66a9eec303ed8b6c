#include "lp/mixed_factor.hpp"

#include <algorithm>

namespace jam::inside {

bool MixedFactor::factorise(const double *a, const double *weight, const double *box, double gap, double least) {
  a_ = a, weight_ = weight, box_ = box, gap_ = gap;
  const double work = system_.cholesky().flops() / static_cast<double>(system_.cholesky().factor_nonzeros());
  floats_ = work > single_.work && gap > std::max(least, failed_at_);
  return (floats_ && system_.factorise(a, weight, box, Precision::single)) || factorise_fully();
}

bool MixedFactor::factorise_fully() {
  if (floats_) failed_at_ = gap_;
  floats_ = false;
  return system_.factorise(a_, weight_, box_);
}

bool MixedFactor::solve(const double *rhs, double h, double *ds, double *dg, int refine) {
  if (floats_ && system_.solve_near(rhs, h, ds, dg, single_.accuracy, single_.max_products)) return true;
  if (floats_ && !factorise_fully()) return false;
  system_.solve(rhs, h, ds, dg, refine);
  return true;
}

}  // namespace jam::inside
