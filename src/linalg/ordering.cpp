// Nested dissection: two sides first, each dissected in turn, their separator last. Small parts: minimum degree.
#include "linalg/ordering.hpp"

#include <algorithm>
#include <numeric>

#include "core/call_scope.hpp"
#include "linalg/minimum_degree.hpp"
#include "linalg/tuning.hpp"
#include "linalg/vertex_separator.hpp"

namespace jam::inside {
namespace {

class Dissection {
 public:
  explicit Dissection(const Graph &graph) : g_(graph), order_(graph.size()), local_(graph.size(), -1) {}
  std::vector<int32_t> run();

 private:
  struct Part {
    std::vector<int32_t> nodes;
    int32_t end;  // one past its last place in the order
  };
  void order_leaf(const Part &part);
  WeightedGraph subgraph(const std::vector<int32_t> &nodes);

  const Graph &g_;
  std::vector<int32_t> order_, local_;
  std::vector<Part> parts_;
};

WeightedGraph Dissection::subgraph(const std::vector<int32_t> &nodes) {
  for (size_t k = 0; k < nodes.size(); ++k) local_[nodes[k]] = static_cast<int32_t>(k);
  WeightedGraph out;
  out.start.reserve(nodes.size() + 1);
  out.start.push_back(0);
  for (const int32_t v : nodes) {
    for (int32_t e = g_.start[v]; e < g_.start[v + 1]; ++e)
      if (local_[g_.adjacency[e]] >= 0) out.adjacency.push_back(local_[g_.adjacency[e]]);
    out.start.push_back(static_cast<int32_t>(out.adjacency.size()));
  }
  for (const int32_t v : nodes) local_[v] = -1;
  out.weight.assign(nodes.size(), 1);
  out.edge_weight.assign(out.adjacency.size(), 1);
  return out;
}

// The part and the nodes around it, which belong to separators and come later.
void Dissection::order_leaf(const Part &part) {
  std::vector<int32_t> nodes = part.nodes;
  for (size_t k = 0; k < nodes.size(); ++k) local_[nodes[k]] = static_cast<int32_t>(k);
  const auto inner = static_cast<int32_t>(part.nodes.size());
  for (int32_t k = 0; k < inner; ++k)
    for (int32_t e = g_.start[nodes[k]]; e < g_.start[nodes[k] + 1]; ++e) {
      const int32_t u = g_.adjacency[e];
      if (local_[u] < 0) local_[u] = static_cast<int32_t>(nodes.size()), nodes.push_back(u);
    }
  for (const int32_t v : nodes) local_[v] = -1;
  const std::vector<int32_t> places = minimum_degree(subgraph(nodes), inner);
  for (int32_t k = 0; k < inner; ++k) order_[part.end - inner + k] = nodes[places[k]];
}

std::vector<int32_t> Dissection::run() {
  Rng rng(g_.size(), Stream::analysis_start);
  std::vector<int32_t> all(g_.size());
  std::iota(all.begin(), all.end(), 0);
  parts_.push_back({std::move(all), g_.size()});
  while (!parts_.empty()) {
    CallScope::look();
    const Part part = std::move(parts_.back());
    parts_.pop_back();
    const auto size = static_cast<int32_t>(part.nodes.size());
    if (size <= OrderingTuning::leaf) {
      order_leaf(part);
      continue;
    }
    const Bisection b = bisect(subgraph(part.nodes), rng);
    std::vector<int32_t> list[3];
    for (int32_t k = 0; k < size; ++k) list[static_cast<int>(b.side[k])].push_back(part.nodes[k]);
    if (list[0].empty() || list[1].empty()) {  // nearly complete: nothing to separate
      std::copy(part.nodes.begin(), part.nodes.end(), order_.begin() + (part.end - size));
      continue;
    }
    const auto separator = static_cast<int32_t>(list[2].size()), right = static_cast<int32_t>(list[1].size());
    std::copy(list[2].begin(), list[2].end(), order_.begin() + (part.end - separator));
    parts_.push_back({std::move(list[0]), part.end - separator - right});
    parts_.push_back({std::move(list[1]), part.end - separator});
  }
  return std::move(order_);
}

}  // namespace

std::vector<int32_t> nested_dissection(const Graph &graph) { return Dissection(graph).run(); }

}  // namespace jam::inside
