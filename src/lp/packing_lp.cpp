#include "lp/packing_lp.hpp"
#include "core/pair_rule.hpp"

#include <algorithm>
#include <cmath>

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
  constexpr double factor = InteriorPointTuning::multiplier_band;
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
    if (moved > at_bound * lp.bound)
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

}  // namespace jam::inside
