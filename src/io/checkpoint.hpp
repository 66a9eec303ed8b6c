// The whole state of a packing in a binary file.
#pragma once
#include "core/packing.hpp"

namespace jam {

void write_checkpoint(const Packing &p, const char *path);
Packing read_checkpoint(const char *path);

}  // namespace jam
