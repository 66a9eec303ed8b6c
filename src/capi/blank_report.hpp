// Reports of calls that were stopped before they had made anything: measured numbers are NaN, counts of what was never
// searched for -1, and the packing fraction is that of the state. Work done is 0, which is true.
#pragma once
#include <cmath>

#include "capi/system.hpp"

namespace jam::inside {

inline void set_blank(const SystemState &s, jam_md_report &r) {
  r = {};
  r.pressure = r.pressure_error = r.energy_drift = r.max_overlap = r.growth_rate = r.collisions_per_second = NAN;
  r.packing_fraction = s.packing_fraction;
}
inline void set_blank(const SystemState &s, jam_monte_carlo_report &r) {
  r = {};
  r.next_sweep = s.sweeps;
  r.acceptance = r.swap_acceptance = r.step = r.energy = r.energy_error = r.pressure = r.pressure_error =
      r.trials_per_second = NAN;
}
inline void set_blank(const SystemState &, jam_isoconf_report &r) {
  r = {};
  r.energy_drift = r.max_overlap = r.step = r.acceptance = NAN;
}
inline void set_blank(const SystemState &s, jam_relax_report &r) {
  r = {};
  r.force_residual = r.energy = r.pressure = r.distance = r.jammed_fraction = r.coordination = r.mean_overlap =
      r.max_overlap = r.stress_residual = NAN;
  r.packing_fraction = s.packing_fraction;
  r.contacts = r.stable = r.rattlers = -1;
}
inline void set_blank(const SystemState &s, jam_decompress_report &r) {
  r = {};
  r.same_network = -1;
  r.force_residual = r.energy = r.pressure = r.distance = r.jammed_fraction = r.crunch_fraction = r.force_difference =
      r.coordination = NAN;
  r.packing_fraction = s.packing_fraction;
  r.contacts = r.common_contacts = r.rattlers = -1;
}
inline void set_blank(const SystemState &s, jam_radii_report &r) {
  r = {};
  r.value = r.balance_residual = r.max_contact_gap = r.min_gap = r.min_force = r.radius_smallest = r.radius_largest =
      r.polydispersity = NAN;
  r.packing_fraction = s.packing_fraction;
  r.contacts = r.rattlers = r.at_bounds = r.excess = -1;
}
inline void set_blank(const SystemState &s, jam_shear_report &r) {
  r = {};
  r.strain = r.stress = r.pressure = r.energy = r.first_event = r.peak_stress = r.peak_strain = NAN;
  r.packing_fraction = s.packing_fraction;
  r.contacts = r.rattlers = -1;
}

}  // namespace jam::inside
