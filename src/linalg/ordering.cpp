#include "linalg/ordering.hpp"

#include <metis.h>

#include <mutex>
#include <new>
#include <numeric>

#include "core/error.hpp"

namespace jam {

Graph make_rigidity_matrix(int32_t n, const int32_t *ei, const int32_t *ej, size_t edges) {
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

std::vector<int32_t> nested_dissection(const Graph &graph) {
  static_assert(sizeof(idx_t) == sizeof(int32_t), "METIS with 32-bit indices is expected");
  idx_t n = graph.size();
  std::vector<int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  if (n < 3 || graph.adjacency.empty()) return order;
  std::vector<idx_t> start(graph.start.begin(), graph.start.end()),
      adjacency(graph.adjacency.begin(), graph.adjacency.end());
  std::vector<idx_t> inverse(n);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  static std::mutex lock;
  const std::lock_guard<std::mutex> hold(lock);
  const int status = METIS_NodeND(&n, start.data(), adjacency.data(), nullptr, options, order.data(), inverse.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (status != METIS_OK) fail(JAM_E_INTERNAL, "METIS_NodeND returned %d", status);
  return order;
}

std::vector<int32_t> order_nodes(const Graph &graph, Ordering which) {
  if (which == Ordering::metis) return nested_dissection(graph);
  if (which == Ordering::dissection) return order_by_dissection(graph);
  std::vector<int32_t> order(graph.size());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace jam
