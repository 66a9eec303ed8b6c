// The softest motions of a contact network, by block inverse iteration: flexes, and the smallest eigenvalue above them.
#pragma once
#include <vector>

#include "network/constraint_rows.hpp"

namespace jam::inside {

struct SoftestModes {
  std::vector<std::vector<double>> flexes;  // orthonormal motions x with |A x|^2 < `limit`, translations left out
  double margin = 0.0;                      // smallest eigenvalue of A^T A above them; infinity without another motion
  bool complete = true;                     // false: there are more flexes than were requested
};
// solver: factored with unit weights and a shift near `limit`.
SoftestModes softest_modes(const ConstraintRows &rows, const NormalSolver &solver, double limit, size_t most_flexes);

}  // namespace jam::inside
