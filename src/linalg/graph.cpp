#include "linalg/graph.hpp"

#include <numeric>

namespace jam::inside {

Graph make_graph(int32_t n, const int32_t *ei, const int32_t *ej, size_t edges) {
  Graph g;
  g.start.assign(static_cast<size_t>(n) + 1, 0);
  for (size_t k = 0; k < edges; ++k) ++g.start[ei[k] + 1], ++g.start[ej[k] + 1];
  for (int32_t v = 0; v < n; ++v) g.start[v + 1] += g.start[v];
  g.adjacency.resize(2 * edges);
  std::vector<int32_t> fill(g.start.begin(), g.start.end() - 1);
  for (size_t k = 0; k < edges; ++k) {
    g.adjacency[fill[ei[k]]++] = ej[k];
    g.adjacency[fill[ej[k]]++] = ei[k];
  }
  return g;
}

int64_t WeightedGraph::total_weight() const { return std::accumulate(weight.begin(), weight.end(), int64_t{0}); }

}  // namespace jam::inside
