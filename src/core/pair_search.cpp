// Finds pairs: lists, visits and the closest pair, by levels of cells or by brute force over all images.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/math.hpp"
#include "core/pair_levels.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

double list_bytes_max() { return PairListTuning::share_of_memory * CallScope::memory_limit(); }

Cutoff own_cutoff(const Packing &p, const std::vector<double> &reach, double slope) {
  return {p, *std::max_element(reach.begin(), reach.end()), slope, reach.data()};
}

void add_walls(const Cutoff &cutoff, int32_t i, std::vector<Candidate> &found) {
  const Packing &p = cutoff.p;
  for (int w = 0; w < p.container.count(); ++w)
    if (cutoff.wants(i, wall_partner(w)) &&
        p.container[w].distance(&p.position[static_cast<size_t>(i) * p.dim]) < cutoff.of(i, wall_partner(w)))
      keep(found, {wall_partner(w), {}}, p.dim);
}

// Pairs of randomly placed spheres that a cutoff takes in: at least so many, as a mean power exceeds the power of a
// mean.
double expected_pairs(const Cutoff &cutoff) {
  const Packing &p = cutoff.p;
  const double n = static_cast<double>(p.n());
  double reach = cutoff.reach, diameter = 0.0;
  for (const double s : p.diameter) diameter += s / n;
  if (cutoff.own) reach = std::accumulate(cutoff.own, cutoff.own + p.n(), 0.0) / n;
  const double shrunk = 1.0 + std::min(0.0, p.non_additivity);  // a bound for every pair
  const double radius = reach + cutoff.slope * shrunk * diameter;
  return 0.5 * n * n * unit_sphere_volume(p.dim) * math::pow(2.0 * radius / p.cell.side(), p.dim);
}

PairList by_brute_force(const Cutoff &cutoff, const TakePairs *take = nullptr) {
  const Packing &p = cutoff.p;
  if (!take) check_list_size(expected_pairs(cutoff), p.dim);
  PairList list;
  std::vector<Candidate> found;
  SparseLook sparse_look;
  const ImageScan images(p);
  const int32_t n = static_cast<int32_t>(p.n());
  for (int32_t i = 0; i < n; ++i) {
    CallScope::look();
    for (int32_t j = i; j < n; ++j) {
      sparse_look();
      if (cutoff.wants(i, j)) images.scan(i, j, cutoff.of(i, j), found);
    }
    append_sorted(list, i, cutoff, found);
    give_part(list, take, PairListTuning::part);
  }
  give_part(list, take, 1);
  return list;
}

PairList by_cells(const Cutoff &cutoff, const TakePairs *take = nullptr) {
  if (cutoff.p.model != JAM_MODEL_EUCLID) return by_brute_force(cutoff, take);
  if (!take) check_list_size(expected_pairs(cutoff), cutoff.p.dim);
  return search_by_levels(cutoff, take);
}

}  // namespace

void check_list_size(double pairs, int dim) {
  const double bytes = pairs * static_cast<double>(2 * sizeof(int32_t) + dim * sizeof(double));
  if (bytes > list_bytes_max())
    fail(JAM_E_MEMORY, "%.3g pairs of spheres within the cutoff need %s, a list may have %s", pairs,
         bytes_text(bytes).c_str(), bytes_text(list_bytes_max()).c_str());
}

void append_sorted(PairList &list, int32_t i, const Cutoff &cutoff, std::vector<Candidate> &found) {
  const int dim = cutoff.p.dim;
  if (cutoff.walls) add_walls(cutoff, i, found);
  std::sort(found.begin(), found.end(), [dim](const Candidate &a, const Candidate &b) {
    if (a.j != b.j) return a.j < b.j;
    return std::lexicographical_compare(a.offset.begin(), a.offset.begin() + dim, b.offset.begin(),
                                        b.offset.begin() + dim);
  });
  check_list_size(static_cast<double>(list.size() + found.size()), dim);
  for (const Candidate &c : found) {
    list.i.push_back(i);
    list.j.push_back(c.j);
    list.offset.insert(list.offset.end(), c.offset.begin(), c.offset.begin() + dim);
  }
  found.clear();
}

