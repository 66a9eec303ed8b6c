// The whole state of a packing in a binary file.
#pragma once
#include <string>

#include "core/packing.hpp"

namespace jam {

// stage: bytes of a paused stage, or empty.
void write_checkpoint(const Packing &p, const std::string &stage, const char *path);
Packing read_checkpoint(const char *path, std::string &stage);

}  // namespace jam
