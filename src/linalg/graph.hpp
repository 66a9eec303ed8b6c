// Undirected graph of the particles: two are neighbours where the matrix has a block.
#pragma once
#include <cstddef>
#include <vector>

#include "core/rng.hpp"

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

// Two sides of a graph and the nodes that separate them.

struct Bisection {
  enum Side : char { left = 0, right = 1, separator = 2 };
  std::vector<char> side;  // of every node; no edge joins left and right
  int64_t weight[3] = {0, 0, 0};
  // Weight of the separator, larger where the sides are uneven.
  double cost() const;
};

// A light separator of two sides of similar weight, by multilevel bisection.
Bisection bisect(const WeightedGraph &graph, Rng &rng);

// Makes the separator lighter by moves of Fiduccia and Mattheyses: a separator node goes to one side, and its
// neighbours on the other side enter the separator.
void refine_separator(const WeightedGraph &graph, Bisection &b, int passes);

// Coarser graphs for the multilevel bisection.

// Joins pairs of neighbours along their heaviest free edge, in a random order of the nodes (G. Karypis and V. Kumar,
// SIAM J. Sci. Comput. 20, 359 (1998)). No node grows heavier than heaviest. parent[v]: the coarse node that holds v.
WeightedGraph coarsen(const WeightedGraph &fine, int32_t heaviest, Rng &rng, std::vector<int32_t> &parent);

// Fill-reducing elimination order of the particle graph.

// Nested dissection; order[k] is the node that is eliminated k-th. A function of the graph alone: no state outside the
// call, no random numbers of the host.
std::vector<int32_t> nested_dissection(const Graph &graph);

// Minimum-degree order of a small part of a graph.

// Order of the nodes 0 .. inner - 1 of g. Those from inner on are eliminated later, elsewhere: they count in the
// degrees (F. Pellegrini, J. Roman and P. Amestoy, Concurrency Pract. Exper. 12, 69 (2000)). Exact degrees, on bit rows
// of the elimination graph: meant for some hundred nodes.
std::vector<int32_t> minimum_degree(const Graph &g, int32_t inner);

}  // namespace jam::inside