PairList find_pairs(const Packing &p, double reach, double slope) { return by_cells({p, reach, slope}); }
PairList find_pairs(const Packing &p, const std::vector<double> &reach, double slope) {
  return by_cells(own_cutoff(p, reach, slope));
}
PairList find_pairs_of(const Packing &p, const std::vector<char> &some, const std::vector<double> &reach,
                       double slope) {
  Cutoff cutoff = own_cutoff(p, reach, slope);
  cutoff.only = some.data();
  return by_cells(cutoff);
}
void visit_pairs(const Packing &p, double reach, double slope, const TakePairs &take) {
  by_cells({p, reach, slope, nullptr, nullptr, false}, &take);
}
PairList find_pairs_brute(const Packing &p, double reach, double slope) { return by_brute_force({p, reach, slope}); }
PairList find_pairs_brute(const Packing &p, const std::vector<double> &reach, double slope) {
  return by_brute_force(own_cutoff(p, reach, slope));
}

ClosestPair closest_pair(const Packing &p) {
  // Spheres that overlap massively have many pairs at their contact distance: the closest are found within a part of
  // it.
  const double many = PairListTuning::pairs_per_sphere * static_cast<double>(p.n()),
               expected = expected_pairs({p, 0.0, PairListTuning::first_slope});
  double slope = expected > many
                     ? std::max(1e-30, PairListTuning::first_slope * math::pow(many / expected, 1.0 / p.dim))
                     : PairListTuning::first_slope;
  for (bool last = false; !last; slope = std::min(2.0, 2.0 * slope)) {
    last = slope >= 2.0;
    ClosestPair best{std::numeric_limits<double>::infinity(), -1, -1};
    visit_pairs(p, 0.0, slope, [&](const PairList &pairs) {
      double r[JAM_MAX_DIM];
      for (size_t k = 0; k < pairs.size(); ++k) {
        const int32_t i = pairs.i[k], j = pairs.j[k];
        const double gap = std::sqrt(pair_vector(p, pairs, k, r)) / contact_distance(p, i, j) - 1.0;
        const bool first = gap == best.gap && std::make_pair(i, j) < std::make_pair(best.i, best.j);
        if (gap < best.gap || first) best = {gap, i, j};
      }
    });
    if (best.i >= 0) return best;
  }
  return {std::numeric_limits<double>::infinity(), -1, -1};
}

ClosestPair closest_contact(const Packing &p) {
  const ClosestPair pair = closest_pair(p);
  const ClosestWall wall = closest_wall(p);
  return wall.gap < pair.gap ? ClosestPair{wall.gap, wall.sphere, wall_partner(wall.w)} : pair;
}

PairList replace_pairs(const PairList &list, const std::vector<char> &some, const PairList &theirs) {
  PairList out;
  size_t at = 0;
  const auto key = [](const PairList &pairs, size_t k) { return std::make_pair(pairs.i[k], pairs.j[k]); };
  for (size_t k = 0; k < list.size(); ++k) {
    if (some[list.i[k]] || (!list.wall(k) && some[list.j[k]])) continue;
    for (; at < theirs.size() && key(theirs, at) < key(list, k); ++at) out.append(theirs, at);
    out.append(list, k);
  }
  for (; at < theirs.size(); ++at) out.append(theirs, at);
  return out;
}

std::vector<double> carry_over(const PairList &from, const std::vector<double> &values, const PairList &to) {
  std::vector<double> out(to.size(), 0.0);
  size_t at = 0;
  for (size_t k = 0; k < to.size(); ++k) {
    const auto key = std::make_pair(to.i[k], to.j[k]);
    while (at < from.size() && std::make_pair(from.i[at], from.j[at]) < key) ++at;
    if (at < from.size() && std::make_pair(from.i[at], from.j[at]) == key) out[k] = values[at++];
  }
  return out;
}

void wrap_positions(Packing &p, PairList &pairs) {
  const size_t d = p.dim;
  std::vector<double> shift(p.position.size());
  for (size_t i = 0; i < p.n(); ++i) p.cell.wrap(&p.position[i * d], &shift[i * d]);
  for (size_t k = 0; k < pairs.size(); ++k)
    for (size_t c = 0; c < d && !pairs.wall(k); ++c)
      pairs.offset[k * d + c] += shift[pairs.i[k] * d + c] - shift[pairs.j[k] * d + c];
}

}  // namespace jam::inside
