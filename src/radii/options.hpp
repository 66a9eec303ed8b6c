// Options of jam_maximise_radii: defaults, what is refused, and what they name.
#pragma once
#include <vector>

#include "core/packing.hpp"
#include "jam/jam.h"
#include "radii/rows.hpp"

namespace jam::inside {

jam_radii_options default_radii_options();
// Throws JAM_E_... before any work.
void check_radii(const Packing &p, const jam_radii_options &o, const double *weights, size_t weights_len);
std::vector<double> exponents_of(const jam_radii_options &o);
RadiiBounds bounds_of(const Packing &p, const jam_radii_options &o);

}  // namespace jam::inside
