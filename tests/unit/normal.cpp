// The normal distribution: shares and quantiles are right to 1e-15.
#include <cfloat>
#include <cmath>
#include "test.h"

#include "core/math.hpp"

using namespace jam::inside;

namespace {

// The reference is the long double error function of the C library.
long double share_below(long double x) { return 0.5L * std::erfc(-x / std::sqrt(2.0L)); }

CASE(shares_are_those_of_the_error_function) {
  if (LDBL_MANT_DIG < 64) skip();
  double worst = 0.0;
  for (int k = -3700; k <= 900; ++k) {
    const double x = 0.01 * k;
    const long double exact = share_below(x);
    worst = std::fmax(worst, static_cast<double>(std::fabs(math::normal_share(x) / exact - 1.0L)));
  }
  if (!(worst < 1e-15)) fail_msg("shares are off by %g", worst);
  assert_true(math::normal_share(-INFINITY) == 0.0 && math::normal_share(INFINITY) == 1.0);
  assert_true(std::isnan(math::normal_share(NAN)));
}

// One step of Newton's method from the quantile is its error.
CASE(quantiles_invert_shares) {
  if (LDBL_MANT_DIG < 64) skip();
  double worst = 0.0;
  for (int k = 1; k < 4000; ++k) {
    const double share = k < 2000 ? std::pow(10.0, -0.15 * k) : (k - 2000) / 4000.0;
    if (!(share > DBL_MIN)) continue;
    const double x = math::normal_quantile(share);
    const long double density = std::exp(-0.5L * x * x) / std::sqrt(2.0L * std::acos(-1.0L));
    worst = std::fmax(worst, static_cast<double>(std::fabs((share_below(x) - share) / density / x)));
  }
  if (!(worst < 1e-15)) fail_msg("quantiles are off by %g", worst);
  assert_true(math::normal_quantile(0.5) == 0.0);
  assert_true(math::normal_quantile(0.0) == -INFINITY && math::normal_quantile(1.0) == INFINITY);
  assert_true(std::isnan(math::normal_quantile(-0.1)) && std::isnan(math::normal_quantile(NAN)));
  for (double share = 0.01; share < 0.5; share += 0.0078125)
    assert_true(std::fabs(math::normal_quantile(share) + math::normal_quantile(1.0 - share)) < 1e-13);
}

}  // namespace
