#include "dynamics/equation_of_state.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/math.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

namespace {

// B_{n+2} / B_2^{n+1}, n = 1 .. 8: Clisby and McCoy, J. Stat. Phys. 122, 15 (2006), table 1. The first two are exact;
// the others are known to 1e-8 .. 1e-5 of B_2^{n+1}.
constexpr int virial_known = 8, virial_dims = 7;
constexpr double virial_table[virial_dims][virial_known] = {
    {0.782004438, 0.53223180, 0.33355604, 0.1988425, 0.1148728, 0.0649930, 0.0362193, 0.0199537},
    {0.625, 0.2869495, 0.110252, 0.03888198, 0.01302354, 0.0041832, 0.0013094, 0.0004035},
    {0.506339990, 0.15184606, 0.0357041, 0.0077359, 0.0014303, 0.0002888, 0.0000441, 0.0000113},
    {0.4140625, 0.0759724807, 0.0129551, 0.0009815, 0.0004162, -0.0001120, 0.0000747, -0.0000492},
    {0.340941322, 0.03336314, 0.0075231, -0.0017385, 0.0013066, -0.0008950, 0.0006673, -0.000525},
    {0.2822265625, 0.00986494662, 0.0070724, -0.0035121, 0.0025386, -0.0019937, 0.0016869, -0.001514},
    {0.234613606, -0.00255768, 0.00743092, -0.0045164, 0.0034149, -0.0028624, 0.0025969, -0.002511},
};
static_assert(virial_dims == JAM_MAX_DIM - 1, "a row of virial coefficients for each dimension");

// Pade approximant [4/5] of the series sum c_k x^k, k = 0 .. 9. The denominator 1 + sum q_j x^j, j = 1 .. 5, is that
// for which the terms x^5 .. x^9 of its product with the series vanish. [4/5] has no pole in the liquid in any
// dimension; [5/4] has one in d = 7, with a zero beside it.
struct Pade {
  static constexpr int numerator = 4, denominator = 5, terms = numerator + denominator + 1;
  double p[numerator + 1], q[denominator + 1];
  explicit Pade(const double (&c)[terms]) {
    double rows[denominator][denominator + 1];
    for (int r = 0; r < denominator; ++r) {
      for (int j = 1; j <= denominator; ++j) rows[r][j - 1] = c[numerator + 1 + r - j];
      rows[r][denominator] = -c[numerator + 1 + r];
    }
    for (int k = 0; k < denominator; ++k) {  // elimination with row pivots
      int pivot = k;
      for (int r = k + 1; r < denominator; ++r)
        if (std::fabs(rows[r][k]) > std::fabs(rows[pivot][k])) pivot = r;
      std::swap(rows[k], rows[pivot]);
      for (int r = 0; r < denominator; ++r) {
        const double factor = r == k ? 0.0 : rows[r][k] / rows[k][k];
        for (int j = k; j <= denominator; ++j) rows[r][j] -= factor * rows[k][j];
      }
    }
    q[0] = 1.0;
    for (int j = 1; j <= denominator; ++j) q[j] = rows[j - 1][denominator] / rows[j - 1][j - 1];
    for (int k = 0; k <= numerator; ++k) {
      p[k] = 0.0;
      for (int j = 0; j <= k; ++j) p[k] += q[j] * c[k - j];
    }
  }
  static double horner(const double *c, int degree, double x) {
    double sum = 0.0;
    for (int k = degree; k >= 0; --k) sum = sum * x + c[k];
    return sum;
  }
  // Numerator and denominator of the slope, and the denominator itself, are polynomials: both change sign only at a
  // pole or at a maximum.
  bool rises(double x) const {
    double above = 0.0, slope_above = 0.0, below = 0.0, slope_below = 0.0;
    for (int k = numerator; k >= 0; --k) slope_above = slope_above * x + above, above = above * x + p[k];
    for (int k = denominator; k >= 0; --k) slope_below = slope_below * x + below, below = below * x + q[k];
    return below > 0.0 && slope_above * below > above * slope_below;
  }
  double at(double x) const { return horner(p, numerator, x) / horner(q, denominator, x); }
  // Where the first pole or maximum comes before x, and x itself where none does.
  double range(double x) const {
    constexpr int parts = PadeTuning::parts;
    for (int k = 1; k <= parts; ++k) {
      double high = x * k / parts, low = high - x / parts;
      if (rises(high)) continue;
      for (int halving = 0; halving < PadeTuning::halvings; ++halving)
        (rises(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
      return low;
    }
    return x;
  }
};

// x = B_2 rho = 2^(d-1) phi.
double pade_pressure(int32_t dim, double f) {
  double c[Pade::terms] = {1.0, 1.0};
  for (int n = 0; n < virial_known; ++n) c[n + 2] = virial_table[dim - 2][n];
  const Pade pade(c);
  const double x = std::ldexp(f, dim - 1), range = pade.range(x);
  if (range < x)
    fail(JAM_E_ARGUMENT,
         "packing_fraction is %g: in d = %d the pressure of this equation of state of the liquid rises only up to "
         "%.4g, its pole or maximum",
         f, dim, std::ldexp(range, 1 - dim));
  return pade.at(x);
}

}  // namespace

double equation_of_state(int32_t form, int32_t dim, double f, double jammed) {
  if (dim < 2 || dim > JAM_MAX_DIM) fail(JAM_E_DIMENSION, "dim is %d, supported are 2..%d", dim, JAM_MAX_DIM);
  if (!(f >= 0.0) || !std::isfinite(f)) fail(JAM_E_ARGUMENT, "packing_fraction is %g, it must be >= 0 and finite", f);
  const bool closed_3d = form >= JAM_EOS_CARNAHAN_STARLING && form <= JAM_EOS_VIRIAL;
  if (closed_3d && dim != 3) fail(JAM_E_UNSUPPORTED, "this equation of state is of d = 3, dim is %d", dim);
  const bool disks = form == JAM_EOS_HENDERSON;
  if (disks && dim != 2) fail(JAM_E_UNSUPPORTED, "this equation of state is of d = 2, dim is %d", dim);
  if ((disks || form == JAM_EOS_PADE || (closed_3d && form != JAM_EOS_VIRIAL)) && f >= 1.0)
    fail(JAM_E_ARGUMENT, "packing_fraction is %g, it must be below 1", f);
  switch (form) {
    case JAM_EOS_CARNAHAN_STARLING:
      return (1 + f + f * f - f * f * f) / math::pow(1 - f, 3);
    case JAM_EOS_PY_VIRIAL:
      return (1 + 2 * f + 3 * f * f) / ((1 - f) * (1 - f));
    case JAM_EOS_PY_COMPRESSIBILITY:
      return (1 + f + f * f) / math::pow(1 - f, 3);
    case JAM_EOS_VIRIAL:
      return 1 + f * (4 + f * (10 + f * (18.365 + f * (28.224 + f * (39.82 + f * 53.34)))));
    case JAM_EOS_MK:
      return 1 + std::ldexp(f, dim - 1);
    case JAM_EOS_FREE_VOLUME:
      if (!(jammed > f))
        fail(JAM_E_ARGUMENT, "jammed_fraction is %g, it must be above the packing fraction %g", jammed, f);
      return dim / (1 - f / jammed);
    case JAM_EOS_HENDERSON:  // Mol. Phys. 30, 971 (1975)
      return (1 + f * f / 8) / ((1 - f) * (1 - f));
    case JAM_EOS_PADE:
      return pade_pressure(dim, f);
    default:
      fail(JAM_E_ARGUMENT, "form is %d, not a jam_eos_form", form);
  }
}

// Straight line 1/p = c + b (phi - mean phi): centred, as near jamming phi changes in its last digits only.
jam_glass fit_glass(const double *fraction, const double *pressure, size_t count) {
  if (count < 3) fail(JAM_E_TOO_FEW, "%zu points, a fit with errors needs 3", count);
  const double m = static_cast<double>(count);
  double mean_x = 0.0, mean_y = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0, residual = 0.0;
  for (size_t k = 0; k < count; ++k) {
    if (!(pressure[k] > 0.0) || !std::isfinite(pressure[k]))
      fail(JAM_E_ARGUMENT, "pressure[%zu] is %g, it must be positive", k, pressure[k]);
    if (!(fraction[k] > 0.0) || !std::isfinite(fraction[k]))
      fail(JAM_E_ARGUMENT, "fraction[%zu] is %g, it must be positive", k, fraction[k]);
    mean_x += (fraction[k] - fraction[0]) / m;
    mean_y += 1.0 / pressure[k] / m;
  }
  for (size_t k = 0; k < count; ++k) {
    const double x = fraction[k] - fraction[0] - mean_x, y = 1.0 / pressure[k] - mean_y;
    sxx += x * x, sxy += x * y, syy += y * y;
  }
  if (!(sxx > 0.0) || !(sxy < 0.0))
    fail(JAM_E_ARGUMENT, "1/pressure does not fall with the packing fraction: no glass branch");
  const double b = sxy / sxx;
  for (size_t k = 0; k < count; ++k) {
    const double r = 1.0 / pressure[k] - mean_y - b * (fraction[k] - fraction[0] - mean_x);
    residual += r * r;
  }
  const double variance = residual / (m - 2.0), distance = -mean_y / b;
  jam_glass g{};
  g.struct_size = sizeof g;
  g.jammed_fraction = fraction[0] + mean_x + distance;
  g.jammed_error = std::sqrt(variance * (1.0 / m + distance * distance / sxx)) / std::fabs(b);
  g.dimension = -1.0 / (b * g.jammed_fraction);
  // d' = 1 / a, with a the intercept at fraction 0, whose variance is that of a line's value there.
  const double mean = fraction[0] + mean_x;
  g.dimension_error = g.dimension * g.dimension * std::sqrt(variance * (1.0 / m + mean * mean / sxx));
  g.r_squared = 1.0 - residual / syy;
  return g;
}

}  // namespace jam::inside
