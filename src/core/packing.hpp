// The state that every layer works on: spheres in a periodic cell or a container.
#pragma once
#include <cstddef>
#include <limits>
#include "core/container.hpp"

namespace jam::inside {

// A pair of the Mari-Kurchan model whose shift was drawn again; i < j.
struct MkRedrawn {
  int32_t i, j, attempt;
};

// Numbers are multiples of a step, as wide as a unit of the last digit that they have.
struct GivenDigits {
  double step = 0.0;  // a length; 0: all digits of a double
  int base = 0;       // 10 or 2: decimal digits, or bits as of single precision
  void take(const GivenDigits &other) {
    if (other.step > step) *this = other;
  }
};

struct Packing {
  int dim = 3;
  Cell cell;
  Container container;  // none: the cell repeats along all axes
  int64_t seed = 1;
  int32_t model = JAM_MODEL_EUCLID;
  int32_t masses = JAM_MASSES_EQUAL;
  double mk_zeta = std::numeric_limits<double>::infinity();
  double non_additivity = 0.0;        // Delta of a non-additive mixture (core/pair_rule.hpp)
  std::vector<MkRedrawn> mk_redrawn;  // sorted; all other pairs have attempt 0 (core/pair_rule.hpp)
  std::vector<double> wall_pressure;  // of each wall, reduced; empty before MD
  std::vector<double> position;       // (n, dim), in the brick of the cell
  std::vector<double> diameter;       // n
  std::vector<double> velocity;       // (n, dim), kT/m = 1; all zero until MD draws them
  double pressure = std::numeric_limits<double>::quiet_NaN();  // last measured by MD
  GivenDigits given;  // of the numbers that positions, diameters and cell were given by; moves leave none
  bool has_velocity = false;
  bool overlap_allowed = false;  // soft spheres: JAM_OVERLAP_ALLOW at creation

  size_t n() const { return diameter.size(); }
  void set_cube(int d, double side) { dim = d, cell = Cell(d, side); }
};

// Volume of a sphere of unit diameter: pi^(d/2) (1/2)^d / Gamma(1 + d/2).
double unit_sphere_volume(int dim);
double packing_fraction(const Packing &p);
double diameter_mean(const Packing &p);
double diameter_max(const Packing &p);
// Mass of each sphere, mean 1; empty when all are equal.
std::vector<double> sphere_masses(const Packing &p);
// Puts every sphere back into the brick of the cell.
void wrap_positions(Packing &p);

}  // namespace jam::inside
