// The whole state of a packing in a binary file.
#pragma once
#include <string>

#include "core/packing.hpp"

namespace jam::inside {

// beside: bytes of the results and of the unfinished work of that packing (capi/results_archive.cpp).
void write_checkpoint(const Packing &p, const std::string &beside, const char *path);
Packing read_checkpoint(const char *path, std::string &beside);

}  // namespace jam::inside
