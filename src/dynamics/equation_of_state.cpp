#include "dynamics/equation_of_state.hpp"

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/math.hpp"

namespace jam {

double equation_of_state(int32_t form, int32_t dim, double f, double jammed) {
  if (dim < 2 || dim > JAM_MAX_DIM) fail(JAM_E_DIMENSION, "dim is %d, supported are 2..%d", dim, JAM_MAX_DIM);
  if (!(f >= 0.0) || !std::isfinite(f)) fail(JAM_E_ARGUMENT, "packing_fraction is %g, it must be >= 0 and finite", f);
  const bool closed_3d = form >= JAM_EOS_CARNAHAN_STARLING && form <= JAM_EOS_VIRIAL;
  if (closed_3d && dim != 3) fail(JAM_E_UNSUPPORTED, "this equation of state is of d = 3, dim is %d", dim);
  const bool disks = form == JAM_EOS_HENDERSON;
  if (disks && dim != 2) fail(JAM_E_UNSUPPORTED, "this equation of state is of d = 2, dim is %d", dim);
  if ((disks || (closed_3d && form != JAM_EOS_VIRIAL)) && f >= 1.0)
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
  g.dimension_error = g.dimension * std::sqrt(variance / sxx) / std::fabs(b);
  g.r_squared = 1.0 - residual / syy;
  return g;
}

}  // namespace jam
