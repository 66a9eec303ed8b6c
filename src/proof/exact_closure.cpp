#include "proof/exact_closure.hpp"

#include <algorithm>
#include <cmath>

namespace jam::inside {
namespace {

Expansion squared_distance(const ProofScene &s, size_t c) {
  Expansion sum;
  for (int k = 0; k < s.dim; ++k) {
    const Expansion r = s.component(c, k);
    sum.add_product(r, r);
  }
  return sum;
}

}  // namespace

bool close_exactly(ProofScene &s) {
  if (s.contacts() == 0 || s.rooted()) return false;
  // Gamma = |r|^2 / sigma^2 of the first contact, where that is a sum of two doubles.
  const Expansion square = squared_distance(s, 0), sigma2 = s.sigma_squared(size_t{0});
  int exponent = 0;
  if (sigma2.count() != 1 || std::frexp(sigma2.part(0), &exponent) != 0.5 || square.count() > 2) return false;
  const double unit = std::ldexp(1.0, 1 - exponent);
  const double high = square.count() > 0 ? square.part(square.count() - 1) * unit : 0.0;
  const double low = square.count() == 2 ? square.part(0) * unit : 0.0;
  if (!(high > 0.0)) return false;
  Expansion gamma(high);
  gamma.add(low);
  for (size_t c = 0; c < s.contacts(); ++c) {
    Expansion f = squared_distance(s, c);
    f.add_product(gamma, s.sigma_squared(c), -1.0);
    if (f.count() != 0) return false;
  }
  s.growth = high, s.growth_low = low;
  return true;
}

void equal_forces(ProofScene &s) {
  const auto [least, most] = std::minmax_element(s.force.begin(), s.force.end());
  if (*most - *least < 1e-9 * *most) std::fill(s.force.begin(), s.force.end(), s.force[0]);
}

}  // namespace jam::inside
