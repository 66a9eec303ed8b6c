#include "core/limits.hpp"

#include <algorithm>

#include "core/create.hpp"
#include "core/with_dimension.hpp"

namespace jam::inside {

void check_range(const char *name, double value, double low, double high) {
  if (!(value >= low && value <= high)) fail(JAM_E_ARGUMENT, "%s is %g, supported are %g..%g", name, value, low, high);
}

void check_energy(const char *name, double value, double energy) {
  if (!(energy >= limits::energy_min && energy <= limits::energy_max))
    fail(JAM_E_ARGUMENT, "%s is %g: in this unit two spheres at one place have the energy %g, supported are %g..%g",
         name, value, energy, limits::energy_min, limits::energy_max);
}

void check_dim(int64_t dim) {
  if (dim < 2 || dim > JAM_MAX_DIM)
    fail(JAM_E_DIMENSION, "dim is %lld, supported are 2..%d", static_cast<long long>(dim), JAM_MAX_DIM);
  if (!is_compiled(dim))
    fail(JAM_E_DIMENSION, "dim is %lld, this build of libjam has %s (JAM_DIMENSIONS of CMake)",
         static_cast<long long>(dim), JAM_DIMENSIONS_TEXT);
}

void check_n(int64_t n) {
  if (n < 1 || n > limits::n_max) fail(JAM_E_ARGUMENT, "n is %lld, it must be in 1..2^31-1", static_cast<long long>(n));
}

// The side of a cell is a root of a product, and carries its rounding.
void check_box(double box) {
  constexpr double rounding = 1.0 + overlap_tolerance;
  if (!(box * rounding >= limits::box_min && box <= limits::box_max * rounding))
    fail(JAM_E_ARGUMENT, "box is %g, supported are %g..%g", box, limits::box_min, limits::box_max);
}

void check_non_additivity(double delta) {
  if (!(delta > -1.0 && delta <= limits::non_additivity_max))
    fail(JAM_E_ARGUMENT, "non_additivity is %g, it must be above -1 and at most %g", delta, limits::non_additivity_max);
}

void check_diameters(const std::vector<double> &diameter, const Cell &cell) {
  const auto [least, most] = std::minmax_element(diameter.begin(), diameter.end());
  double longest = 0.0;
  for (int c = 0; c < cell.dim(); ++c) longest = std::max(longest, cell.edge(c));
  if (!(*least >= limits::diameter_min * longest * (1.0 - limits::rounding)))
    fail(JAM_E_ARGUMENT,
         "diameters[%td] is %g, at least %g of the longest edge of the cell (%g) is supported: coordinates resolve "
         "1e-16 of it",
         least - diameter.begin(), *least, limits::diameter_min, longest);
  if (!(*most <= limits::size_ratio_max * *least * (1.0 + limits::rounding)))
    fail(JAM_E_ARGUMENT, "diameters[%td] is %g and diameters[%td] is %g: ratios up to %g are supported",
         most - diameter.begin(), *most, least - diameter.begin(), *least, limits::size_ratio_max);
}

void check_velocities(const Packing &p, const std::vector<double> &velocity, jam_status code) {
  constexpr double drift = 1e-6;  // of the energy, which rounding changes
  const std::vector<double> mass = sphere_masses(p);
  const size_t d = static_cast<size_t>(p.dim);
  double sum = 0.0;
  bool at_rest = true;
  for (size_t k = 0; k < velocity.size(); ++k) {
    sum += (mass.empty() ? 1.0 : mass[k / d]) * velocity[k] * velocity[k];
    at_rest = at_rest && velocity[k] == 0.0;
  }
  const double thermal = std::sqrt(sum / static_cast<double>(velocity.size()));
  if (!(thermal <= limits::velocity_max * (1.0 + drift) &&
        (at_rest || thermal >= limits::velocity_min * (1.0 - drift))))
    fail(code, "velocities: the root of sum m v^2 / (d n) is %g, from %g to %g is supported, or no motion at all",
         thermal, limits::velocity_min, limits::velocity_max);
}

}  // namespace jam::inside
