// LPs with a few hundred dense columns, for the last contacts of a packing.
#pragma once
#include <vector>

namespace jam {

// The vertex that minimises cost . x over x >= 0 with rows x = rhs; rows: rhs.size() by cost.size(), one row after the
// other. Numbers of order one are expected: the tolerances are absolute, 1e-10. What is not in the basis is exactly
// zero. Empty: no optimum.
std::vector<double> solve_small_lp(const std::vector<double> &cost, const std::vector<double> &rows,
                                   const std::vector<double> &rhs);

}  // namespace jam
