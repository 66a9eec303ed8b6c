// Multilevel bisection: coarsen, separate the coarsest graph, and refine the separator on the way back.
#include "linalg/vertex_separator.hpp"

#include "linalg/coarsening.hpp"
#include "linalg/tuning.hpp"

namespace jam::inside {
namespace {

using Tuning = OrderingTuning;

// Grows the left side by breadth from a node to half the weight; its neighbours become the separator.
Bisection grow(const WeightedGraph &g, int32_t seed) {
  const int32_t n = g.size();
  Bisection b;
  b.side.assign(n, Bisection::right);
  b.weight[1] = g.total_weight();
  const int64_t half = b.weight[1] / 2;
  std::vector<int32_t> front{seed};
  front.reserve(n);
  std::vector<char> seen(n, 0);
  seen[seed] = 1;
  int32_t fresh = 0;
  for (size_t k = 0; b.weight[0] < half; ++k) {
    if (k == front.size()) {  // this component is used up
      while (seen[fresh]) ++fresh;
      seen[fresh] = 1, front.push_back(fresh);
    }
    const int32_t v = front[k];
    b.side[v] = Bisection::left, b.weight[0] += g.weight[v], b.weight[1] -= g.weight[v];
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e)
      if (!seen[g.adjacency[e]]) seen[g.adjacency[e]] = 1, front.push_back(g.adjacency[e]);
  }
  for (int32_t v = 0; v < n; ++v) {
    if (b.side[v] != Bisection::right) continue;
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e)
      if (b.side[g.adjacency[e]] == Bisection::left) {
        b.side[v] = Bisection::separator, b.weight[1] -= g.weight[v], b.weight[2] += g.weight[v];
        break;
      }
  }
  return b;
}

Bisection separate_coarsest(const WeightedGraph &g, Rng &rng) {
  Bisection best;
  for (int start = 0; start < Tuning::starts; ++start) {
    Bisection b = grow(g, static_cast<int32_t>(rng.bits() % static_cast<uint64_t>(g.size())));
    refine_separator(g, b, Tuning::passes);
    if (start == 0 || b.cost() < best.cost()) best = std::move(b);
  }
  return best;
}

Bisection project(const WeightedGraph &fine, const std::vector<int32_t> &parent, const Bisection &coarse) {
  Bisection b;
  b.side.resize(fine.size());
  for (int32_t v = 0; v < fine.size(); ++v) b.side[v] = coarse.side[parent[v]];
  for (int s = 0; s < 3; ++s) b.weight[s] = coarse.weight[s];
  return b;
}

// Several runs start from the level `runs_at` nodes; 0: one run.
Bisection multilevel(const WeightedGraph &g, int32_t runs_at, Rng &rng) {
  if (g.size() <= Tuning::coarsest) return separate_coarsest(g, rng);
  if (g.size() <= runs_at) {
    Bisection best;
    for (int run = 0; run < Tuning::runs; ++run) {
      Bisection b = multilevel(g, 0, rng);
      if (run == 0 || b.cost() < best.cost()) best = std::move(b);
    }
    return best;
  }
  std::vector<int32_t> parent;
  const auto heaviest = static_cast<int32_t>(1 + 3 * g.total_weight() / (2 * Tuning::coarsest));
  const WeightedGraph coarse = coarsen(g, heaviest, rng, parent);
  if (coarse.size() > Tuning::still_coarser * g.size()) return separate_coarsest(g, rng);
  Bisection b = project(g, parent, multilevel(coarse, runs_at, rng));
  refine_separator(g, b, Tuning::passes);
  return b;
}

}  // namespace

Bisection bisect(const WeightedGraph &graph, Rng &rng) {
  return multilevel(graph, graph.size() > Tuning::several_runs ? graph.size() / Tuning::run_level : 0, rng);
}

}  // namespace jam::inside
