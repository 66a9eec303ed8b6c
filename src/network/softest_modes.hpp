// The softest motions of a contact network, by block inverse iteration: flexes, and the smallest eigenvalue above them.
#pragma once
#include <functional>
#include <vector>

#include "network/constraint_rows.hpp"
#include "network/slides.hpp"

namespace jam::inside {

struct SoftestModes {
  PartTranslations slides;                  // flexes that need no search, of any number
  std::vector<std::vector<double>> flexes;  // the others: orthonormal motions x with |A x|^2 < `limit`, no symmetries
  double margin = 0.0;                      // smallest eigenvalue of A^T A above them; infinity without another motion
  bool complete = true;                     // false: there are more of the others than were requested
  int64_t count() const { return slides.count() + static_cast<int64_t>(flexes.size()); }
};
// Rows A whose softest motions are searched for.
struct SoftRows {
  size_t rows, columns;
  size_t known;                                              // independent motions of length 0 that `remove` takes out
  std::function<void(const double *x, double *y)> multiply;  // y = A x
  std::function<void(double *x)> remove;
  std::function<void(double *x, int count)> solve;  // x := (A^T A + shift)^-1 x for `count` vectors, shift near `limit`
};
SoftestModes softest_modes(const SoftRows &rows, double limit, size_t most_flexes);
// solver: factored with unit weights and a shift near `limit`.
SoftestModes softest_modes(const ConstraintRows &rows, const NormalSolver &solver, double limit, size_t most_flexes);

}  // namespace jam::inside
