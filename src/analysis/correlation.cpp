// g(r), bond order.
#include <algorithm>
#include <cmath>
#include "analysis/structure.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/pair_levels.hpp"
#include "core/shells.hpp"
#include "network/resolution.hpp"

namespace jam::inside {

void check_pair_correlation(const Packing &p, size_t kind_len, double r_max, int64_t bins) {
  if (kind_len != 0 && kind_len != p.n())
    fail(JAM_E_ARGUMENT, "kind has %zu numbers, it must have 0 or n = %zu", kind_len, p.n());
  if (!(r_max >= limits::distance_min && r_max * diameter_mean(p) <= 4.0 * p.cell.side()))
    fail(JAM_E_ARGUMENT, "r_max is %g mean diameters, it must be from %g to 4 boxes", r_max, limits::distance_min);
  if (bins < 1 || bins > 100000000)
    fail(JAM_E_ARGUMENT, "bins is %lld, it must be in 1..1e8", static_cast<long long>(bins));
}

std::vector<double> pair_correlation(const Packing &p, const int32_t *kind, size_t kind_len, int32_t a, int32_t b,
                                     double r_max, size_t bins) {
  const double unit = diameter_mean(p);
  auto is = [&](int32_t i, int32_t which) { return which < 0 || kind_len == 0 || kind[i] == which; };
  std::vector<char> of(p.n()), with(p.n());
  double na = 0.0, nb = 0.0;
  for (size_t i = 0; i < p.n(); ++i) {
    na += of[i] = is(static_cast<int32_t>(i), a);
    nb += with[i] = is(static_cast<int32_t>(i), b);
  }
  std::vector<double> g(bins, 0.0), r(p.dim);
  visit_pairs(p, r_max * unit, 0.0, [&](const PairList &part) {
    for (size_t k = 0; k < part.size(); ++k) {
      // What counts as a contact, to both sides of its distance, must not fall into two bins where that is an edge.
      // Beyond the last bin it belongs to none.
      const double x = std::sqrt(pair_vector(p, part, k, r.data())) / (r_max * unit) * (1.0 + contact_gap_limit);
      const auto bin = static_cast<size_t>(x * static_cast<double>(bins));
      if (bin >= bins) continue;
      const int32_t i = part.i[k], j = part.j[k];
      // ordered pairs (a, b); an image of a sphere with itself stands once in the list for both directions
      g[bin] += static_cast<double>(is(i, a) && is(j, b)) + static_cast<double>(is(j, a) && is(i, b));
    }
  });
  if (p.container) {
    std::vector<double> edge;
    for (size_t k = 0; k <= bins; ++k)
      edge.push_back(r_max * unit / static_cast<double>(bins) * static_cast<double>(k));
    const std::vector<double> even = pairs_of_even_spread(p, of, with, edge);
    for (size_t k = 0; k < bins; ++k) g[k] = even[k] > 0.0 ? g[k] / even[k] : 0.0;
    return g;
  }
  const double ball = unit_sphere_volume(p.dim) * math::pow(2.0, p.dim), density = nb / p.cell.volume();
  for (size_t k = 0; k < bins; ++k) {
    const double lo = r_max * unit * static_cast<double>(k) / static_cast<double>(bins),
                 hi = r_max * unit * static_cast<double>(k + 1) / static_cast<double>(bins);
    const double expected = na * density * ball * (math::pow(hi, p.dim) - math::pow(lo, p.dim));
    g[k] = expected > 0.0 ? g[k] / expected : 0.0;
  }
  return g;
}

namespace {
// P_l of d dimensions with P_l(1) = 1: Chebyshev in d = 2, Legendre in d = 3, Gegenbauer beyond, by the recurrence
// (l + d - 2) P_{l+1} = (2 l + d - 2) x P_l - l P_{l-1}.
double zonal(int d, int l, double x) {
  double before = 1.0, now = x;
  if (l == 0) return 1.0;
  for (int k = 1; k < l; ++k) {
    const double next = ((2.0 * k + d - 2.0) * x * now - k * before) / (k + d - 2.0);
    before = now;
    now = next;
  }
  return now;
}
}  // namespace

// Q_l^2 = 4 pi / (2 l + 1) sum_m |mean_j Y_lm(n_j)|^2 = mean over pairs (j, k) of P_l(n_j . n_k), by the addition
// theorem.
void check_bond_order(int l, double cutoff) {
  if (l < 1 || l > 64) fail(JAM_E_ARGUMENT, "l is %d, it must be in 1..64", l);
  if (!(cutoff > 0.0 && cutoff <= 3.0)) fail(JAM_E_ARGUMENT, "cutoff is %g, it must be in (0, 3]", cutoff);
}

std::vector<double> bond_order(const Packing &p, int l, double cutoff) {
  const int d = p.dim;
  const PairList all = find_pairs(p, 0.0, cutoff);
  std::vector<std::vector<double>> of(p.n());
  std::vector<double> r(d);
  SparseLook sparse_look;
  for (size_t k = 0; k < all.size(); ++k) {
    sparse_look();
    if (all.wall(k)) continue;  // bonds are of two spheres
    const double length = std::sqrt(pair_vector(p, all, k, r.data()));
    for (int c = 0; c < d; ++c) of[all.i[k]].push_back(r[c] / length);
    for (int c = 0; c < d; ++c) of[all.j[k]].push_back(-r[c] / length);
  }
  std::vector<double> q(p.n(), 0.0);
  for (size_t i = 0; i < p.n(); ++i) {
    const size_t z = of[i].size() / d;
    if (z == 0) continue;
    double sum = static_cast<double>(z);
    for (size_t x = 0; x < z; ++x) {
      CallScope::look();
      for (size_t y = x + 1; y < z; ++y) {
        double dot = 0.0;
        for (int c = 0; c < d; ++c) dot += of[i][x * d + c] * of[i][y * d + c];
        sum += 2.0 * zonal(d, l, std::max(-1.0, std::min(1.0, dot)));
      }
    }
    q[i] = std::sqrt(std::max(0.0, sum)) / static_cast<double>(z);
  }
  return q;
}

}  // namespace jam::inside
