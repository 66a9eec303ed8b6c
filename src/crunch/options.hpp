// Options of jam_crunch: defaults and what is refused.
#pragma once
#include "core/packing.hpp"
#include "jam/jam.h"

namespace jam::inside {

jam_crunch_options default_crunch_options();
// Throws for options that make no sense and for packings that cannot be crunched.
void check_options(const Packing &p, const jam_crunch_options &o);

}  // namespace jam::inside
