// The rigidity matrix S of a contact network: one row a contact, d columns a force-carrying sphere. Row k holds n_ij on
// sphere i and -n_ij on sphere j. A wall does not move: its row holds n_ij on sphere i alone.
#pragma once
#include "linalg/block_matrix.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

struct RigidityMatrix {
  int dim = 3;
  int32_t nodes = 0;
  std::vector<int32_t> sphere;   // node -> sphere
  std::vector<int32_t> node;     // sphere -> node, -1 for rattlers
  std::vector<int32_t> a, b;     // contact -> nodes; a == b: a sphere and its own image; b < 0: a wall
  std::vector<double> normal;    // (contacts, dim) unit vector from b to a
  std::vector<double> distance;  // |r_ij| of each contact
  std::vector<double> sigma;     // sigma_ij of each contact
  // Second derivative of |r_ij| where its direction turns: 1 / |r_ij|, of walls their negative curvature.
  std::vector<double> bending;
  std::vector<Turning> wall;  // of each wall
  uint32_t curved = 0;        // axes along which a wall is curved
  Turning turning(size_t k) const {
    return b[k] < 0 ? wall[static_cast<size_t>(wall_partner(b[k]))] : turning_of_pairs;
  }
  double rounding = 0.0;                     // largest error of a vector r_ij, as coordinates are rounded
  std::vector<double> force;                 // mean 1; empty when it is not known
  std::vector<double> stiffness, prestress;  // of soft spheres, as in ContactNetwork; else empty
  size_t contacts() const { return a.size(); }
  size_t unknowns() const { return static_cast<size_t>(nodes) * dim; }

  // The motions that keep every distance: translations along axes without walls, and rotations that walls allow.
  uint32_t open_axes = ~0u;
  std::vector<std::vector<double>> rotations;  // orthonormal, each (nodes, dim)
  int symmetries() const;
  void remove_symmetries(double *x) const;  // x (nodes, dim)
  // The part of u_a - u_b along n of contact k, and the squared part across, where n turns.
  struct Stretch {
    double along, across;
  };
  Stretch stretch(size_t k, const double *u) const;
};

RigidityMatrix make_rigidity_matrix(const Packing &p, const ContactNetwork &network);
// Of its nodes, with the centres (n, dim) of all spheres.
void take_symmetries(const Container &container, const double *position, RigidityMatrix &g);
// The selected rows and their nodes. `sphere` and `node` of the result number nodes of g, not spheres.
RigidityMatrix subset(const RigidityMatrix &g, const std::vector<char> &on);

// Adds factor times the displacements x of the nodes of such a subset to v, those of the nodes of g.
void scatter(const RigidityMatrix &sub, const double *x, double factor, std::vector<double> &v);

// The part of each node, named by its smallest node: nodes with a contact between them are in one, except for nodes
// (flags) that are `left` out.
std::vector<int32_t> parts_of(const RigidityMatrix &g, const std::vector<char> &left = {});

// Largest error of each unit vector: by rounding, and by what contacts of its two spheres are open by, as they turn
// while they close.
std::vector<double> direction_errors(const RigidityMatrix &g);

// y (contacts) = S x: relative normal displacement of every contact, n . (x_a - x_b).
void apply_compatibility(const RigidityMatrix &g, const double *x, double *y);
// y (nodes, dim) = S^T f: net force on every stable sphere.
void apply_equilibrium(const RigidityMatrix &g, const double *f, double *y);
// Largest |sum_j f_ij n_ij| over mean |f|.
double balance_residual(const RigidityMatrix &g, const double *f);
// The same with the forces and vectors of a network of n spheres.
double balance_residual(int dim, size_t n, const ContactNetwork &network);

// Hessians of a contact network: S~^T S~ with a stiffness per contact, and the pre-stress part.

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
