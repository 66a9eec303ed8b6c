// What LAMMPS calls the box: one place for its data files and its dumps.
#pragma once
#include <array>
#include <string>

#include "core/packing.hpp"

namespace jam {

// The cell vectors are (x, 0, 0), (xy, y, 0), (xz, yz, z): our lower triangle. In d = 2 z goes from -1/2 to 1/2 of
// V^(1/2), and all spheres lie at z = 0.
struct LammpsBox {
  std::array<double, 3> low{}, high{}, tilt{};  // tilt: xy, xz, yz
  bool tilted = false;
};
// JAM_E_UNSUPPORTED but in d = 2 and 3. format: its name in the error.
LammpsBox lammps_box(const Packing &p, const char *format);

}  // namespace jam
