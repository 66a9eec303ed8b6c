// What follows from a Hessian without its modes: density of states, elastic moduli. And comparing packings.
#pragma once
#include <vector>
#include "analysis/stress.hpp"

namespace jam {

jam_dos_options default_dos_options();
struct DensityOfStates {
  std::vector<double> omega, density, error;
};
// Kernel polynomial method (Weisse et al., Rev. Mod. Phys. 78, 275 (2006)). JAM_OK or JAM_CANCELLED.
jam_status density_of_states(const StableGraph &g, const BlockMatrix &h, const jam_dos_options &o, Monitor &monitor, DensityOfStates &out);

jam_moduli elastic_moduli(const Packing &p, const StableGraph &g, const ContactWeights &w);

// displacement (n, d) from a to b without its mean over spheres stable in both.
jam_comparison compare_packings(const Packing &a, const ContactNetwork *na, const Packing &b, const ContactNetwork *nb,
                                std::vector<double> &displacement);

}  // namespace jam
