// Multilevel nested dissection with separators of nodes: shrink the graph by heavy-edge matching, grow a part on the
// smallest graph, refine the separator at every level (Karypis and Kumar, SIAM J. Sci. Comput. 20 (1998) 359; the moves
// after Ashcraft and Liu, SIAM J. Matrix Anal. Appl. 19 (1998) 325). Leaves: minimum degree. Everything is a function
// of the graph alone.
#include <algorithm>
#include <numeric>
#include <set>

#include "core/rng.hpp"
#include "linalg/ordering.hpp"

namespace jam {
namespace {

constexpr int32_t kLeaf = 60;       // nodes ordered by minimum degree
constexpr int32_t kCoarsest = 120;  // no further shrinking
constexpr int kTrials = 8;          // starts on the smallest graph
constexpr double kBalance = 0.56;   // largest part of the weight a side may hold
enum : char { kLeft = 0, kRight = 1, kSeparator = 2 };

struct Level {
  Graph graph;
  std::vector<int32_t> weight, edge_weight;  // of nodes, of graph.adjacency
  std::vector<int32_t> coarse;               // node of the next level
};

int64_t total(const std::vector<int32_t> &w) { return std::accumulate(w.begin(), w.end(), int64_t{0}); }

Level shrink(Level &fine, Rng &rng) {
  const Graph &g = fine.graph;
  const int32_t n = g.size();
  std::vector<int32_t> visit(n), mate(n, -1);
  std::iota(visit.begin(), visit.end(), 0);
  for (int32_t k = n - 1; k > 0; --k) std::swap(visit[k], visit[rng.bits() % static_cast<uint64_t>(k + 1)]);
  fine.coarse.assign(n, -1);
  Level out;
  int32_t count = 0;
  for (int32_t v : visit) {
    if (mate[v] >= 0) continue;
    int32_t best = v, heaviest = 0;
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e) {
      const int32_t u = g.adjacency[e];
      if (mate[u] < 0 && fine.edge_weight[e] > heaviest) best = u, heaviest = fine.edge_weight[e];
    }
    mate[v] = best, mate[best] = v;
    fine.coarse[v] = fine.coarse[best] = count++;
    out.weight.push_back(fine.weight[v] + (best != v ? fine.weight[best] : 0));
  }
  std::vector<int32_t> head(count, -1), seen(count, -1);
  for (int32_t v = 0; v < n; ++v)
    if (v <= mate[v]) head[fine.coarse[v]] = v;
  out.graph.start.assign(1, 0);
  for (int32_t c = 0; c < count; ++c) {
    const int32_t begin = out.graph.start.back(), pair[2] = {head[c], mate[head[c]]};
    for (int half = 0; half < (pair[0] == pair[1] ? 1 : 2); ++half)
      for (int32_t e = g.start[pair[half]]; e < g.start[pair[half] + 1]; ++e) {
        const int32_t to = fine.coarse[g.adjacency[e]];
        if (to == c) continue;
        if (seen[to] < begin) {
          seen[to] = static_cast<int32_t>(out.graph.adjacency.size());
          out.graph.adjacency.push_back(to), out.edge_weight.push_back(fine.edge_weight[e]);
        } else {
          out.edge_weight[seen[to]] += fine.edge_weight[e];
        }
      }
    out.graph.start.push_back(static_cast<int32_t>(out.graph.adjacency.size()));
  }
  return out;
}

struct Split {
  std::vector<char> side;
  int64_t weight[3] = {0, 0, 0};
  // Separator first; a side that is too heavy costs more than any separator.
  double cost() const {
    const double all = static_cast<double>(weight[0] + weight[1] + weight[2]),
                 most = static_cast<double>(std::max(weight[0], weight[1]));
    const double over = std::max(0.0, most - kBalance * all);
    return static_cast<double>(weight[2]) * (1.0 + 0.3 * (most / all - 0.5)) + 10.0 * over;
  }
};

// Passes of Fiduccia and Mattheyses on the separator: a node moves to a side and draws its neighbours on the other side
// into the separator; best gain first, each node once a pass; the best split seen is kept.
void refine(const Level &level, Split &s, int passes) {
  const Graph &g = level.graph;
  const int32_t n = g.size();
  const auto gain = [&](int32_t v, int to) {
    int64_t drawn = 0;
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e)
      if (s.side[g.adjacency[e]] == 1 - to) drawn += level.weight[g.adjacency[e]];
    return static_cast<int64_t>(level.weight[v]) - drawn;
  };
  std::vector<std::pair<int32_t, char>> moved;  // node and the side it was on
  for (int pass = 0; pass < passes; ++pass) {
    std::set<std::pair<int64_t, int32_t>> queue[2];
    std::vector<int64_t> key[2] = {std::vector<int64_t>(n), std::vector<int64_t>(n)};
    std::vector<char> locked(n, 0), queued(n, 0);
    const auto enter = [&](int32_t v) {
      if (locked[v]) return;
      for (int to = 0; to < 2; ++to) {
        if (queued[v]) queue[to].erase({key[to][v], v});
        key[to][v] = -gain(v, to);
        queue[to].insert({key[to][v], v});
      }
      queued[v] = 1;
    };
    const auto leave = [&](int32_t v) {
      if (queued[v])
        for (int to = 0; to < 2; ++to) queue[to].erase({key[to][v], v});
      queued[v] = 0;
    };
    for (int32_t v = 0; v < n; ++v)
      if (s.side[v] == kSeparator) enter(v);
    moved.clear();
    const double before = s.cost();
    double best = before;
    size_t best_at = 0;
    int since = 0;
    while (!(queue[0].empty() && queue[1].empty()) && since < 60 + n / 40) {
      int to = s.weight[0] <= s.weight[1] ? 0 : 1;
      const double all = static_cast<double>(s.weight[0] + s.weight[1] + s.weight[2]);
      if (queue[to].empty()) break;
      if (queue[1 - to].begin()->first < queue[to].begin()->first &&
          static_cast<double>(s.weight[1 - to]) < kBalance * all)
        to = 1 - to;
      const int32_t v = queue[to].begin()->second;
      const auto set_side = [&](int32_t u, char side) {
        moved.push_back({u, s.side[u]});
        s.weight[static_cast<int>(s.side[u])] -= level.weight[u], s.weight[static_cast<int>(side)] += level.weight[u];
        s.side[u] = side;
      };
      leave(v);
      locked[v] = 1;
      set_side(v, static_cast<char>(to));
      for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e) {
        const int32_t u = g.adjacency[e];
        if (s.side[u] == kSeparator) enter(u);
        if (s.side[u] != 1 - to) continue;
        set_side(u, kSeparator);
        enter(u);
        for (int32_t f = g.start[u]; f < g.start[u + 1]; ++f)
          if (s.side[g.adjacency[f]] == kSeparator && g.adjacency[f] != u) enter(g.adjacency[f]);
      }
      ++since;
      if (s.cost() < best) best = s.cost(), best_at = moved.size(), since = 0;
    }
    for (size_t k = moved.size(); k > best_at; --k) {
      const auto [v, side] = moved[k - 1];
      s.weight[static_cast<int>(s.side[v])] -= level.weight[v], s.weight[static_cast<int>(side)] += level.weight[v];
      s.side[v] = side;
    }
    if (!(best < before)) break;
  }
}

