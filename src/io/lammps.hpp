// What LAMMPS calls the box: one place for its data files and its dumps.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "core/packing.hpp"

namespace jam::inside {

// How the titles of our data files begin. Such a file has no place for walls but its title, where LAMMPS takes any
// text.
constexpr std::string_view lammps_title = "LAMMPS data file by libjam";

// The cell vectors are (x, 0, 0), (xy, y, 0), (xz, yz, z): our lower triangle. In d = 2 z goes from -1/2 to 1/2 of
// V^(1/2), and all spheres lie at z = 0.
struct LammpsBox {
  std::array<double, 3> low{}, high{}, tilt{};  // tilt: xy, xz, yz
  bool tilted = false;
};
LammpsBox lammps_box(const Packing &p);  // of d = 2 and 3

}  // namespace jam::inside
