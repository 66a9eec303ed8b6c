#include "lp/strain.hpp"

#include <algorithm>
#include <cmath>

#include "core/checks.hpp"
#include "jam/jam.h"

namespace jam::inside {

void check_strain(int32_t strain, const char *call) {
  if (strain > JAM_STRAIN_FREE && strain <= JAM_STRAIN_ALL)
    fail(JAM_E_ARGUMENT,
         "strain is %d, which frees the volume, as jam_relax alone can: %s takes none, edges, tilts or free", strain,
         call);
  check_enum(strain, JAM_STRAIN_NONE, JAM_STRAIN_FREE, "strain", "jam_free_strain");
}

StrainBasis strain_basis(int dim, bool edges, bool tilts, uint32_t axes) {
  StrainBasis basis;
  basis.dim = dim;
  const size_t block = static_cast<size_t>(dim) * dim;
  const auto matrix = [&]() {
    basis.matrices.resize(basis.matrices.size() + block, 0.0);
    return basis.matrices.data() + basis.matrices.size() - block;
  };
  const auto open = [&](int c) { return (axes >> c & 1) != 0; };
  int last = dim - 1;
  while (last > 0 && !open(last)) --last;
  for (int c = 0; edges && c < last; ++c) {
    if (!open(c)) continue;
    double *m = matrix();
    m[c * (dim + 1)] = 1.0, m[last * (dim + 1)] = -1.0;
  }
  for (int c = 0; tilts && c < dim; ++c)
    for (int k = c + 1; k < dim; ++k)
      if (open(c) && open(k)) matrix()[c * dim + k] = 1.0;
  return basis;
}

std::vector<double> strain_matrix(const StrainBasis &basis, const std::vector<double> &amplitude, double scale) {
  const size_t block = static_cast<size_t>(basis.dim) * basis.dim;
  std::vector<double> e(block, 0.0);
  for (size_t k = 0; k < amplitude.size(); ++k)
    for (size_t c = 0; c < block; ++c) e[c] += scale * amplitude[k] * basis.matrices[k * block + c];
  return e;
}

double strain_part(int dim, const std::vector<double> &strain) {
  double part = 1.0;
  for (int c = 0; c < dim; ++c) {
    const double shrinks = -strain[static_cast<size_t>(c) * (dim + 1)];
    if (!(shrinks * part <= 0.5)) part = 0.5 / shrinks;
  }
  return part;
}

std::vector<double> strain_rows(const StrainBasis &basis, const std::vector<double> &vectors,
                                const std::vector<double> &scale) {
  const int d = basis.dim;
  const size_t count = static_cast<size_t>(basis.count()), block = static_cast<size_t>(d) * d;
  std::vector<double> rows(scale.size() * count, 0.0);
  for (size_t e = 0; e < scale.size(); ++e)
    for (size_t k = 0; k < count; ++k) {
      const double *r = &vectors[e * d], *m = &basis.matrices[k * block];
      double product = 0.0;
      for (int a = 0; a < d; ++a)
        for (int b = a; b < d; ++b) product += r[a] * m[a * d + b] * r[b];
      rows[e * count + k] = scale[e] * product;
    }
  return rows;
}

}  // namespace jam::inside
