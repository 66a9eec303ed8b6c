// The whole state of a packing in a binary file.
#pragma once
#include <string>

#include "core/packing.hpp"

namespace jam {

// What was under way: one of them, or nothing.
struct Unfinished {
  std::string stage;    // bytes of a paused stage of dynamics
  bool crunch = false;  // the packing is a state that a crunch went through
};
void write_checkpoint(const Packing &p, const Unfinished &work, const char *path);
Packing read_checkpoint(const char *path, Unfinished &work);

}  // namespace jam
