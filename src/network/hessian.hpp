// Hessians of a contact network: S~^T S~ with a stiffness per contact, and the pre-stress part.
#pragma once
#include <vector>
#include "jam/jam.h"
#include "network/rigidity_matrix.hpp"

namespace jam::inside {

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
// Block of one contact: k n n^T - t (1 - n n^T), with the unit matrix of the first `curved` axes: d of a pair, of a
// wall those along which it is round.
inline void contact_block(int dim, double k, double t, const double *n, int curved, double *block) {
  for (int r = 0; r < dim; ++r)
    for (int c = 0; c < dim; ++c) block[r * dim + c] = (k + t) * n[r] * n[c] - (r == c && r < curved ? t : 0.0);
}
BlockMatrix make_hessian(const RigidityMatrix &g, const ContactWeights &w);
// u . H . u as a sum over contacts: no cancellation between large entries, so small eigenvalues keep their digits.
double curvature(const RigidityMatrix &g, const ContactWeights &w, const double *u);

}  // namespace jam::inside
