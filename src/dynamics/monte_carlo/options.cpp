// Monte Carlo: the choice of an engine, and options.
#include "dynamics/monte_carlo/monte_carlo.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/cell_reduction.hpp"
#include "core/checks.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "core/with_dimension.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

// Compiled by copies of trials.cpp.in.
template <int D>
std::unique_ptr<MonteCarlo> make_monte_carlo_of(const Packing &p, const jam_monte_carlo_options &o, int64_t run);

double largest_monte_carlo_step(const Packing &p) {
  // Along a cell vector a step in a cube of that half side goes no farther than the share of it.
  const double far = p.cell.cube() ? 1.0 : std::sqrt(static_cast<double>(p.dim));
  return MonteCarloTuning::longest_step * search_cell(p).height_min() / far / diameter_mean(p);
}

std::unique_ptr<MonteCarlo> make_monte_carlo(const Packing &p, const jam_monte_carlo_options &o, int64_t run) {
  return with_dimension(p.dim, [&](auto d) { return make_monte_carlo_of<d>(p, o, run); });
}

// ---- options

jam_monte_carlo_options default_monte_carlo_options() {
  jam_monte_carlo_options o{};
  o.struct_size = sizeof o;
  o.energy_scale = o.temperature = 1.0;
  o.acceptance = 0.45;
  o.sweeps = 1000;
  o.first_sweep = -1;
  o.wall_time = std::numeric_limits<double>::infinity();
  return o;
}

void check_monte_carlo_options(const jam_monte_carlo_options &o) {
  if (o.alpha != 0.0 && !(o.alpha > 1.0 && o.alpha <= limits::exponent_max))
    fail(JAM_E_ARGUMENT, "alpha is %g, it must be 0 (hard spheres), or more than 1 and at most %g", o.alpha,
         limits::exponent_max);
  check_enum(o.energy_unit, JAM_ENERGY_LENGTH, JAM_ENERGY_RELATIVE, "energy_unit", "jam_energy_unit");
  check_range("energy_scale", o.energy_scale, limits::energy_min, limits::energy_max);
  check_range("temperature", o.temperature, limits::energy_min, limits::energy_max);
  if (!(o.step >= 0.0) || std::isinf(o.step)) fail(JAM_E_ARGUMENT, "step is %g, it must be 0 or positive", o.step);
  if (!(o.acceptance > 0.0 && o.acceptance < 1.0))
    fail(JAM_E_ARGUMENT, "acceptance is %g, it must be in (0, 1)", o.acceptance);
  if (!(o.swap_share >= 0.0 && o.swap_share < 1.0))
    fail(JAM_E_ARGUMENT, "swap_share is %g, it must be in [0, 1)", o.swap_share);
  check_at_least(o.sweeps, 1, "sweeps");
  check_at_least(o.run, 0, "run");
  if (o.first_sweep < -1) fail(JAM_E_ARGUMENT, "first_sweep is %lld", static_cast<long long>(o.first_sweep));
  check_positive(o.wall_time, "wall_time");
}

// Where the energy is still larger than the temperature by more, those of the accepted overlaps underflow.
static void check_energies(const Packing &p, const jam_monte_carlo_options &o) {
  const double overlap = o.energy_unit == JAM_ENERGY_RELATIVE ? 1.0 : contact_distance_max(p);
  const double energy = o.energy_scale * math::pow(overlap, o.alpha);
  check_energy("energy_scale", o.energy_scale, energy);
  if (!(energy <= limits::energy_max * o.temperature))
    fail(JAM_E_ARGUMENT, "temperature is %g: two spheres at one place have the energy %g, at most %g times as much",
         o.temperature, energy, limits::energy_max);
}

void check_monte_carlo(const Packing &p, const jam_monte_carlo_options &o) {
  if (p.model != JAM_MODEL_EUCLID) fail(JAM_E_UNSUPPORTED, "Monte Carlo has no quenched shifts (JAM_MODEL_MK)");
  const double largest = largest_monte_carlo_step(p);
  if (o.step > largest)
    fail(JAM_E_ARGUMENT, "step is %g mean diameters; in this cell the largest is %g", o.step, largest);
  const double least = limits::move_min * p.cell.side() / diameter_mean(p);
  if (o.step > 0.0 && o.step < least)
    fail(JAM_E_ARGUMENT, "step is %g mean diameters; places in this cell resolve steps from %g on", o.step, least);
  if (o.alpha != 0.0) check_energies(p, o);
  if (o.alpha == 0.0 && p.overlap_allowed) refuse_overlaps(p, overlap_of_rounding);
}

}  // namespace jam::inside
