#include "linalg/coarsening.hpp"

#include <numeric>
#include <utility>

namespace jam::inside {
namespace {

// mate[v]: the node that v is joined with, or v itself.
std::vector<int32_t> match(const WeightedGraph &g, int32_t heaviest, Rng &rng) {
  const int32_t n = g.size();
  std::vector<int32_t> visit(n), mate(n, -1);
  std::iota(visit.begin(), visit.end(), 0);
  uint64_t bits = 0;
  for (int32_t k = n - 1; k > 0; --k) {
    bits = k % 2 ? bits >> 32 : rng.bits();
    std::swap(visit[k], visit[(bits & 0xffffffffu) * static_cast<uint64_t>(k + 1) >> 32]);
  }
  for (const int32_t v : visit) {
    if (mate[v] >= 0) continue;
    int32_t best = v, found = 0;
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e) {
      const int32_t u = g.adjacency[e];
      if (mate[u] < 0 && g.edge_weight[e] > found && g.weight[v] + g.weight[u] <= heaviest)
        best = u, found = g.edge_weight[e];
    }
    mate[v] = best, mate[best] = v;
  }
  return mate;
}

}  // namespace

WeightedGraph coarsen(const WeightedGraph &fine, int32_t heaviest, Rng &rng, std::vector<int32_t> &parent) {
  const int32_t n = fine.size();
  const std::vector<int32_t> mate = match(fine, heaviest, rng);
  parent.resize(n);
  int32_t count = 0;
  for (int32_t v = 0; v < n; ++v)
    if (v <= mate[v]) parent[v] = parent[mate[v]] = count++;
  WeightedGraph out;
  out.start.reserve(count + 1), out.weight.reserve(count);
  out.adjacency.resize(fine.adjacency.size()), out.edge_weight.resize(fine.adjacency.size());
  std::vector<int32_t> slot(count, -1);  // where in out.adjacency the edge to this coarse node stands
  int32_t end = 0;
  out.start.push_back(0);
  for (int32_t v = 0; v < n; ++v) {
    if (v > mate[v]) continue;
    const int32_t begin = end, self = parent[v];
    int32_t weight = 0;
    for (int32_t half : {v, mate[v]}) {
      if (half == v && weight > 0) break;
      weight += fine.weight[half];
      for (int32_t e = fine.start[half]; e < fine.start[half + 1]; ++e) {
        const int32_t to = parent[fine.adjacency[e]];
        if (to == self) continue;
        if (slot[to] < begin) {
          slot[to] = end;
          out.adjacency[end] = to, out.edge_weight[end++] = fine.edge_weight[e];
        } else {
          out.edge_weight[slot[to]] += fine.edge_weight[e];
        }
      }
    }
    out.weight.push_back(weight);
    out.start.push_back(end);
  }
  out.adjacency.resize(end), out.edge_weight.resize(end);
  return out;
}

}  // namespace jam::inside
