// Equations of state in closed form and the fit of the glass branch.
#pragma once
#include <cstddef>

#include "jam/jam.h"

namespace jam::inside {

double equation_of_state(int32_t form, int32_t dim, double fraction, double jammed_fraction);
jam_glass fit_glass(const double *fraction, const double *pressure, size_t count);

}  // namespace jam::inside
