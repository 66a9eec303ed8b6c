// The equations of an exactly jammed packing, in numbers without rounding.
//
//   F_c(x, Gamma) = |x_a - x_b + n_c A|^2 - Gamma sigma_c^2,   one for each contact c
//
// x: centres of the stable spheres, each the sum of two doubles; n_c: an integer vector, rows of A: cell vectors;
// sigma_c: contact distance from the ratios s_i of diameters. A packing with the diameters sqrt(Gamma) s_i touches
// exactly in the contacts where all F_c are 0. One stable sphere is pinned, which removes translations.
//
// A flat wall is a contact with the mirror image of the sphere: r_c is twice the way from the wall to the centre, and
// sigma_c the diameter. Its partner is -1 - w, as in core/container.hpp. Along axes with walls no sphere is pinned.
//
// At a round wall about the middle of its axes, of the width W of the container,
//
//   F_c(x, g) = (W - g s_a)^2 - |2 x_a - W|^2,   g = sqrt(Gamma), r_c = 2 x_a - W along the axes of the wall,
//
// so that of scenes with such a wall g is the unknown: then all F_c are of second degree. For each rotation that the
// wall allows one more component of a sphere is pinned.
//
// Strict: Gamma is fixed, and the lower triangle of A is unknown. A cell vector is then a node like a sphere: F_c
// depends on sum_p w_p y_p over its ends p, w = 1, -1 for its spheres and n_q for cell vector q, and
// at a wall 2 for its sphere.
#pragma once
#include <cmath>

#include "network/contact_network.hpp"
#include "proof/expansion.hpp"

namespace jam::inside {

// A contact of which the others leave no choice but to be closed: the walk from one of its spheres to the other over
// these contacts has a known sum.
struct ImpliedContact {
  int32_t contact = 0;
  std::vector<int32_t> path;
  std::vector<std::vector<int32_t>> tiles;  // walks round triangles and parallelograms that give the directions
};

struct ProofScene {
  int dim = 3;
  double unit = 1.0;  // a power of two: lengths here are lengths of the packing over it, about the box
  Cell cell{3, 1.0};  // in this unit, as all below
  Container container;
  std::vector<double> cell_low;  // (dim, dim), added to the cell vectors
  bool strict = false;
  double non_additivity = 0.0;
  std::vector<double> ratio;              // s_i of all spheres
  std::vector<double> high, low;          // (n, dim), all spheres
  double growth = 1.0, growth_low = 0.0;  // the unknown beside the centres: Gamma, with a round wall its root g
  std::vector<int32_t> sphere, node;      // node -> sphere; sphere -> node, -1 for rattlers
  std::vector<int32_t> a, b;              // contact -> nodes; b < 0: a wall
  std::vector<int32_t> image;             // (contacts, dim): n_c
  std::vector<double> force;              // f_c > 0 with sum f_c sigma_c^2 = 1; as given by the network until refined
  std::vector<ImpliedContact> implied;    // d = 2: implied.cpp. Each follows from those before it and the others
  std::vector<double> row;  // with implied contacts: the state of self-stress of the others alone, once refined
  bool own_images = false;  // a contact of a sphere with its own image
  std::vector<char> pin;    // with a round wall, (n, dim): components that are pinned to exclude rotations

  bool rooted() const { return container.curved() != 0; }  // growth is g
  double gamma() const { return rooted() ? growth * growth : growth; }
  double gamma_per_growth() const { return rooted() ? 2.0 * growth : 1.0; }
  Expansion exact_growth() const;
  Expansion exact_gamma() const;
  void grow(double by_gamma);  // in two doubles, to first order

  size_t contacts() const { return a.size(); }
  size_t nodes() const { return sphere.size(); }
  size_t ends() const { return nodes() + (strict ? dim : 0); }  // spheres, then cell vectors
  size_t unknowns() const { return dim * ends(); }              // with those that are pinned, without Gamma
  bool wall(size_t c) const { return b[c] < 0; }
  bool round(int32_t j) const { return j < 0 && container[wall_partner(j)].curved(); }
  // Node 0 is pinned along axes without walls, and so are entries of cell vectors above the diagonal.
  bool moves(size_t node, int k) const {
    if (!pin.empty() && pin[static_cast<size_t>(sphere[node]) * dim + k]) return false;
    if (node == 0) return !cell.repeats(k);
    return node < nodes() || k <= static_cast<int>(node - nodes());
  }
  bool pinned(size_t node) const { return node == 0 && cell.closed() == 0; }
  // As many contacts as unknowns.
  int64_t needed() const {
    return dim * static_cast<int64_t>(nodes()) - symmetries(container, dim) + (strict ? dim * (dim + 1) / 2 : 1);
  }
  template <class F>
  void each_end(size_t c, F &&f) const {  // f(node, weight)
    if (wall(c)) return f(static_cast<size_t>(a[c]), 2.0);
    f(static_cast<size_t>(a[c]), 1.0), f(static_cast<size_t>(b[c]), -1.0);
    for (int q = 0; strict && q < dim; ++q)
      if (image[c * dim + q] != 0) f(nodes() + q, static_cast<double>(image[c * dim + q]));
  }

