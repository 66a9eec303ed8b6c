// Symmetric sparse matrices of d x d blocks on the graph of the spheres.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace jam::inside {

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
size_t csr_entries(const BlockMatrix &m);  // JAM_E_ARGUMENT above the largest int32

// Takes the mean of x (nodes, dim) along these axes (bits) away: the exact projection on no net translation.
void remove_translation(int dim, int32_t nodes, double *x, uint32_t axes = ~0u);

}  // namespace jam::inside
