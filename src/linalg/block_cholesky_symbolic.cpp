// Symbolic part: elimination tree, supernodes, where every block goes, who works on what.
#include <algorithm>

#include "core/call_scope.hpp"
#include "linalg/block_cholesky.hpp"
#include "linalg/graph.hpp"
#include "linalg/tuning.hpp"

namespace jam::inside {
namespace {

// Liu's algorithm with path compression, on the graph relabelled by place[].
std::vector<int32_t> elimination_tree(const Graph &g, const std::vector<int32_t> &order,
                                      const std::vector<int32_t> &place) {
  const int32_t n = g.size();
  std::vector<int32_t> parent(n, -1), ancestor(n, -1);
  for (int32_t k = 0; k < n; ++k) {
    const int32_t v = order[k];
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e) {
      int32_t i = place[g.adjacency[e]];
      while (i >= 0 && i < k) {
        const int32_t next = ancestor[i];
        ancestor[i] = k;
        if (next < 0) parent[i] = k;
        i = next;
      }
    }
  }
  return parent;
}

// Postorder of the forest with the widest child last, so that it can join its parent's supernode.
std::vector<int32_t> postorder(const std::vector<int32_t> &parent) {
  const int32_t n = static_cast<int32_t>(parent.size());
  std::vector<int32_t> weight(n, 1), out;
  for (int32_t k = 0; k < n; ++k)
    if (parent[k] >= 0) weight[parent[k]] += weight[k];
  std::vector<std::vector<int32_t>> children(n + 1);
  for (int32_t k = 0; k < n; ++k) children[parent[k] < 0 ? n : parent[k]].push_back(k);
  for (auto &c : children)
    std::stable_sort(c.begin(), c.end(), [&](int32_t a, int32_t b) { return weight[a] < weight[b]; });
  out.reserve(n);
  std::vector<std::pair<int32_t, size_t>> stack{{n, 0}};
  while (!stack.empty()) {
    const int32_t v = stack.back().first;
    if (stack.back().second < children[v].size()) {
      const int32_t c = children[v][stack.back().second++];
      stack.push_back({c, 0});
    } else {
      if (v < n) out.push_back(v);
      stack.pop_back();
    }
  }
  return out;
}

// Rows of each column of L below the diagonal, in no order: most are not kept.
std::vector<std::vector<int32_t>> column_structure(const Graph &g, const std::vector<int32_t> &order,
                                                   const std::vector<int32_t> &place,
                                                   const std::vector<int32_t> &parent) {
  const int32_t n = g.size();
  std::vector<std::vector<int32_t>> rows(n);
  std::vector<int32_t> mark(n, -1);
  std::vector<std::vector<int32_t>> children(n);
  for (int32_t k = 0; k < n; ++k)
    if (parent[k] >= 0) children[parent[k]].push_back(k);
  for (int32_t k = 0; k < n; ++k) {
    mark[k] = k;
    if (k % 256 == 0) CallScope::look();
    const auto take = [&](int32_t r) {
      if (r > k && mark[r] != k) mark[r] = k, rows[k].push_back(r);
    };
    const int32_t v = order[k];
    for (int32_t e = g.start[v]; e < g.start[v + 1]; ++e) take(place[g.adjacency[e]]);
    for (const int32_t c : children[k])
      for (const int32_t r : rows[c]) take(r);
  }
  return rows;
}

// May two neighbouring supernodes be stored as one?
bool worth_merging(size_t columns, double zeros, double entries) {
  const double part = zeros / entries;
  using Tuning = SupernodeTuning;
  if (columns <= Tuning::few) return true;
  if (columns <= Tuning::some) return part < Tuning::zeros_of_some;
  return part < (columns <= Tuning::many ? Tuning::zeros_of_many : Tuning::zeros_of_more);
}

}  // namespace

