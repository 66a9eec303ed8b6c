// Hessians of a contact network: S~^T S~ with a stiffness per contact, and the pre-stress part.
#pragma once
#include <vector>
#include "jam/jam.h"
#include "network/rigidity_matrix.hpp"

namespace jam {

jam_hessian_options default_hessian_options();
// Throws JAM_E_ARGUMENT for values out of range.
void check_hessian_options(const jam_hessian_options &o);
bool needs_forces(const jam_hessian_options &o);

// Stiffness of every contact (1 at the mean force), and the transverse term t = prestress f <sigma> / (r (alpha - 1)).
struct ContactWeights {
  std::vector<double> stiffness;
  std::vector<double> transverse;  // empty without pre-stress
};
ContactWeights contact_weights(const RigidityMatrix &g, double sigma_mean, const jam_hessian_options &o);
BlockMatrix make_hessian(const RigidityMatrix &g, const ContactWeights &w);
// u . H . u as a sum over contacts: no cancellation between large entries, so small eigenvalues keep their digits.
double curvature(const RigidityMatrix &g, const ContactWeights &w, const double *u);

}  // namespace jam
