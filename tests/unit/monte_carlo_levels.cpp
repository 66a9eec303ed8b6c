// Monte Carlo of spheres of very different size, whose lists are made by level, against sums over all pairs and images.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/create.hpp"
#include "core/pair_energy.hpp"
#include "core/pair_rule.hpp"
#include "core/pairs.hpp"
#include "dynamics/monte_carlo/monte_carlo.hpp"
// test.h comes last: it has a macro `fail`.
#include "test.h"

using namespace jam::inside;

namespace {

struct Scene {
  const char *name;
  int dim;
  std::vector<double> cell;  // empty: a cube
  double non_additivity;
  double ratio, fraction;
};
const Scene scenes[] = {
    {"disks", 2, {}, 0.0, 40.0, 0.45},
    {"spheres", 3, {}, 0.0, 9.0, 0.25},
    {"tilted", 2, {1, 0, 0.4, 1.1}, 0.0, 15.0, 0.4},
    {"non-additive", 2, {}, 0.2, 12.0, 0.3},
    {"three sizes", 3, {}, -0.1, 4.0, 0.3},
};

Packing start(const Scene &s, int32_t overlap) {
  jam_create_options o = default_create_options();
  o.dim = s.dim, o.seed = 5, o.packing_fraction = s.fraction, o.overlap = overlap;
  o.non_additivity = s.non_additivity;
  std::vector<double> sizes(3, s.ratio);
  for (int k = 0; k < 300; ++k) sizes.push_back(k % 7 ? 1.0 : std::sqrt(s.ratio));
  return make_packing(o, nullptr, 0, sizes.data(), sizes.size(), s.cell.empty() ? nullptr : s.cell.data());
}

jam_monte_carlo_options options(double alpha, double step) {
  jam_monte_carlo_options o = default_monte_carlo_options();
  o.alpha = alpha, o.step = step, o.temperature = 1e-3, o.energy_unit = JAM_ENERGY_RELATIVE;
  return o;
}

// Sums over all pairs and images of f(r, sigma).
template <class F>
void brute(const Packing &p, double slope, F &&f) {
  const PairList pairs = find_pairs_brute(p, 0.0, slope);
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < pairs.size(); ++k)
    if (!pairs.own_image(k)) f(std::sqrt(pair_vector(p, pairs, k, r)), contact_distance(p, pairs.i[k], pairs.j[k]));
}

CASE(energy_is_the_sum_over_all_pairs) {
  for (const Scene &s : scenes)
    for (const double step : {0.02, 0.4}) {
      const jam_monte_carlo_options o = options(2.0, step);
      Packing p = start(s, JAM_OVERLAP_ALLOW);
      const auto mc = make_monte_carlo(p, o, 0);
      const PairEnergy energy(o.alpha, o.energy_scale, o.energy_unit == JAM_ENERGY_RELATIVE);
      for (int sweep = 0; sweep < 12; ++sweep) {
        mc->sweep(sweep);
        mc->write_state(p);
        double sum = 0.0;
        brute(p, 1.0, [&](double r, double sigma) { sum += energy.value(1.0 - r / sigma); });
        if (!(std::fabs(mc->energy() - sum) < 1e-9 * (1.0 + sum))) fail_msg("%s: %g, %g", s.name, mc->energy(), sum);
      }
    }
}

CASE(gaps_are_those_of_all_pairs) {
  for (int run = 0; run < 2 * static_cast<int>(std::size(scenes)); ++run) {
    const Scene &s = scenes[run / 2];
    Packing p = start(s, JAM_OVERLAP_REFUSE);
    const auto mc = make_monte_carlo(p, options(0.0, run % 2 ? 0.4 : 0.02), 0);  // in cells, or by lists
    for (int sweep = 0; sweep < 5; ++sweep) mc->sweep(sweep);
    mc->write_state(p);
    const double h_max = mc->gap_range();
    assert_true(h_max > 0.0);
    std::vector<double> bins(4, 0.0), all(4, 0.0);
    mc->count_gaps(h_max, bins);
    brute(p, 1.0 + h_max, [&](double r, double sigma) {
      const double h = r / sigma - 1.0;
      if (h < h_max) all[static_cast<size_t>(std::max(0.0, h) / h_max * 4.0)] += 1.0;
    });
    for (int sweep = 5; sweep < 10; ++sweep) mc->sweep(sweep);
    mc->write_state(p);
    assert_true(closest_pair(p).gap >= -1e-12);
    for (size_t k = 0; k < 4; ++k)
      if (bins[k] != all[k]) fail_msg("%s: bin %zu has %g pairs, %g are there", s.name, k, bins[k], all[k]);
  }
}

}  // namespace