// Fundamental supernodes, joined with their last child where few zeros come in (Ashcraft and Grimes, ACM Trans. Math.
// Softw. 15, 291 (1989)).
void BlockCholesky::find_supernodes(const std::vector<int32_t> &parent, std::vector<std::vector<int32_t>> &structure) {
  struct Draft {
    int32_t first, last;
    std::vector<int32_t> rows;
    double zeros;
  };
  std::vector<Draft> drafts;
  for (int32_t k = 0; k < n_;) {
    int32_t end = k + 1;
    while (end < n_ && parent[end - 1] == end && structure[end].size() + 1 == structure[end - 1].size()) ++end;
    Draft now{k, end, std::move(structure[end - 1]), 0.0};
    std::sort(now.rows.begin(), now.rows.end());
    CallScope::look();
    while (!drafts.empty() && !drafts.back().rows.empty() && drafts.back().rows.front() < now.last) {
      const Draft &child = drafts.back();
      const double nc = child.last - child.first, np = now.last - now.first,
                   below = static_cast<double>(now.rows.size());
      const double zeros = child.zeros + now.zeros + nc * (np + below - static_cast<double>(child.rows.size()));
      const double total = (nc + np) * (0.5 * (nc + np) + below);
      if (!worth_merging(static_cast<size_t>(nc + np) * dim_, zeros, total)) break;
      now.first = child.first;
      now.zeros = zeros;
      drafts.pop_back();
    }
    drafts.push_back(std::move(now));
    k = end;
  }
  supernodes_.clear();
  rows_.clear();
  std::vector<int32_t> owner(n_);
  size_t values = 0;
  for (const Draft &d : drafts) {
    Supernode s{};
    s.first = d.first, s.last = d.last, s.parent = -1;
    s.row_start = rows_.size(), s.row_count = d.rows.size();
    s.value_start = values;
    rows_.insert(rows_.end(), d.rows.begin(), d.rows.end());
    values += columns(s) * (columns(s) + below(s));
    for (int32_t k = d.first; k < d.last; ++k) owner[k] = static_cast<int32_t>(supernodes_.size());
    supernodes_.push_back(std::move(s));
  }
  value_count_ = values;
  places_.clear();
  places_.reserve(rows_.size());
  for (size_t k = 0; k < supernodes_.size(); ++k) {
    Supernode &s = supernodes_[k];
    if (s.row_count == 0) continue;
    s.parent = owner[rows_[s.row_start]];
    const Supernode &p = supernodes_[s.parent];
    supernodes_[s.parent].children.push_back(static_cast<int32_t>(k));
    size_t at = 0;
    for (size_t r = 0; r < s.row_count; ++r) {
      const int32_t row = rows_[s.row_start + r];
      int32_t place;
      if (row < p.last) {
        place = row - p.first;
      } else {
        while (rows_[p.row_start + at] != row) ++at;
        place = (p.last - p.first) + static_cast<int32_t>(at);
      }
      places_.push_back(place);
    }
  }
}

void BlockCholesky::place_entries(const int32_t *ei, const int32_t *ej, size_t edges) {
  std::vector<int32_t> owner(n_);
  for (size_t s = 0; s < supernodes_.size(); ++s)
    for (int32_t k = supernodes_[s].first; k < supernodes_[s].last; ++k) owner[k] = static_cast<int32_t>(s);
  std::vector<std::pair<int32_t, Entry>> all;
  all.reserve(n_ + edges);
  const auto add = [&](int32_t s, const Entry &entry) {
    if (all.size() % 4096 == 0) CallScope::look();
    ++supernodes_[s].entry_count;
    all.push_back({s, entry});
  };
  for (auto &s : supernodes_) s.entry_count = 0;
  const auto target = [&](const Supernode &s, int32_t row, int32_t column) {
    size_t place = row - s.first;
    if (row >= s.last) {
      const auto begin = rows_.begin() + s.row_start;
      place = (s.last - s.first) + (std::lower_bound(begin, begin + s.row_count, row) - begin);
    }
    const size_t front = columns(s) + below(s);
    return s.value_start + static_cast<size_t>(column - s.first) * dim_ * front + place * dim_;
  };
  for (int32_t v = 0; v < n_; ++v) {
    const int32_t k = position_[v];
    add(owner[k], {-1 - static_cast<int64_t>(v), target(supernodes_[owner[k]], k, k), false});
  }
  for (size_t e = 0; e < edges; ++e) {
    const int32_t a = position_[ei[e]], b = position_[ej[e]], low = std::min(a, b), high = std::max(a, b);
    add(owner[low], {static_cast<int64_t>(e), target(supernodes_[owner[low]], high, low), a == low});
  }
  size_t start = 0;
  for (auto &s : supernodes_) s.entry_start = start, start += s.entry_count, s.entry_count = 0;
  entries_.resize(all.size());
  for (const auto &[s, entry] : all) entries_[supernodes_[s].entry_start + supernodes_[s].entry_count++] = entry;
}

