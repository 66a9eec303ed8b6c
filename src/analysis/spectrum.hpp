// Density of states and elastic moduli from a Hessian without its modes.
#pragma once
#include <vector>
#include "network/self_stress.hpp"

namespace jam::inside {

jam_dos_options default_dos_options();
struct DensityOfStates {
  std::vector<double> omega;  // middle of each bin, from -sqrt(-lambda_min) with pre-stress (omega^2 < 0: unstable)
  std::vector<double> density, density_error;        // D(omega) there
  std::vector<double> cumulative, cumulative_error;  // share of modes below the upper end of the bin
  double step = 0.0;                                 // width of a bin
};
// Kernel polynomial method (Weisse et al., Rev. Mod. Phys. 78, 275 (2006)).
DensityOfStates density_of_states(const RigidityMatrix &g, const ContactWeights &w, const jam_dos_options &o);

// Second derivatives of the energy a volume by the gradients E_ab and E_cd of x -> (1 + E) x, tables (d, d, d, d):
// spheres moved by it alone, and relaxed. JAM_E_STATE when pre-stress makes the network unstable.
struct ElasticTensor {
  std::vector<double> affine, relaxed;
};
ElasticTensor elastic_tensor(const Packing &p, const RigidityMatrix &g, const ContactWeights &w);
// Moduli from that tensor.
jam_moduli_report elastic_moduli(const Packing &p, const RigidityMatrix &g, const ContactWeights &w);

}  // namespace jam::inside
