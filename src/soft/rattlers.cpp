#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair_rule.hpp"
#include "soft/relaxation.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {

void centre_rattlers(SoftState &state) {
  const int d = state.dim();
  const SoftContacts contacts = state.contacts();
  const std::vector<char> on = stable_contacts(state, contacts);
  std::vector<char> rattler(state.n(), 1);
  for (size_t q = 0; q < contacts.size(); ++q)
    if (on[q])
      for_spheres(state.pairs().i[contacts.pair[q]], state.pairs().j[contacts.pair[q]],
                  [&](int32_t s) { rattler[s] = 0; });
  Packing p = state.packing();
  const double mean = state.diameter_mean();
  const PairList pairs = find_pairs(p, 0.5 * mean, 1.0);
  std::vector<std::vector<size_t>> of(state.n());
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs.i[k] == pairs.j[k]) continue;
    for_spheres(pairs.i[k], pairs.j[k], [&](int32_t s) {
      if (rattler[s]) of[s].push_back(k);
    });
  }
  const std::vector<double> start = p.position;
  // Smallest gap of sphere i at the positions in p, and the direction away from that neighbour.
  const auto nearest = [&](size_t i, double *away) {
    double least = std::numeric_limits<double>::infinity(), r[JAM_MAX_DIM];
    for (const size_t k : of[i]) {
      const double length = std::sqrt(pair_vector(p, pairs, k, r));
      const double gap = length - contact_distance(p, pairs.i[k], pairs.j[k]);
      if (!(gap < least) || !(length > 0.0)) continue;
      least = gap;
      const double sign = static_cast<size_t>(pairs.i[k]) == i ? 1.0 : -1.0;
      for (int c = 0; c < d; ++c) away[c] = sign * r[c] / length;
    }
    return least;
  };
  double away[JAM_MAX_DIM] = {}, step = CageTuning::first_step * mean;
  std::vector<double> before(state.n()), best = start, widest(state.n(), -std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < state.n(); ++i) before[i] = nearest(i, away);
  for (int sweep = 0; sweep < CageTuning::sweeps; ++sweep, step *= CageTuning::step_factor)
    for (size_t i = 0; i < state.n(); ++i) {
      if (of[i].empty()) continue;
      const double least = nearest(i, away);
      if (least > widest[i]) {
        widest[i] = least;
        std::copy_n(&p.position[i * d], d, &best[i * d]);
      }
      if (least > CageTuning::wide_gap * mean) continue;
      for (int c = 0; c < d; ++c) p.position[i * d + c] += step * away[c];
    }
  p.position = best;
  // Where rattlers share a cage their best places may not fit together: these go back.
  for (bool again = true; again;) {
    again = false;
    for (size_t i = 0; i < state.n(); ++i) {
      if (of[i].empty() || best[i * d] == start[i * d] || nearest(i, away) >= std::min(0.0, before[i])) continue;
      std::copy_n(&start[i * d], d, &p.position[i * d]);
      std::copy_n(&start[i * d], d, &best[i * d]);
      again = true;
    }
  }
  for (size_t k = 0; k < start.size(); ++k) state.displacement()[k] += best[k] - start[k];
}

}  // namespace jam::inside
