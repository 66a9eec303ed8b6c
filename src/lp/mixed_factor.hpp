// A factor of the linear system of an interior-point step in single precision where that is faster and accurate enough,
// else in double: conjugate gradients on the factor in floats find a direction to some accuracy.
#pragma once
#include <limits>

#include "linalg/newton_system.hpp"

namespace jam::inside {

struct SinglePrecision {
  double work = std::numeric_limits<double>::infinity();  // flops a number of the factor; below, doubles
  double accuracy = 0.0;                                  // error of a direction in the norm of the matrix
  int max_products = 0;  // of conjugate gradients for it; past them a factor in doubles takes over
};

class MixedFactor {
 public:
  MixedFactor(NewtonSystem &system, const SinglePrecision &single) : system_(system), single_(single) {}
  // As NewtonSystem::factorise, which keeps the pointers. gap: the duality gap, which falls as the weights spread. From
  // `least` on, and from the gap on at which floats failed, factors are doubles.
  bool factorise(const double *a, const double *weight, const double *box, double gap, double least);
  // Where floats do not do, the matrix is factorised again in doubles, with up to `refine` steps of refinement. False
  // when that fails.
  bool solve(const double *rhs, double h, double *ds, double *dg, int refine);

 private:
  bool factorise_fully();

  NewtonSystem &system_;
  const SinglePrecision single_;
  const double *a_ = nullptr, *weight_ = nullptr, *box_ = nullptr;
  double gap_ = 0.0, failed_at_ = 0.0;  // duality gaps: of the matrix at hand, and where floats failed last
  bool floats_ = false;
};

}  // namespace jam::inside
