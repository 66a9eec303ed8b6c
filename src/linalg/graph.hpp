// Undirected graph of the particles: two are neighbours where the matrix has a block.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace jam::inside {

// Neighbours of v are adjacency[start[v] .. start[v + 1]), symmetric, no loops.
struct Graph {
  std::vector<int32_t> start, adjacency;
  int32_t size() const { return static_cast<int32_t>(start.size()) - 1; }
  int32_t degree(int32_t v) const { return start[v + 1] - start[v]; }
};
Graph make_graph(int32_t n, const int32_t *ei, const int32_t *ej, size_t edges);

// A graph whose nodes and edges stand for several of a finer graph.
struct WeightedGraph : Graph {
  std::vector<int32_t> weight;       // of the nodes
  std::vector<int32_t> edge_weight;  // as long as adjacency
  int64_t total_weight() const;
};

}  // namespace jam::inside
