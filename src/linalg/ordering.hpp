// Fill-reducing elimination order of the particle graph.
#pragma once
#include "linalg/graph.hpp"

namespace jam::inside {

// Nested dissection; order[k] is the node that is eliminated k-th. A function of the graph alone: no state outside the
// call, no random numbers of the host.
std::vector<int32_t> nested_dissection(const Graph &graph);

}  // namespace jam::inside
