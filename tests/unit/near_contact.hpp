// Pairs that nearly touch in a jammed packing: the nearest, and one brought as near as a test wants it.
#pragma once
#include <algorithm>
#include <cmath>

#include "crunch/phases.hpp"
#include "crunch_scenes.hpp"

namespace jam::inside {

inline double relative_gap(const Packing &p, const PairList &pairs, size_t k = 0) {
  double r[JAM_MAX_DIM];
  return std::sqrt(pair_vector(p, pairs, k, r)) / (0.5 * (p.diameter[pairs.i[k]] + p.diameter[pairs.j[k]])) - 1.0;
}

// The nearest pair of stable spheres that is no contact.
inline PairList nearest_other(const Packing &p, const ContactNetwork &net) {
  const PairList near = find_pairs(p, 0.3 * diameter_mean(p), 1.0);
  PairList one, best;
  double closest = 1.0;
  for (size_t k = 0; k < near.size(); ++k) {
    one.i = {near.i[k]}, one.j = {near.j[k]};
    one.offset.assign(&near.offset[p.dim * k], &near.offset[p.dim * k] + p.dim);
    const double gap = relative_gap(p, one);
    bool other = gap < closest && net.coordination[near.i[k]] && net.coordination[near.j[k]];
    for (size_t c = 0; c < net.size() && other; ++c) other = net.pairs.i[c] != near.i[k] || net.pairs.j[c] != near.j[k];
    if (other) closest = gap, best = one;
  }
  return best;
}

// One sphere's size changes: its contacts open or overlap until polish closes them.
inline void resize(Packing &p, ContactNetwork &net, int32_t sphere, double change) {
  p.diameter[sphere] *= 1.0 + change;
  for (size_t k = 0; k < net.size(); ++k) net.gap[k] = relative_gap(p, net.pairs, k);
}

// One sphere is made larger or smaller until the nearest pair that is no contact is `wanted` apart. Returns how fast it
// moved; 0 when a force turns negative on the way.
inline double bring_together(Packing &p, ContactNetwork &net, PairList &pair, int32_t &sphere, double wanted) {
  for (size_t i = 0; i < p.n(); ++i)
    if (net.coordination[i] == 0) p.diameter[i] *= 0.1;  // rattlers are not in the way
  pair = nearest_other(p, net);
  sphere = pair.i[0];
  double last = relative_gap(p, pair), change = 0.1 * last, rate = 0.0;
  NewtonSystem system;
  for (int k = 0; k < 60 && std::fabs(last - wanted) > 1e-3 * wanted; ++k) {
    resize(p, net, sphere, change);
    if (polish(p, net, system, 1, Tuning()) != PolishEnd::done) return 0.0;
    const double now = relative_gap(p, pair);
    rate = (now - last) / change;
    pair = nearest_other(p, net);  // another may have become the nearest
    last = relative_gap(p, pair);
    change = std::max(-1e-3, std::min(1e-3, (wanted - last) / rate));
  }
  return std::fabs(last - wanted) < 0.1 * wanted ? rate : 0.0;
}

}  // namespace jam::inside
