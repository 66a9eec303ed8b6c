// The contact network as analysis sees it: stable spheres numbered without rattlers, and symmetric matrices
// of d x d blocks on that graph.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>
#include "core/contacts.hpp"
#include "core/packing.hpp"

namespace jam {

struct StableGraph {
  int dim = 3;
  int32_t nodes = 0;
  std::vector<int32_t> sphere;   // node -> sphere
  std::vector<int32_t> node;     // sphere -> node, -1 for rattlers
  std::vector<int32_t> a, b;     // contact -> nodes; a == b when a sphere touches its own image
  std::vector<double> normal;    // (contacts, dim) unit vector from b to a
  std::vector<double> distance;  // |r_ij| of each contact
  std::vector<double> sigma;     // sigma_ij of each contact
  std::vector<double> force;     // mean 1; empty when it is not known
  size_t contacts() const { return a.size(); }
  size_t unknowns() const { return static_cast<size_t>(nodes) * dim; }
};

StableGraph make_graph(const Packing &p, const ContactNetwork &network);

// y (contacts) = S x: relative normal displacement of every contact, n . (x_a - x_b).
void stretch(const StableGraph &g, const double *x, double *y);
// y (nodes, dim) = S^T f: net force on every stable sphere.
void balance(const StableGraph &g, const double *f, double *y);
// Largest |sum_j f_ij n_ij| over mean |f|.
double balance_residual(const StableGraph &g, const double *f);

// Symmetric, d x d blocks: diag (nodes), off (edges) with rows of ei and columns of ej, ei < ej, sorted, no
// edge twice (two contacts of the same pair of spheres are summed).
struct BlockMatrix {
  int dim = 3;
  int32_t nodes = 0;
  std::vector<int32_t> ei, ej;
  std::vector<double> diag, off;
  size_t rows() const { return static_cast<size_t>(nodes) * dim; }
  // y = A x
  void multiply(const double *x, double *y) const;
  void add_to_diagonal(double shift);
  // A bound on the largest |eigenvalue| (Gershgorin).
  double norm_bound() const;
};

struct CsrMatrix {
  std::vector<int32_t> start, column;  // rows + 1, entries; columns ascending in a row
  std::vector<double> value;
};
// Entries that are exactly zero inside a block are kept, so that the pattern does not depend on the values.
CsrMatrix to_csr(const BlockMatrix &m);

// Takes the mean of x (nodes, dim) away: the exact projection on no net translation.
void remove_translation(int dim, int32_t nodes, double *x);

}  // namespace jam
