// The whole state of a packing in a binary file.
#pragma once
#include <string>

#include "core/packing.hpp"

namespace jam {

// What was under way.
struct Unfinished {
  std::string stage;    // bytes of a paused stage; empty: nothing
  bool crunch = false;  // it is one of a crunch, not of dynamics
};
void write_checkpoint(const Packing &p, const Unfinished &work, const char *path);
Packing read_checkpoint(const char *path, Unfinished &work);

}  // namespace jam
