// Sums over all spheres: as exact for very many as for one.
#include <cmath>
#include "test.h"

#include "core/packing.hpp"

using namespace jam::inside;

namespace {

// Of n equal spheres the mean diameter is the diameter, and the packing fraction is n times that of one. Diameters
// without a short binary form, in numbers where sums in double lose three digits.
CASE(sums_over_many_spheres_keep_their_digits) {
  for (const int dim : {2, 3, 5})
    for (const size_t n : {1000u, 65536u, 300007u})
      for (const double sigma : {0.01 / 3.0, 0.0265854627236561}) {
        Packing one, p;
        p.set_cube(dim, 1.3), one.set_cube(dim, 1.3);
        one.diameter = {sigma};
        p.diameter.assign(n, sigma);
        p.position.assign(n * dim, 0.5), one.position.assign(dim, 0.5);
        assert_true(std::fabs(diameter_mean(p) / sigma - 1.0) < 3e-16);
        assert_true(std::fabs(packing_fraction(p) / (static_cast<double>(n) * packing_fraction(one)) - 1.0) < 5e-16);
      }
}

}  // namespace
