// The equations of an exactly jammed packing, in numbers without rounding.
//
//   F_c(x, Gamma) = |x_a - x_b + n_c A|^2 - Gamma sigma_c^2,   one for each contact c
//
// x: centres of the stable spheres, each the sum of two doubles; n_c: an integer vector, rows of A: cell vectors;
// sigma_c: contact distance from the ratios s_i of diameters. A packing with the diameters sqrt(Gamma) s_i touches
// exactly in the contacts where all F_c are 0. One stable sphere is pinned, which removes translations.
#pragma once
#include <cstdint>
#include <vector>

#include "core/packing.hpp"
#include "network/contact_network.hpp"
#include "proof/expansion.hpp"

namespace jam {

struct ProofScene {
  int dim = 3;
  double unit = 1.0;  // a power of two: lengths here are lengths of the packing over it, about the box
  Cell cell{3, 1.0};  // in this unit, as all below
  double non_additivity = 0.0;
  std::vector<double> ratio;      // s_i of all spheres
  std::vector<double> high, low;  // (n, dim), all spheres
  double gamma = 1.0, gamma_low = 0.0;
  std::vector<int32_t> sphere, node;  // node -> sphere; sphere -> node, -1 for rattlers
  std::vector<int32_t> a, b;          // contact -> nodes
  std::vector<int32_t> image;         // (contacts, dim): n_c
  std::vector<double> force;          // f_c > 0 with sum f_c sigma_c^2 = 1; as given by the network until refined
  bool own_images = false;            // a contact of a sphere with its own image

  size_t contacts() const { return a.size(); }
  size_t nodes() const { return sphere.size(); }
  size_t unknowns() const { return dim * nodes(); }  // Gamma not counted; the pinned sphere is node 0

  // Component k of r_c, exactly.
  Expansion component(size_t c, int k) const;
  Expansion sigma_squared(int32_t i, int32_t j) const;  // of spheres
  Expansion sigma_squared(size_t c) const { return sigma_squared(sphere[a[c]], sphere[b[c]]); }
};

// ratio: one s_i a sphere, or empty: the diameters as they are. The network has forces.
ProofScene make_proof_scene(const Packing &p, const ContactNetwork &network, const std::vector<double> &ratio);

// The integer vector n with offset = n A but for rounding; false where it is none (Mari-Kurchan shifts).
bool lattice_image(const Cell &cell, const double *offset, int32_t *n);

// All equations at the scene's numbers, rounded once, and the rows of their derivatives.
struct ProofEquations {
  std::vector<double> f;       // F_c, to a relative error of 2 half_ulp
  std::vector<double> row;     // (contacts, dim): 2 r_c, the derivative by x_a; by x_b it is the negative
  std::vector<double> sigma2;  // sigma_c^2
};
ProofEquations evaluate(const ProofScene &scene);

// y (contacts) = R v with the rows above; v of the pinned node is 0.
void multiply_rows(const ProofScene &scene, const ProofEquations &e, const double *v, double *y);
// y (nodes, dim) = R^T f, with zeros at the pinned node. With `absolute` of absolute values.
void multiply_columns(const ProofScene &scene, const ProofEquations &e, const double *f, double *y,
                      bool absolute = false);

}  // namespace jam
