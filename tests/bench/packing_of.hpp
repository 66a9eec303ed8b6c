// The spheres of a handle as a Packing, for benchmarks that reach hidden parts. The handle is destroyed.
#pragma once
#include <cstdio>
#include <cstdlib>

#include "core/packing.hpp"
#include "jam/jam.h"

namespace jam::inside {

inline Packing packing_of(jam_system *sys) {
  Packing p;
  const double *x = nullptr, *s = nullptr;
  size_t nx = 0, ns = 0;
  jam_info info;
  info.struct_size = sizeof info;
  jam_get_info(sys, &info);
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &nx);
  jam_view(sys, JAM_VIEW_DIAMETERS, &s, &ns);
  p.set_cube(info.dim, info.box);
  p.position.assign(x, x + nx);
  p.diameter.assign(s, s + ns);
  p.velocity.assign(nx, 0.0);
  jam_destroy(sys);
  return p;
}

// From a file in any format that jam_read takes. Ends the program where that fails.
inline Packing packing_of(const char *path) {
  jam_system *sys = nullptr;
  if (jam_read(path, nullptr, nullptr, nullptr, &sys) < 0) {
    std::fprintf(stderr, "%s\n", jam_last_error());
    std::exit(1);
  }
  return packing_of(sys);
}

}  // namespace jam::inside
