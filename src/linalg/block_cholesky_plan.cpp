// Plan of the numeric part: which thread eliminates what, and where Schur complements lie until their parents have
// taken them.
#include <algorithm>

#include "linalg/block_cholesky.hpp"
#include "linalg/tuning.hpp"

namespace jam {

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
  keep(share_out(work));
  for (size_t k = count; k-- > 0;)
    supernodes_[k].side = supernodes_[k].parent < 0 ? 0 : 1 - supernodes_[supernodes_[k].parent].side;
  for (auto &list : stack_need_) list[0] = list[1] = 0;
  for (int list = 0; list < 3; ++list) lay_stacks(list);
  stack_count_ = kept_count_;
  for (const auto &list : stack_need_) stack_count_ += list[0] + list[1];
}

// With two threads: whole subtrees, split from the heaviest root down until the two lists are even. Returns their
// roots.
std::vector<int32_t> BlockCholesky::share_out(const std::vector<double> &work) {
  const size_t count = supernodes_.size();
  for (auto &l : lists_) l.clear();
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
  double load[2] = {0.0, 0.0};
  std::vector<int> thread_of(count, 2);
  for (const int32_t r : roots) {
    const int t = load[1] < load[0] ? 1 : 0;
    load[t] += work[r];
    thread_of[r] = t;
  }
  for (size_t k = count; k-- > 0;)
    if (thread_of[k] == 2 && supernodes_[k].parent >= 0 && thread_of[supernodes_[k].parent] != 2)
      thread_of[k] = thread_of[supernodes_[k].parent];
  for (size_t k = 0; k < count; ++k) lists_[thread_of[k]].push_back(static_cast<int32_t>(k));
  return roots;
}

// One block of memory for all, used again by the next graph: blocks of their own broke up the heap, to twice what was
// needed.
void BlockCholesky::keep(const std::vector<int32_t> &roots) {
  kept_at_.assign(supernodes_.size(), on_stack);
  kept_count_ = 0;
  for (const int32_t r : roots) {
    kept_at_[r] = kept_count_;
    kept_count_ += below(supernodes_[r]) * below(supernodes_[r]);
  }
}

// Children lie on one stack while their parent's Schur complement is built on the other.
void BlockCholesky::lay_stacks(int list) {
  size_t now[2] = {0, 0}, most[2] = {0, 0};
  for (const int32_t k : lists_[list]) {
    const Supernode &s = supernodes_[k];
    if (kept_at_[k] == on_stack) now[s.side] += below(s) * below(s);
    most[s.side] = std::max(most[s.side], now[s.side]);
    for (const int32_t c : s.children)
      if (kept_at_[c] == on_stack) now[1 - s.side] -= below(supernodes_[c]) * below(supernodes_[c]);
  }
  for (int side = 0; side < 2; ++side)  // the top of the tree comes when the lists are done
    stack_need_[list % 2][side] = std::max(stack_need_[list % 2][side], most[side]);
}

}  // namespace jam
