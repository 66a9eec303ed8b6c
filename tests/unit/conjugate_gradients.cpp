// Conjugate gradients for several right-hand sides of one matrix: accuracy, kept directions, and where they end.
#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/newton_system.hpp"
#include "test.h"

using namespace jam::inside;

namespace {

constexpr size_t unknowns = 40;

// K is diagonal; the preconditioner is the unit matrix, so it misses every entry that is not 1.
struct Scene {
  std::vector<double> k = std::vector<double>(unknowns, 1.0);
  ConjugateGradients gradients;

  explicit Scene(std::vector<double> others) {
    std::copy(others.begin(), others.end(), k.begin());
    gradients.forget(unknowns);
  }
  bool solve(const std::vector<double> &b, double accuracy, int most, std::vector<double> &x) {
    x.assign(unknowns, 7.0);
    return gradients.solve(
        b.data(), accuracy, most, [](const double *in, double *out) { std::copy(in, in + unknowns, out); },
        [this](const double *in, double *out) {
          for (size_t u = 0; u < unknowns; ++u) out[u] = k[u] * in[u];
        },
        x.data());
  }
  // Error over size of x in the norm of K.
  double error(const std::vector<double> &b, const std::vector<double> &x) const {
    double off = 0.0, size = 0.0;
    for (size_t u = 0; u < unknowns; ++u) {
      const double exact = b[u] / k[u];
      off += k[u] * (x[u] - exact) * (x[u] - exact), size += k[u] * exact * exact;
    }
    return std::sqrt(off / size);
  }
};

std::vector<double> right_hand_side(int which) {
  std::vector<double> b(unknowns);
  for (size_t u = 0; u < unknowns; ++u) b[u] = std::sin(1.0 + static_cast<double>(u) * (1.0 + 0.37 * which));
  return b;
}

// Four entries that the preconditioner misses, and the rest: five products serve, three do not. A second right-hand
// side then starts in their space, so that three do.
CASE(directions_are_kept) {
  Scene s({1e-3, 0.02, 0.3, 5.0});
  std::vector<double> x;
  const auto a = right_hand_side(0), b = right_hand_side(1);
  assert_false(s.solve(b, 1e-6, 3, x));
  s.gradients.forget(unknowns);
  assert_true(s.solve(a, 1e-12, 8, x));
  assert_true(s.solve(a, 1e-6, 0, x));  // the same right-hand side: nothing is left to do
  assert_true(s.error(a, x) < 1e-4);
  assert_true(s.solve(b, 1e-6, 3, x));
  assert_true(s.error(b, x) < 1e-4);
}

CASE(where_it_ends) {
  Scene s({1e-3, 0.02, 0.3, 5.0});
  std::vector<double> x;
  assert_true(s.solve(std::vector<double>(unknowns, 0.0), 1e-6, 0, x));
  assert_true(std::all_of(x.begin(), x.end(), [](double v) { return v == 0.0; }));
  assert_false(s.solve(right_hand_side(0), 1e-6, 0, x));
  s.k[3] = std::nan("");
  s.gradients.forget(unknowns);
  assert_false(s.solve(right_hand_side(0), 1e-6, 20, x));
}

}  // namespace