void BlockCholesky::analyse(int dim, int32_t n, const int32_t *ei, const int32_t *ej, size_t edges, int threads,
                            std::vector<int32_t> order) {
  order_ = order.empty() ? nested_dissection(make_graph(n, ei, ej, edges)) : std::move(order);
  analyse_keep_order(dim, n, ei, ej, edges, threads);
}

void BlockCholesky::analyse_keep_order(int dim, int32_t n, const int32_t *ei, const int32_t *ej, size_t edges,
                                       int threads) {
  if (order_.size() != static_cast<size_t>(n)) return analyse(dim, n, ei, ej, edges, threads);
  if (dim < 1 || dim > 8)
    fail(JAM_E_INTERNAL, "blocks of %d x %d in BlockCholesky", dim, dim);  // extend_add has a kernel for each
  dim_ = dim, n_ = n, threads_ = threads;
  const Graph graph = make_graph(n, ei, ej, edges);
  std::vector<int32_t> order = order_, place(n);
  const auto invert = [&] {
    for (int32_t k = 0; k < n; ++k) place[order[k]] = k;
  };
  invert();
  const std::vector<int32_t> post = postorder(elimination_tree(graph, order, place));
  std::vector<int32_t> better(n);
  for (int32_t k = 0; k < n; ++k) better[k] = order[post[k]];
  order.swap(better);
  invert();
  const std::vector<int32_t> parent = elimination_tree(graph, order, place);
  position_ = place;
  std::vector<std::vector<int32_t>> structure = column_structure(graph, order, place, parent);
  find_supernodes(parent, structure);
  place_entries(ei, ej, edges);
  plan();
  if (!dry_) allocate();
}

// Nothing is taken of what exceeds the limit of the call.
void BlockCholesky::allocate() {
  const size_t unknowns = static_cast<size_t>(n_) * dim_;
  CallScope::need_memory(8.0 * static_cast<double>(value_count_ + stack_count_ + unknowns),
                         "the numbers of a factorised matrix");
  values_.need(value_count_);
  original_diagonal_.need(unknowns);
  kept_.need(kept_count_);
  stacks_.resize(worker_count());
  for (size_t worker = 0; worker < stacks_.size(); ++worker)
    for (int side = 0; side < 2; ++side) stacks_[worker].memory[side].need(stack_need(static_cast<int>(worker), side));
}

BlockCholesky::Sizes BlockCholesky::measure(int dim, int32_t n, const int32_t *ei, const int32_t *ej, size_t edges,
                                            int threads) {
  BlockCholesky trial;
  trial.dry_ = true;
  trial.analyse(dim, n, ei, ej, edges, threads);
  return {trial.flops_, trial.value_count_, trial.stack_count_};
}

void BlockCholesky::release() {
  for (ScratchBuffer *buffer : {&values_, &original_diagonal_, &kept_}) buffer->release();
  for (Stack &stack : stacks_)
    for (ScratchBuffer &memory : stack.memory) memory.release();
}

size_t BlockCholesky::bytes() const {
  size_t sum = values_.capacity() + original_diagonal_.capacity() + kept_.capacity();
  for (const Stack &stack : stacks_)
    for (const auto &memory : stack.memory) sum += memory.capacity();
  return sum * sizeof(double) + entries_.capacity() * sizeof(Entry) + rows_.capacity() * sizeof(int32_t) +
         supernodes_.capacity() * sizeof(Supernode);
}

}  // namespace jam::inside
