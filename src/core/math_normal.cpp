// The normal distribution: share below x, and its inverse.
#include <cmath>
#include <limits>

#include "core/double_double.hpp"
#include "core/math.hpp"

namespace jam::inside::math {
namespace {

template <int N>
double polynomial(const double (&c)[N], double x) {
  double sum = c[N - 1];
  for (int k = N - 2; k >= 0; --k) sum = sum * x + c[k];
  return sum;
}

// Share above x >= 0, exp(x^2 / 2) times it over t, as Chebyshev polynomials of 2 t - 1 with t = 1 / (1 + x / 3). The
// coefficients are sums over 64 nodes in 40 digits; those left out are below 1e-17.
double share_above(double x) {
  static constexpr double c[] = {
      0.28014513209581043,     0.1803080238567641,      0.036724151860193656,    0.0033113857822765044,
      -0.00038566487334868496, -0.0001135592894502217,  7.066641184040327e-06,   3.910623515168097e-06,
      -3.272157761237392e-07,  -1.4590723518077845e-07, 2.3079842620073667e-08,  4.949050381172641e-09,
      -1.6135145151322574e-09, -7.344108538614433e-11,  9.66396098315389e-11,    -9.578345130569536e-12,
      -4.171946164095964e-12,  1.279043216134737e-12,   3.2327989444889684e-14,  -8.872914770403279e-14,
      1.564546243382855e-14,   2.760282975003863e-15,   -1.7019056243510227e-15, 1.92143259137419e-16,
      7.902114143320473e-17,   -3.383872681983852e-17,
  };
  constexpr int n = sizeof c / sizeof *c;
  const double t = 3.0 / (3.0 + x), y = 2.0 * t - 1.0;
  double now = 0.0, before = 0.0;  // Clenshaw's recurrence
  for (int k = n - 1; k > 0; --k) {
    const double next = 2.0 * y * now - before + c[k];
    before = now;
    now = next;
  }
  const DoubleDouble square = two_product(x, 0.5 * x);
  return math::exp(-square.high) * (1.0 - square.low) * t * (y * now - before + c[0]);
}

}  // namespace

double normal_share(double x) {
  if (x != x) return x;
  if (x < 0.0) return x < -40.0 ? 0.0 : share_above(-x);
  return x > 40.0 ? 1.0 : 1.0 - share_above(x);
}

double normal_quantile(double share) {
  static constexpr double a[] = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                                 1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                                 3.3430575583588128105e4, 2.5090809287301226727e3};
  static constexpr double b[] = {1.0,
                                 4.2313330701600911252e1,
                                 6.8718700749205790830e2,
                                 5.3941960214247511077e3,
                                 2.1213794301586595867e4,
                                 3.9307895800092710610e4,
                                 2.8729085735721942674e4,
                                 5.2264952788528545610e3};
  static constexpr double c[] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                                 3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                                 2.27238449892691845833e-2, 7.74545014278341407640e-4};
  static constexpr double d[] = {1.0,
                                 2.05319162663775882187e0,
                                 1.67638483018380384940e0,
                                 6.89767334985100004550e-1,
                                 1.48103976427480074590e-1,
                                 1.51986665636164571966e-2,
                                 5.47593808499534494600e-4,
                                 1.05075007164441684324e-9};
  static constexpr double e[] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                                 2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                 2.71155556874348757815e-5, 2.01033439929228813265e-7};
  static constexpr double f[] = {1.0,
                                 5.99832206555887937690e-1,
                                 1.36929880922735805310e-1,
                                 1.48753612908506148525e-2,
                                 7.86869131145613259100e-4,
                                 1.84631831751005468180e-5,
                                 1.42151175831644588870e-7,
                                 2.04426310338993978564e-15};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!(share > 0.0 && share < 1.0))
    return share == 0.0 ? -infinity : share == 1.0 ? infinity : std::numeric_limits<double>::quiet_NaN();
  const double q = share - 0.5;
  if (std::fabs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(a, r) / polynomial(b, r);
  }
  const double r = std::sqrt(-math::log(q < 0.0 ? share : 1.0 - share));
  const double x =
      r <= 5.0 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6) : polynomial(e, r - 5.0) / polynomial(f, r - 5.0);
  return q < 0.0 ? -x : x;
}

}  // namespace jam::inside::math
