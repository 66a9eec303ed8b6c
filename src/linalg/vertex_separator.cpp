// Multilevel bisection: coarsen, separate the coarsest graph, and refine the separator on the way back.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "linalg/graph.hpp"
#include "linalg/tuning.hpp"

namespace jam::inside {
namespace {

// Fiduccia-Mattheyses passes on a vertex separator (C. Ashcraft and J. W. H. Liu, SIAM J. Matrix Anal. Appl. 19, 325
// (1998)).

class Refinement {
 public:
  Refinement(const WeightedGraph &graph, Bisection &b)
      : g_(graph), b_(b), pull_(graph.size()), stamp_(graph.size(), 0) {}
  bool pass(int to);

 private:
  struct Move {
    int32_t gain, stamp, node;
    bool operator<(const Move &o) const { return gain != o.gain ? gain < o.gain : stamp < o.stamp; }
  };

  void enter(int32_t v) {  // v is in the separator: weigh its neighbours and queue its two moves
    int32_t pull[3] = {0, 0, 0};
    for (int32_t e = g_.start[v]; e < g_.start[v + 1]; ++e) {
      const int32_t u = g_.adjacency[e];
      pull[static_cast<int>(b_.side[u])] += g_.weight[u];
    }
    pull_[v] = pull[1 - to_];
    offer(v);
  }
  void offer(int32_t v) {
    stamp_[v] = ++clock_;
    queue_.push_back({g_.weight[v] - pull_[v], clock_, v});
    std::push_heap(queue_.begin(), queue_.end());
  }
  void set_side(int32_t v, char side) {
    b_.weight[static_cast<int>(b_.side[v])] -= g_.weight[v], b_.weight[static_cast<int>(side)] += g_.weight[v];
    b_.side[v] = side;
  }
  void change(int32_t v, char side) {
    changed_.push_back({v, b_.side[v]});
    set_side(v, side);
  }
  bool stale(const Move &m) const { return stamp_[m.node] != m.stamp || b_.side[m.node] != Bisection::separator; }
  int32_t take();
  void move(int32_t v);

  const WeightedGraph &g_;
  Bisection &b_;
  std::vector<int32_t> pull_;  // weight of the neighbours on the other side, for nodes of the separator
  std::vector<int32_t> stamp_;
  std::vector<Move> queue_;  // a heap; a move whose stamp is old counts no more
  std::vector<std::pair<int32_t, char>> changed_;
  int32_t clock_ = 0;
  int to_ = 0;  // the side that takes nodes in this pass
};

// The separator node that leaves the lightest separator; -1: none is left that the side may take.
int32_t Refinement::take() {
  const double limit = OrderingTuning::heaviest_side * static_cast<double>(b_.weight[0] + b_.weight[1]);
  while (!queue_.empty()) {
    const Move m = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end());
    queue_.pop_back();
    if (stale(m)) continue;
    if (static_cast<double>(b_.weight[to_] + g_.weight[m.node]) <= limit) return m.node;
  }
  return -1;
}

void Refinement::move(int32_t v) {
  const char other = static_cast<char>(1 - to_);
  change(v, static_cast<char>(to_));
  for (int32_t e = g_.start[v]; e < g_.start[v + 1]; ++e) {
    const int32_t u = g_.adjacency[e];
    if (b_.side[u] != other) continue;
    change(u, Bisection::separator);
    for (int32_t f = g_.start[u]; f < g_.start[u + 1]; ++f) {
      const int32_t w = g_.adjacency[f];
      if (w == v || b_.side[w] != Bisection::separator) continue;
      pull_[w] -= g_.weight[u];
      offer(w);
    }
    enter(u);
  }
}

// One pass: every node moves at most once; the best separator seen stays. False: nothing better was found.
bool Refinement::pass(int to) {
  to_ = to;
  queue_.clear();
  changed_.clear();
  int32_t in_separator = 0;
  for (int32_t v = 0; v < g_.size(); ++v)
    if (b_.side[v] == Bisection::separator) enter(v), ++in_separator;
  const double before = b_.cost();
  double least = before;
  size_t kept = 0;
  const int max_stalled = std::min(in_separator, 100);
  for (int since = 0; since < 3 * max_stalled; ++since) {
    const int32_t v = take();
    if (v < 0) break;
    move(v);
    const double cost = b_.cost();
    if (cost < least) least = cost, kept = changed_.size(), since = 0;
    if (since > max_stalled && cost > OrderingTuning::give_up * least) break;
  }
  while (changed_.size() > kept) {
    set_side(changed_.back().first, changed_.back().second);
    changed_.pop_back();
  }
  return least < before;
}

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

double Bisection::cost() const {
  const double sides = static_cast<double>(weight[0] + weight[1]);
  const double uneven = sides > 0.0 ? std::fabs(static_cast<double>(weight[0] - weight[1])) / sides : 1.0;
  const double over =
      std::max(0.0, 0.5 + 0.5 * uneven - OrderingTuning::heaviest_side);  // a start may lie outside the limit
  return static_cast<double>(weight[2]) * (1.0 + OrderingTuning::unevenness * uneven) + 10.0 * over * sides;
}

void refine_separator(const WeightedGraph &graph, Bisection &b, int passes) {
  Refinement r(graph, b);
  int to = b.weight[0] <= b.weight[1] ? 0 : 1;
  for (int pass = 0, failed = 0; pass < passes && failed < 2; ++pass, to = 1 - to) failed = r.pass(to) ? 0 : failed + 1;
}

}  // namespace jam::inside
