// Hessians of a contact network: S~^T S~ with a stiffness per contact, and the pre-stress part.
#pragma once
#include "jam/jam.h"
#include "linalg/block_matrix.hpp"
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
// Block of one contact: k n n^T - t (P - m m^T), see Turning.
inline void contact_block(int dim, double k, double t, const double *n, Turning turning, double *block) {
  const double both = k + turning.lean * turning.lean * t;
  for (int r = 0; r < dim; ++r)
    for (int c = 0; c < dim; ++c) {
      const bool turns = turning.along(r) && turning.along(c);
      block[r * dim + c] = (turns ? both : k) * n[r] * n[c] - (turns && r == c ? t : 0.0);
    }
}
BlockMatrix make_hessian(const RigidityMatrix &g, const ContactWeights &w);
// u . H . u as a sum over contacts: no cancellation between large entries, so small eigenvalues keep their digits.
double curvature(const RigidityMatrix &g, const ContactWeights &w, const double *u);

}  // namespace jam::inside
