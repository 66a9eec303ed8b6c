// Pair lists: cells against brute force over all images, small boxes, wrapping.
#include <algorithm>
#include <cmath>
#include "test.h"

#include "core/create.hpp"
#include "core/pair_levels.hpp"
#include "core/pair_rule.hpp"
#include "core/tuning.hpp"

using namespace jam::inside;

namespace {

CASE(cells_equal_brute_force) {
  for (int dim = 2; dim <= 5; ++dim) {
    jam_create_options o = default_create_options();
    o.n = dim < 4 ? 700 : 1500, o.dim = dim, o.packing_fraction = dim < 4 ? 0.2 : 0.02, o.box = 2.0;
    std::vector<double> sizes(o.n);
    for (size_t k = 0; k < sizes.size(); ++k) sizes[k] = 1.0 + static_cast<double>(k % 5) * 0.2;
    const Packing p = make_packing(o, nullptr, 0, sizes.data(), sizes.size());
    for (const double slope : {1.0, 1.3}) {
      const double reach = 0.2 * diameter_mean(p);
      const PairList a = find_pairs(p, reach, slope), b = find_pairs_brute(p, reach, slope);
      assert_true(a.size() > 0);
      assert_true(a.i == b.i && a.j == b.j && a.offset == b.offset);
      std::vector<double> own(p.n());
      for (size_t k = 0; k < own.size(); ++k) own[k] = reach * static_cast<double>(k % 4);
      const PairList c = find_pairs(p, own, slope), d = find_pairs_brute(p, own, slope),
                     all = find_pairs(p, 3.0 * reach, slope);
      assert_true(c.i == d.i && c.j == d.j && c.offset == d.offset);
      size_t expected = 0;
      double r[JAM_MAX_DIM];
      for (size_t k = 0; k < all.size(); ++k) {
        const size_t i = all.i[k], j = all.j[k];
        expected += std::sqrt(pair_vector(p, all, k, r)) - slope * 0.5 * (p.diameter[i] + p.diameter[j]) <
                    std::max(own[i], own[j]);
      }
      assert_true(c.size() == expected && expected > 0 && expected < all.size());
    }
  }
}

// Diameters and reaches over a factor of 1 to 50, in cubes and a tilted cell; the largest may fill half the box.
CASE(levels_equal_brute_force) {
  const double tilted[] = {1.0, 0.0, 0.0, 0.4, 1.1, 0.0, -0.3, 0.2, 1.4};
  for (const int dim : {2, 3})
    for (const double ratio : {1.9, 4.0, 50.0})
      for (const bool one_large : {false, true})
        for (const bool cube : {true, false}) {
          if (dim == 2 && !cube) continue;
          jam_create_options o = default_create_options();
          o.n = 600, o.dim = dim, o.packing_fraction = one_large ? 0.3 : 0.1;
          std::vector<double> sizes(o.n, 1.0);
          for (int k = 0; k < o.n; ++k)
            sizes[k] = std::pow(ratio, one_large ? (k == 37 ? 1.0 : 0.0) : ((k * 7) % o.n) / (o.n - 1.0));
          const Packing p = make_packing(o, nullptr, 0, sizes.data(), sizes.size(), cube ? nullptr : tilted);
          const double reach = 0.3 * diameter_mean(p);
          std::vector<double> own(p.n());
          for (size_t k = 0; k < own.size(); ++k) own[k] = reach * std::pow(40.0, ((k * 11) % 13) / 12.0) / 20.0;
          const PairList a = find_pairs(p, reach, 1.2), b = find_pairs_brute(p, reach, 1.2);
          assert_true(a.size() > 0 && a.i == b.i && a.j == b.j && a.offset == b.offset);
          const PairList c = find_pairs(p, own, 1.0), d = find_pairs_brute(p, own, 1.0);
          assert_true(c.size() > 0 && c.i == d.i && c.j == d.j && c.offset == d.offset);
          std::vector<char> some(p.n(), 0);
          for (size_t k = 0; k < p.n(); k += 3) some[k] = 1, own[k] *= k % 2 ? 4.0 : 0.25;
          const PairList e = replace_pairs(c, some, find_pairs_of(p, some, own, 1.0)),
                         f = find_pairs_brute(p, own, 1.0);
          assert_true(e.size() > c.size() && e.i == f.i && e.j == f.j && e.offset == f.offset);
        }
}

CASE(wrapping_keeps_vectors) {
  jam_create_options o = default_create_options();
  o.n = 200, o.packing_fraction = 0.3;
  Packing p = make_packing(o, nullptr, 0, nullptr, 0);
  PairList pairs = find_pairs(p, 0.05, 1.0);
  for (size_t k = 0; k < p.position.size(); ++k) p.position[k] += (k % 7) * 0.4 - 1.2;
  Packing q = p;
  PairList moved = pairs;
  wrap_positions(q, moved);
  double a[3], b[3];
  for (double x : q.position) assert_true(x >= 0.0 && x < 1.0);
  for (size_t k = 0; k < pairs.size(); ++k) {
    pair_vector(p, pairs, k, a);
    pair_vector(q, moved, k, b);
    for (int c = 0; c < 3; ++c) assert_true(std::fabs(a[c] - b[c]) < 1e-14);
  }
}

// Values stay with their pairs, image by image; new pairs get 0.
CASE(values_carried_over) {
  PairList from, to;
  from.i = {0, 0, 1, 2}, from.j = {1, 1, 2, 5};
  to.i = {0, 0, 0, 0, 2, 3}, to.j = {1, 1, 1, 2, 5, 4};
  const std::vector<double> out = carry_over(from, {1, 2, 3, 4}, to), wanted = {1, 2, 0, 0, 4, 0};
  assert_true(out == wanted);
  assert_true(carry_over(PairList(), {}, to) == std::vector<double>(6, 0.0));
}

// From so many spheres on they are searched along a curve. The list is that of the numbers all the same, and those
// that are only visited are the same pairs.
CASE(many_spheres_by_distance_to_all) {
  for (const bool levels : {false, true}) {
    jam_create_options o = default_create_options();
    o.n = static_cast<int32_t>(PairListTuning::along_curve_from), o.dim = 2, o.packing_fraction = 0.2;
    std::vector<double> sizes(o.n, 1.0);
    for (size_t k = 0; levels && k < sizes.size(); k += 1000) sizes[k] = 20.0;
    const Packing p = make_packing(o, nullptr, 0, sizes.data(), sizes.size());
    const PairList all = find_pairs(p, 0.0, 1.5);
    double r[JAM_MAX_DIM];
    ClosestPair least{HUGE_VAL, -1, -1};
    for (size_t k = 0; k < all.size(); ++k) {
      if (k > 0) assert_true(std::make_pair(all.i[k - 1], all.j[k - 1]) < std::make_pair(all.i[k], all.j[k]));
      const double gap = std::sqrt(pair_vector(p, all, k, r)) / contact_distance(p, all.i[k], all.j[k]) - 1.0;
      if (gap < least.gap) least = {gap, all.i[k], all.j[k]};
    }
    const ClosestPair found = closest_pair(p);
    assert_true(found.gap == least.gap && found.i == least.i && found.j == least.j);
    for (int32_t i = 0; i < o.n; i += o.n / 50) {  // pairs with all others
      std::vector<size_t> listed;
      for (size_t k = 0; k < all.size(); ++k)
        if (all.i[k] == i || all.j[k] == i) listed.push_back(k);
      size_t at = 0;
      for (int32_t j = 0; j < o.n; ++j) {
        if (j == i) continue;
        const int32_t a = std::min(i, j), b = std::max(i, j);
        double dx[2], shift[2], r2 = 0.0;
        for (size_t c = 0; c < 2; ++c) dx[c] = p.position[2 * a + c] - p.position[2 * b + c];
        p.cell.nearest_shift(dx, shift);
        for (size_t c = 0; c < 2; ++c) r2 += (dx[c] + shift[c]) * (dx[c] + shift[c]);
        if (!(std::sqrt(r2) < 1.5 * contact_distance(p, a, b))) continue;
        assert_true(at < listed.size());
        const size_t k = listed[at++];
        assert_true(all.i[k] == a && all.j[k] == b && all.offset[2 * k] == shift[0] &&
                    all.offset[2 * k + 1] == shift[1]);
      }
      assert_int_equal(at, listed.size());
    }
    std::vector<std::pair<int32_t, int32_t>> visited;
    visit_pairs(p, 0.0, 1.5, [&](const PairList &part) {
      for (size_t k = 0; k < part.size(); ++k) visited.emplace_back(part.i[k], part.j[k]);
    });
    std::sort(visited.begin(), visited.end());
    assert_int_equal(visited.size(), all.size());
    for (size_t k = 0; k < all.size(); ++k) assert_true(visited[k] == std::make_pair(all.i[k], all.j[k]));
  }
}

}  // namespace