// Grows the left side by breadth from a node to half the weight; the nodes it touches last are the separator.
Split grow(const Level &level, int32_t seed) {
  const Graph &g = level.graph;
  Split s;
  s.side.assign(g.size(), kRight);
  s.weight[1] = total(level.weight);
  const int64_t half = s.weight[1] / 2;
  std::vector<int32_t> front{seed};
  std::vector<char> seen(g.size(), 0);
  seen[seed] = 1;
  for (size_t k = 0, fresh = 0; s.weight[0] < half; ++k) {
    if (k == front.size()) {  // another component
      while (seen[fresh]) ++fresh;
      seen[fresh] = 1, front.push_back(static_cast<int32_t>(fresh));
    }
    const int32_t v = front[k];
    s.side[v] = kLeft, s.weight[0] += level.weight[v], s.weight[1] -= level.weight[v];
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e)
      if (!seen[g.adjacency[e]]) seen[g.adjacency[e]] = 1, front.push_back(g.adjacency[e]);
  }
  for (int32_t v = 0; v < g.size(); ++v) {
    if (s.side[v] != kRight) continue;
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e)
      if (s.side[g.adjacency[e]] == kLeft) {
        s.side[v] = kSeparator, s.weight[1] -= level.weight[v], s.weight[2] += level.weight[v];
        break;
      }
  }
  return s;
}

