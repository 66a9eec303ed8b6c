// Fill-reducing order of the particle graph.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace jam {

// Graph in compressed form: neighbours of v are adjacency[start[v] .. start[v + 1]), symmetric, no loops.
struct Graph {
  std::vector<int32_t> start, adjacency;
  int32_t size() const { return static_cast<int32_t>(start.size()) - 1; }
};
Graph make_rigidity_matrix(int32_t n, const int32_t *ei, const int32_t *ej, size_t edges);

enum class Ordering : int32_t {
  dissection = 0,  // own multilevel nested dissection: no state outside the call, one result for one graph
  metis = 1,
  natural = 2,
};
// order[k] = the node eliminated k-th.
std::vector<int32_t> order_nodes(const Graph &graph, Ordering which);
std::vector<int32_t> order_by_dissection(const Graph &graph);

// By METIS nested dissection. METIS 5 draws from the C library's rand and traps signals
// while it runs; calls are serialised here.
std::vector<int32_t> nested_dissection(const Graph &graph);

}  // namespace jam