  int32_t partner(size_t c) const { return wall(c) ? b[c] : sphere[b[c]]; }  // a sphere or a wall
  // Component k of r_c, exactly; of spheres i and j, or wall j, with the image n.
  Expansion component(int32_t i, int32_t j, const int32_t *n, int k) const;
  Expansion component(size_t c, int k) const { return component(sphere[a[c]], partner(c), &image[c * dim], k); }
  Expansion sigma_squared(int32_t i, int32_t j) const;
  Expansion sigma_squared(size_t c) const { return sigma_squared(sphere[a[c]], partner(c)); }
  Expansion room(int32_t i) const;                              // W - g s_i
  Expansion gap(int32_t i, int32_t j, const int32_t *n) const;  // F
  // - dF / dGamma: sigma^2, at a round wall s_i (W - g s_i) / g.
  double weight(int32_t i, int32_t j) const;
  double weight(size_t c) const { return weight(sphere[a[c]], partner(c)); }
  // Along its unit normal a contact pushes with 2 lever f sqrt(Gamma).
  double lever(size_t c) const;
  // Length of the shortest vector by which the packing repeats; infinite between walls on all axes.
  double shortest_period() const;
};

// Which components are pinned to exclude rotations: those that these move the most. To be called for other nodes again.
void pin_rotations(ProofScene &scene);

// Only the contacts that are `on`, one flag each; spheres without a contact become rattlers.
void keep_contacts(ProofScene &scene, const std::vector<char> &on);

// The scene of the contacts that are not implied, forces as they are. Its equations are those that the exact packing
// solves; the implied ones follow.
ProofScene without_implied(const ProofScene &scene);

// ratio: one s_i a sphere, or empty: the diameters as they are. The network has forces.
ProofScene make_proof_scene(const Packing &p, const ContactNetwork &network, const std::vector<double> &ratio);
// The same without the search for implied contacts, which takes most of the time of a crystal of disks.
ProofScene scene_of_contacts(const Packing &p, const ContactNetwork &network, const std::vector<double> &ratio);

// The integer vector n with offset = n A except for rounding; false where it is none (Mari-Kurchan shifts).
bool lattice_image(const Cell &cell, const double *offset, int32_t *n);

// All equations at the scene's numbers, rounded once, and the rows of their derivatives.
struct ProofEquations {
  std::vector<double> f;       // F_c, to a relative error of 2 half_ulp
  std::vector<double> row;     // (contacts, dim): 2 r_c, at a round wall -2 r_c: each_end() has the weights of its ends
  std::vector<double> sigma2;  // weight()
};
ProofEquations evaluate(const ProofScene &scene);

// y (contacts) = R v with the rows above; what is pinned counts as 0.
void multiply_rows(const ProofScene &scene, const ProofEquations &e, const double *v, double *y);
// y (ends, dim) = R^T f, with zeros at what is pinned. With `absolute` of absolute values.
void multiply_columns(const ProofScene &scene, const ProofEquations &e, const double *f, double *y,
                      bool absolute = false);
// sum_p w_p^2 over the ends p of a contact: its largest value, and the largest sum over the contacts of a node. With
// these, sum_c |sum_p w_p v_p|^2 <= largest_load |v|^2.
double largest_weight(const ProofScene &scene);
double largest_load(const ProofScene &scene);
// At or above |q|, with F_c(g + h) - F_c(g) - h F_c'(g) = +-q_c h^2; 0 where Gamma is the unknown.
double growth_load(const ProofScene &scene);
// What R^T f has to be: 0, but strict the gradient of log V by the cell vectors.
std::vector<double> balance_target(const ProofScene &scene);

}  // namespace jam::inside
