// Plan of the numeric part: which thread eliminates what, and where Schur complements lie until their parents have
// taken them.
#include <algorithm>
#include <cmath>

#include "linalg/block_cholesky.hpp"
#include "linalg/tuning.hpp"

namespace jam::inside {

void BlockCholesky::plan() {
  const size_t count = supernodes_.size();
  std::vector<double> work(count, 0.0);
  flops_ = 0.0;
  largest_below_ = 0;
  for (size_t k = 0; k < count; ++k) {
    const Supernode &s = supernodes_[k];
    const double c = static_cast<double>(columns(s)), b = static_cast<double>(below(s));
    const double own = c * c * c / 3.0 + c * c * b + c * b * b;
    flops_ += own;
    work[k] += own;
    if (s.parent >= 0) work[s.parent] += work[k];
    largest_below_ = std::max(largest_below_, below(s));
  }
  update_.assign(count, nullptr);
  share_out(work);
  keep();
  for (size_t k = count; k-- > 0;)
    supernodes_[k].side = supernodes_[k].parent < 0 ? 0 : 1 - supernodes_[supernodes_[k].parent].side;
  for (size_t *need : {subtree_need_, top_need_}) need[0] = need[1] = 0;
  for (const auto &list : subtrees_) lay_stacks(list, subtree_need_);
  lay_stacks(top_, top_need_);
  stack_count_ = kept_count_;
  for (int worker = 0; worker < worker_count(); ++worker)
    for (int side = 0; side < 2; ++side) stack_count_ += stack_need(worker, side);
}

// At most the larger of the numbers of subtrees and of parts of a product: each worker needs its own memory.
int BlockCholesky::worker_count() const {
  if (threads_ < 2) return 1;
  return std::min(threads_, std::max(ThreadTuning::most_parts, static_cast<int>(subtrees_.size())));
}

// The top of the tree comes when the subtrees are done.
size_t BlockCholesky::stack_need(int worker, int side) const {
  return worker > 0 ? subtree_need_[side] : std::max(subtree_need_[side], top_need_[side]);
}

// With more than one thread: the heaviest subtree is split until none has more than splits_subtree of all work, or it
// cannot be split. The choice is the same for every number of threads above one.
void BlockCholesky::share_out(const std::vector<double> &work) {
  const size_t count = supernodes_.size();
  std::vector<int32_t> roots;
  for (size_t k = 0; k < count && threads_ > 1; ++k)
    if (supernodes_[k].parent < 0) roots.push_back(static_cast<int32_t>(k));
  const auto heavier = [&](int32_t a, int32_t b) { return work[a] != work[b] ? work[a] < work[b] : a < b; };
  while (!roots.empty()) {
    const auto it = std::max_element(roots.begin(), roots.end(), heavier);
    if (work[*it] < SupernodeTuning::splits_subtree * flops_ || supernodes_[*it].children.empty()) break;
    const int32_t split = *it;
    roots.erase(it);
    roots.insert(roots.end(), supernodes_[split].children.begin(), supernodes_[split].children.end());
  }
  std::sort(roots.begin(), roots.end(), [&](int32_t a, int32_t b) { return heavier(b, a); });
  subtrees_.assign(roots.size(), {});
  top_.clear();
  constexpr int32_t of_top = -1;
  std::vector<int32_t> tree_of(count, of_top);
  for (size_t t = 0; t < roots.size(); ++t) tree_of[roots[t]] = static_cast<int32_t>(t);
  for (size_t k = count; k-- > 0;)
    if (tree_of[k] == of_top && supernodes_[k].parent >= 0) tree_of[k] = tree_of[supernodes_[k].parent];
  for (size_t k = 0; k < count; ++k)
    (tree_of[k] == of_top ? top_ : subtrees_[tree_of[k]]).push_back(static_cast<int32_t>(k));
}

// One block of memory for all, used again by the next graph: blocks of their own broke up the heap, to twice what was
// needed.
void BlockCholesky::keep() {
  kept_at_.assign(supernodes_.size(), on_stack);
  kept_count_ = 0;
  for (const auto &list : subtrees_) {
    kept_at_[list.back()] = kept_count_;
    kept_count_ += below(supernodes_[list.back()]) * below(supernodes_[list.back()]);
  }
}

// Children lie on one side of a stack while their parent's Schur complement is built on the other.
void BlockCholesky::lay_stacks(const std::vector<int32_t> &list, size_t *need) {
  size_t now[2] = {0, 0};
  for (const int32_t k : list) {
    const Supernode &s = supernodes_[k];
    if (kept_at_[k] == on_stack) now[s.side] += below(s) * below(s);
    need[s.side] = std::max(need[s.side], now[s.side]);
    for (const int32_t c : s.children)
      if (kept_at_[c] == on_stack) now[1 - s.side] -= below(supernodes_[c]) * below(supernodes_[c]);
  }
}

// Sizes of the factor: its fronts, and what bounds the rounding of a factorisation, rows and absolute values.

// Two passes over the columns, each as long as the factor: y = |L^T| e, then |L| y. A sum of m products of numbers that
// are not negative is at most 1 - gamma_(m + 1) below the exact one; the last line takes that off with room to spare.
BlockCholesky::AbsoluteSize BlockCholesky::absolute_size() const {
  const size_t unknowns = static_cast<size_t>(n_) * dim_;
  std::vector<size_t> entries(unknowns, 0);
  std::vector<double> columns_sum(unknowns, 0.0), rows_sum(unknowns, 0.0);
  const double *values = values_.as<double>();
  for (int pass = 0; pass < 2; ++pass)
    for (const Supernode &s : supernodes_) {
      const size_t width = columns(s), front = width + below(s), first = static_cast<size_t>(s.first) * dim_;
      for (size_t c = 0; c < width; ++c)
        for (size_t r = c; r < front; ++r) {
          const size_t row =
              r < width ? first + r
                        : static_cast<size_t>(rows_[s.row_start + (r - width) / dim_]) * dim_ + (r - width) % dim_;
          const double x = std::fabs(values[s.value_start + c * front + r]);
          if (pass == 0) {
            columns_sum[first + c] += x;
            ++entries[row];
          } else {
            rows_sum[row] += x * columns_sum[first + c];
          }
        }
    }
  if (unknowns == 0) return {0, 0.0};
  const double roundings = 4.0 * static_cast<double>(unknowns) * 0x1p-53;
  return {*std::max_element(entries.begin(), entries.end()),
          *std::max_element(rows_sum.begin(), rows_sum.end()) * (1.0 + 2.0 * roundings)};
}

std::vector<BlockCholesky::Front> BlockCholesky::fronts() const {
  std::vector<Front> out;
  for (const Supernode &s : supernodes_) out.push_back({s.parent, columns(s) + below(s), columns(s)});
  return out;
}

}  // namespace jam::inside
