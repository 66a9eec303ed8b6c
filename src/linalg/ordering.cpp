// Nested dissection: two sides first, each dissected in turn, their separator last. Small parts: minimum degree.
#include <algorithm>
#include <numeric>

#include "core/call_scope.hpp"
#include "linalg/graph.hpp"
#include "linalg/tuning.hpp"

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
