#include "lp/packing_lp.hpp"

#include <algorithm>
#include <cmath>

#include "core/limits.hpp"
#include "core/pair_rule.hpp"
#include "jam/jam.h"

namespace jam::inside {

PackingLp make_lp(const Packing &p, const PairList &pairs, double sigma_unit, const StrainBasis &basis) {
  PackingLp lp;
  const int d = p.dim;
  lp.dim = d;
  lp.n = static_cast<int32_t>(p.n());
  lp.pairs = &pairs;
  lp.a.resize(pairs.size() * d);
  lp.c.resize(pairs.size());
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double r2 = pair_vector(p, pairs, k, r);
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
    const double length = std::sqrt(r2);
    lp.c[k] = (length - sigma) * (length + sigma) / (sigma * sigma);
    const double scale = pairs.i[k] == pairs.j[k] ? 0.0 : 2.0 * sigma_unit / (sigma * sigma);
    for (int c = 0; c < d; ++c) lp.a[k * d + c] = scale * r[c];
  }
  lp.strains = basis.count();
  if (lp.strains == 0) return lp;
  std::vector<double> vectors(pairs.size() * d), scale(pairs.size());
  for (size_t k = 0; k < pairs.size(); ++k) {
    pair_vector(p, pairs, k, &vectors[k * d]);
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
    scale[k] = 2.0 / (sigma * sigma);
  }
  lp.strain = strain_rows(basis, vectors, scale);
  return lp;
}

double centre_multipliers(std::vector<double> &y, const std::vector<double> &w, double carrying) {
  constexpr double factor = CorrectorTuning::band;
  double sum = 0.0, products = 0.0, inverse = 0.0;
  for (size_t k = 0; k < y.size(); ++k) sum += y[k], products += y[k] * w[k], inverse += 1.0 / w[k];
  const double mu = sum > 0.0 ? products / (sum * carrying) : 1.0 / inverse;
  for (size_t k = 0; k < y.size(); ++k)
    y[k] = y[k] > 0.0 ? std::min(std::max(y[k] / sum, mu / (factor * w[k])), factor * mu / w[k]) : mu / w[k];
  return mu;
}

LpCheck check_lp(const PackingLp &lp, const LpSolution &x) {
  LpCheck out{0.0, 0.0, 0.0, 0.0};
  const int d = lp.dim;
  const PairList &pairs = *lp.pairs;
  const size_t strains = static_cast<size_t>(lp.strains), spheres = static_cast<size_t>(lp.n) * d;
  std::vector<double> force(lp.unknowns(), 0.0);
  double sum_y = 0.0, sum_yc = 0.0, sum_ya = 0.0;
  for (size_t k = 0; k < lp.rows(); ++k) {
    const double *a = &lp.a[k * d];
    const size_t i = static_cast<size_t>(pairs.i[k]) * d, j = static_cast<size_t>(pairs.j[k]) * d;
    const double row = lp.c[k] - x.g + lp.change(k, x.s.data(), x.strain.data());
    double a2 = 0.0;
    for (int c = 0; c < d; ++c) {
      force[i + c] += x.y[k] * a[c];
      if (!pairs.wall(k)) force[j + c] -= x.y[k] * a[c];
      a2 += a[c] * a[c];
    }
    for (size_t q = 0; q < strains; ++q) force[spheres + q] += x.y[k] * lp.strain[k * strains + q];
    out.infeasibility = std::max(out.infeasibility, std::max(-row, -x.y[k]));
    sum_y += x.y[k];
    sum_yc += x.y[k] * lp.c[k];
    sum_ya += x.y[k] * std::sqrt(a2);
  }
  double unbalanced = 0.0, held = 0.0;
  for (size_t k = 0; k < force.size(); ++k) {
    const double moved = std::fabs(k < spheres ? x.s[k] : x.strain[k - spheres]);
    out.infeasibility = std::max(out.infeasibility, moved - lp.bound);
    if (moved > LineSearchTuning::of_feasible * lp.bound)
      held += std::fabs(force[k]);  // the bound carries it
    else
      unbalanced = std::max(unbalanced, std::fabs(force[k]));
  }
  const double carrying = static_cast<double>(lp.dim) * lp.n;  // about as many contacts as degrees of freedom
  out.balance = sum_ya > 0.0 ? unbalanced * carrying / sum_ya : 0.0;
  out.gamma = std::fabs(sum_y - 1.0);
  out.gap = sum_yc + (std::isfinite(lp.bound) ? lp.bound * held : 0.0) - x.g;
  return out;
}

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
