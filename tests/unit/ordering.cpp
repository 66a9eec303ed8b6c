// Nested dissection: every order is a permutation and a function of the graph alone. On a square grid its fill keeps
// the bound of the theory.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/rng.hpp"
#include "linalg/graph.hpp"
#include "test.h"

using namespace jam::inside;

namespace {

Graph random_graph(int32_t n, double degree, int64_t seed) {
  Rng rng(seed, Stream::velocities);
  std::set<std::pair<int32_t, int32_t>> pairs;
  for (int64_t k = 0; k < static_cast<int64_t>(0.5 * degree * n); ++k) {
    const auto a = static_cast<int32_t>(rng.uniform() * n), b = static_cast<int32_t>(rng.uniform() * n);
    if (a != b) pairs.insert({std::min(a, b), std::max(a, b)});
  }
  std::vector<int32_t> i, j;
  for (const auto &p : pairs) i.push_back(p.first), j.push_back(p.second);
  return make_graph(n, i.data(), j.data(), i.size());
}

// side x side points, each joined with its eight neighbours.
Graph square_grid(int32_t side) {
  std::vector<int32_t> i, j;
  for (int32_t x = 0; x < side; ++x)
    for (int32_t y = 0; y < side; ++y)
      for (const auto &s : {std::pair<int, int>{1, 0}, {0, 1}, {1, 1}, {1, -1}})
        if (x + s.first < side && y + s.second >= 0 && y + s.second < side)
          i.push_back(x * side + y), j.push_back((x + s.first) * side + y + s.second);
  return make_graph(side * side, i.data(), j.data(), i.size());
}

// Entries of the factor, by elimination on sets.
double fill(const Graph &g, const std::vector<int32_t> &order) {
  std::vector<std::set<int32_t>> near(g.size());
  for (int32_t v = 0; v < g.size(); ++v)
    near[v].insert(g.adjacency.begin() + g.start[v], g.adjacency.begin() + g.start[v + 1]);
  double sum = 0.0;
  for (const int32_t v : order) {
    sum += 1.0 + static_cast<double>(near[v].size());
    for (const int32_t a : near[v]) {
      near[a].erase(v);
      for (const int32_t b : near[v])
        if (a != b) near[a].insert(b);
    }
  }
  return sum;
}

CASE(orders_are_permutations) {
  for (const int32_t n : {1, 2, 3, 50, 101, 3000})
    for (const double degree : {0.0, 0.5, 3.0, 12.0, 60.0}) {
      const Graph g = random_graph(n, degree, n);
      std::vector<int32_t> order = nested_dissection(g);
      assert_true(order == nested_dissection(g));
      assert_int_equal(order.size(), n);
      std::sort(order.begin(), order.end());
      for (int32_t k = 0; k < n; ++k) assert_int_equal(order[k], k);
    }
  const Graph complete = random_graph(300, 3000.0, 1);  // nearly complete: nothing separates it
  assert_int_equal(nested_dissection(complete).size(), 300);
}

// A. George, SIAM J. Numer. Anal. 10, 345 (1973): nested dissection of a square grid of n points by its lines leaves at
// most 31/4 n log2 n entries. Minimum degree on the leaves stays far below it.
CASE(fill_of_a_grid) {
  for (const int32_t side : {16, 33, 70}) {
    const double n = side * side, entries = fill(square_grid(side), nested_dissection(square_grid(side)));
    assert_true(entries < 0.5 * 7.75 * n * std::log2(n));
    assert_true(entries > 4.0 * n);  // the edges themselves and the diagonal
  }
}

CASE(separators_separate) {
  for (const int32_t n : {60, 700, 4000}) {
    WeightedGraph g;
    static_cast<Graph &>(g) = random_graph(n, 5.0, 3);
    g.weight.assign(n, 1), g.edge_weight.assign(g.adjacency.size(), 1);
    Rng rng(1, Stream::analysis_start);
    const Bisection b = bisect(g, rng);
    int64_t weight[3] = {0, 0, 0};
    for (int32_t v = 0; v < n; ++v) {
      ++weight[static_cast<int>(b.side[v])];
      for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e)
        assert_true(b.side[v] == Bisection::separator || b.side[g.adjacency[e]] == Bisection::separator ||
                    b.side[v] == b.side[g.adjacency[e]]);
    }
    for (int s = 0; s < 3; ++s) assert_int_equal(weight[s], b.weight[s]);
    assert_true(weight[0] > n / 5 && weight[1] > n / 5);
  }
  // Two sheets of a grid that one column joins: the column is the separator.
  const Graph sheet = square_grid(31);
  WeightedGraph g;
  static_cast<Graph &>(g) = sheet;
  g.weight.assign(sheet.size(), 1), g.edge_weight.assign(sheet.adjacency.size(), 1);
  Rng rng(1, Stream::analysis_start);
  assert_true(bisect(g, rng).weight[2] <= 33);
}

// A star with its centre in the halo: leaves have degree one and come in any order; with the centre inside, it is last
// but one at the earliest.
CASE(minimum_degree_of_small_graphs) {
  std::vector<int32_t> i(9, 0), j{1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<int32_t> order = minimum_degree(make_graph(10, i.data(), j.data(), 9), 10);
  assert_true(order[9] == 0 || order[8] == 0);
  // A path 0 - 1 - 2 whose ends 3 and 4 belong to the halo, 3 joined with 0 and 5: without the halo 0 would be first.
  const std::vector<int32_t> a{0, 1, 0, 0, 0}, b{1, 2, 3, 4, 5};
  assert_int_equal(minimum_degree(make_graph(6, a.data(), b.data(), 5), 3)[0], 2);
}

}  // namespace
