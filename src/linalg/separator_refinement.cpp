// Fiduccia-Mattheyses passes on a vertex separator (C. Ashcraft and J. W. H. Liu, SIAM J. Matrix Anal. Appl. 19, 325
// (1998)).
#include <algorithm>
#include <cmath>

#include "linalg/tuning.hpp"
#include "linalg/vertex_separator.hpp"

namespace jam::inside {
namespace {

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

}  // namespace

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
