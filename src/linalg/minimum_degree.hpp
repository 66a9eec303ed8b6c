// Minimum-degree order of a small part of a graph.
#pragma once
#include "linalg/graph.hpp"

namespace jam::inside {

// Order of the nodes 0 .. inner - 1 of g. Those from inner on are eliminated later, elsewhere: they count in the
// degrees (F. Pellegrini, J. Roman and P. Amestoy, Concurrency Pract. Exper. 12, 69 (2000)). Exact degrees, on bit rows
// of the elimination graph: meant for some hundred nodes.
std::vector<int32_t> minimum_degree(const Graph &g, int32_t inner);

}  // namespace jam::inside
