#include "linalg/minimum_degree.hpp"

namespace jam::inside {

std::vector<int32_t> minimum_degree(const Graph &g, int32_t inner) {
  const int32_t n = g.size();
  const size_t words = static_cast<size_t>(n + 63) / 64;
  std::vector<uint64_t> rows(words * n, 0);
  const auto row = [&](int32_t v) { return rows.data() + words * v; };
  const auto clear = [&](int32_t v, int32_t u) { row(v)[u / 64] &= ~(uint64_t{1} << (u % 64)); };
  std::vector<int32_t> degree(n), order, near;
  order.reserve(inner);
  for (int32_t v = 0; v < n; ++v) {
    degree[v] = g.degree(v);
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e)
      row(v)[g.adjacency[e] / 64] |= uint64_t{1} << (g.adjacency[e] % 64);
  }
  std::vector<int32_t> left(inner);
  for (int32_t v = 0; v < inner; ++v) left[v] = v;
  while (!left.empty()) {
    size_t at = 0;
    for (size_t k = 1; k < left.size(); ++k)
      if (degree[left[k]] < degree[left[at]]) at = k;
    const int32_t v = left[at];
    left[at] = left.back(), left.pop_back();
    order.push_back(v);
    near.clear();
    for (size_t w = 0; w < words; ++w)
      for (uint64_t bits = row(v)[w]; bits != 0; bits &= bits - 1)
        near.push_back(static_cast<int32_t>(64 * w) + __builtin_ctzll(bits));
    for (const int32_t u : near) {
      uint64_t *mine = row(u);
      const uint64_t *added = row(v);
      int32_t count = 0;
      for (size_t w = 0; w < words; ++w) count += __builtin_popcountll(mine[w] |= added[w]);
      clear(u, v), clear(u, u);
      degree[u] = count - 2;
    }
  }
  return order;
}

}  // namespace jam::inside
