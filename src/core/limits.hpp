// Every limit of libjam's input, in one place. The table "Limits" at the head of jam.h states the same numbers for
// users; every entrance checks through the functions below, so that an error names the quantity and its value.
#pragma once
#include <cmath>

#include "core/error.hpp"
#include "core/packing.hpp"

namespace jam::inside {

namespace limits {

constexpr int64_t n_max = INT32_MAX;
constexpr double box_min = 1e-30, box_max = 1e30;  // the eighth power and its inverse are doubles
constexpr double cell_height_min = 1e-3;           // distance of two faces over V^(1/d), after reduction
constexpr double diameter_min = 1e-9;              // over the longest cell edge: coordinates resolve 1e-16 of it
constexpr double size_ratio_max = 1e4;             // largest diameter over smallest
constexpr double non_additivity_max = 1.0;         // and above -1: contact distances are positive
constexpr double mk_zeta_max = 1e15;               // strength of shifts, or infinity: draws of 53 bits keep a fraction
constexpr double radius_max = 1e3;                 // radii of pair searches, mean diameters
constexpr double images_max = 1e6;  // of one pair in Monte Carlo: a checkpoint's cell may be far from reduced
// Of molecular dynamics, dimensionless. Between two collisions slower growth is below the rounding of diameters.
constexpr double growth_rate_min = 1e-15, growth_rate_max = 1e3;
// Root of sum m v^2 / (d n), unless all spheres rest: no dynamics at constant energy passes the largest. Below 1e-12
// paths no longer scale with the velocities, below 1e-21 spheres overlap.
constexpr double velocity_min = 1e-9, velocity_max = 1e6;
constexpr double wave_max = 1e6;  // component of a wave vector: whole turns are taken off without loss
// Of two soft spheres at one place; temperatures and pressures: squares of energies and forces are doubles.
constexpr double energy_min = 1e-100, energy_max = 1e100;
constexpr double exponent_max = 1e3;  // of the energy in Monte Carlo
// Of an energy that is minimised. Squares of forces are doubles, also where overlaps are this part of a diameter.
constexpr double minimised_exponent_max = 12.0, weak_overlap = 1e-12, weak_force = 1e-150;
constexpr double move_min = 0x1p-54;                 // Monte Carlo step over the box side: places have 64 bits
constexpr double size_min = 1e-39, size_max = 1e36;  // diameters without a cell: their eighth powers are doubles
constexpr double size_power_max = 600.0;             // logarithm of what s^exponent changes by between two sizes
constexpr double stiffness_min = 1e-60, stiffness_max = 1e60;  // of contacts, as powers of their forces
constexpr double distance_min = 1e-15;  // ends of histograms, in diameters: coordinates resolve no less
constexpr double rounding = 1e-9;       // a limit that the library's own steps may exceed, relative
constexpr double duality_gap_min = 1e-12, duality_gap_max = 1e-2;  // at which a crunch may end
constexpr int threads_max = 64;                                    // of one call
constexpr int keep_steps_max = 1000;                               // states of a crunch that are kept
constexpr int64_t kept_coordinates = 1 << 24;  // in all kept states: 64 MiB, and 90 MB in the file of a page

}  // namespace limits

// Throws JAM_E_ARGUMENT "NAME is VALUE, supported are LOW..HIGH" unless low <= value <= high; NaN is refused.
void check_range(const char *name, double value, double low, double high);
// The energy of two soft spheres at one place; `name` and `value`: what to change.
void check_energy(const char *name, double value, double energy);
// Throws JAM_E_DIMENSION or JAM_E_ARGUMENT.
void check_dim(int64_t dim);
void check_n(int64_t n);
void check_box(double box);
void check_non_additivity(double delta);
// Strength of the shifts of the Mari-Kurchan model.
inline bool is_mk_zeta(double zeta) { return zeta >= 0.0 && (zeta <= limits::mk_zeta_max || std::isinf(zeta)); }
// The smallest diameter in the cell, and the ratio of the largest to it. That no sphere is wider than the cell is a
// question of overlaps (core/create.hpp).
void check_diameters(const std::vector<double> &diameter, const Cell &cell);
// Throws `code` where the spheres are too fast. Light spheres among heavy ones may be as fast as their masses ask.
void check_velocities(const Packing &p, const std::vector<double> &velocity, jam_status code);

// Checks of options. Each throws JAM_E_ARGUMENT with the option's name and value.

// NaN is refused by all.
inline void check_positive(double value, const char *name) {
  if (!(value > 0.0)) fail(JAM_E_ARGUMENT, "%s is %g, it must be positive", name, value);
}
inline void check_positive_finite(double value, const char *name) {
  if (!(value > 0.0) || std::isinf(value))
    fail(JAM_E_ARGUMENT, "%s is %g, it must be positive and finite", name, value);
}
inline void check_not_negative(double value, const char *name) {
  if (!(value >= 0.0)) fail(JAM_E_ARGUMENT, "%s is %g, it must be >= 0", name, value);
}
inline void check_at_least(int64_t value, int64_t least, const char *name) {
  if (value < least)
    fail(JAM_E_ARGUMENT, "%s is %lld, it must be at least %lld", name, static_cast<long long>(value),
         static_cast<long long>(least));
}
inline void check_flag(int32_t value, const char *name) {
  if (value != 0 && value != 1) fail(JAM_E_ARGUMENT, "%s is %d, it must be 0 or 1", name, value);
}
inline void check_threads(int32_t threads) {
  if (threads < 1 || threads > limits::threads_max)
    fail(JAM_E_ARGUMENT, "threads is %d, it must be 1 .. %d", threads, limits::threads_max);
}
// Values of an enum follow each other from first to last; `type` is its name in jam.h.
inline void check_enum(int32_t value, int32_t first, int32_t last, const char *name, const char *type) {
  if (value < first || value > last) fail(JAM_E_ARGUMENT, "%s is %d, not a %s", name, value, type);
}

}  // namespace jam::inside