std::vector<char> bisect(const Graph &graph, Rng &rng) {
  std::vector<Level> levels(1);
  levels[0].graph = graph;
  levels[0].weight.assign(graph.size(), 1);
  levels[0].edge_weight.assign(graph.adjacency.size(), 1);
  while (levels.back().graph.size() > kCoarsest) {
    Level next = shrink(levels.back(), rng);
    if (next.graph.size() > 0.95 * levels.back().graph.size()) break;
    levels.push_back(std::move(next));
  }
  Split best;
  for (int trial = 0; trial < kTrials; ++trial) {
    Split s = grow(levels.back(), static_cast<int32_t>(rng.bits() % static_cast<uint64_t>(levels.back().graph.size())));
    refine(levels.back(), s, 6);
    if (trial == 0 || s.cost() < best.cost()) best = std::move(s);
  }
  for (size_t k = levels.size() - 1; k-- > 0;) {
    Split fine;
    fine.side.resize(levels[k].graph.size());
    for (int32_t v = 0; v < levels[k].graph.size(); ++v) {
      fine.side[v] = best.side[levels[k].coarse[v]];
      fine.weight[static_cast<int>(fine.side[v])] += levels[k].weight[v];
    }
    refine(levels[k], fine, 4);
    best = std::move(fine);
  }
  return best.side;
}

// Minimum degree on the explicit elimination graph of a few nodes.
std::vector<int32_t> minimum_degree(const Graph &g) {
  const int32_t n = g.size();
  std::vector<std::vector<char>> joined(n, std::vector<char>(n, 0));
  std::vector<int32_t> degree(n), order;
  std::vector<char> gone(n, 0);
  for (int32_t v = 0; v < n; ++v) {
    degree[v] = g.start[v + 1] - g.start[v];
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e) joined[v][g.adjacency[e]] = 1;
  }
  while (static_cast<int32_t>(order.size()) < n) {
    int32_t v = -1;
    for (int32_t u = 0; u < n; ++u)
      if (!gone[u] && (v < 0 || degree[u] < degree[v])) v = u;
    gone[v] = 1;
    order.push_back(v);
    std::vector<int32_t> near;
    for (int32_t u = 0; u < n; ++u)
      if (!gone[u] && joined[v][u]) near.push_back(u), --degree[u];
    for (int32_t a : near)
      for (int32_t b : near)
        if (a != b && !joined[a][b]) joined[a][b] = 1, ++degree[a];
  }
  return order;
}

Graph subgraph(const Graph &g, const std::vector<int32_t> &nodes, std::vector<int32_t> &local) {
  for (size_t k = 0; k < nodes.size(); ++k) local[nodes[k]] = static_cast<int32_t>(k);
  Graph out;
  out.start.assign(1, 0);
  for (int32_t v : nodes) {
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e)
      if (local[g.adjacency[e]] >= 0) out.adjacency.push_back(local[g.adjacency[e]]);
    out.start.push_back(static_cast<int32_t>(out.adjacency.size()));
  }
  for (int32_t v : nodes) local[v] = -1;
  return out;
}

}  // namespace

std::vector<int32_t> order_by_dissection(const Graph &graph) {
  struct Part {
    std::vector<int32_t> nodes;
    int32_t end;  // one past its last place in the order
  };
  std::vector<int32_t> order(graph.size()), local(graph.size(), -1);
  std::vector<Part> parts(1);
  parts[0].nodes.resize(graph.size());
  std::iota(parts[0].nodes.begin(), parts[0].nodes.end(), 0);
  parts[0].end = graph.size();
  Rng rng(graph.size(), Stream::analysis_start);
  while (!parts.empty()) {
    const Part part = std::move(parts.back());
    parts.pop_back();
    if (part.nodes.empty()) continue;
    const Graph g = subgraph(graph, part.nodes, local);
    const auto size = static_cast<int32_t>(part.nodes.size());
    std::vector<char> side;
    std::vector<int32_t> list[3];
    if (size > kLeaf) {
      side = bisect(g, rng);
      for (int32_t k = 0; k < size; ++k) list[static_cast<int>(side[k])].push_back(part.nodes[k]);
    }
    if (size <= kLeaf) {
      const std::vector<int32_t> inner = minimum_degree(g);
      for (int32_t k = 0; k < size; ++k) order[part.end - size + k] = part.nodes[inner[k]];
      continue;
    }
    if (list[0].empty() || list[1].empty()) {  // nearly complete: nothing to separate
      for (int32_t k = 0; k < size; ++k) order[part.end - size + k] = part.nodes[k];
      continue;
    }
    const auto in_separator = static_cast<int32_t>(list[2].size()), right = static_cast<int32_t>(list[1].size());
    std::copy(list[2].begin(), list[2].end(), order.begin() + (part.end - in_separator));
    parts.push_back({std::move(list[0]), part.end - in_separator - right});
    parts.push_back({std::move(list[1]), part.end - in_separator});
  }
  return order;
}

}  // namespace jam
