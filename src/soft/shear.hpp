// Quasi-static shear: a packing follows its minimum while its cell is strained. Data flow:
//   minimum -> affine strain -> minimum -> work against energy -> halved steps around what does not add up -> rows
// The minimum is that of soft spheres, or the jamming point of hard ones; both come as a function from outside.
#pragma once
#include <string>

#include "soft/decompression.hpp"

namespace jam::inside {

// A minimum on the way. Its enthalpy is U + P V, or of hard spheres V over their own volume: P = 1 and lengths in
// diameters.
struct ShearPoint {
  SoftResult at;  // of hard spheres: packing, contacts, packing fraction and rattlers; status of the search
  jam_crunch_report crunch{};  // of hard spheres alone
  int32_t stop_reason = JAM_STOP_NONE;
  std::string why;     // there is no minimum, where status and stop_reason do not say it
  bool found = false;  // a minimum; else status and stop_reason say why not
  bool rigid = false;  // contacts carry force
  double enthalpy = 0.0, volume = 0.0, confining = 0.0;  // confining: P where the volume is free, else 0
  std::vector<double> stress;                            // (dim, dim), in units of d enthalpy / d volume
  std::vector<double> strain;                            // (dim, dim), of a free cell, by the minimiser
};
using FindMinimum = std::function<ShearPoint(const Packing &, bool first)>;

constexpr size_t shear_columns = JAM_SHEAR_FACTORISATIONS + 1;
using ShearRow = std::array<double, shear_columns>;

struct ShearResult {
  ShearPoint last;  // the last minimum
  std::vector<ShearRow> rows;
  jam_shear_report report{};
  jam_status status = JAM_OK;
  std::string why;  // of a status above 0, where the stop reason does not say it
};

// Where to: an upper-triangular strain of unit amplitude (dim, dim), and the amplitudes at which the shear turns; it
// ends at the last.
struct ShearPath {
  std::vector<double> mode;
  std::vector<double> stress;  // (dim, dim), that free components are to hold; empty: the pressure of the options
  std::vector<double> turns;
};

jam_shear_options default_shear_options();
void check_shear_options(const jam_shear_options &o, const ShearPath &path);
// Simple shear, x moves with y, for an empty mode. Numbers behind the mode are the stress.
// exp(amplitude mode) - 1.
std::vector<double> finite_strain(const std::vector<double> &mode, double amplitude, int dim);
ShearPath shear_path(int dim, const double *mode, size_t mode_len, const double *turns, size_t turns_len);

// Minima of soft spheres for these options.
FindMinimum soft_minimum(const jam_shear_options &o, const ShearPath &path, Effort &effort, Monitor &monitor);

ShearResult shear(const Packing &start, const jam_shear_options &o, const ShearPath &path, const FindMinimum &minimum,
                  Effort &effort, Monitor &monitor);

}  // namespace jam::inside
