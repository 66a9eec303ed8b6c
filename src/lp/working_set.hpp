// Which rows of a packing LP are worth a place in the normal equations: the working set. A row far from tight has a
// multiplier near zero and only costs fill. It is screened until the iterate comes near it, and every step is cut
// before it crosses one. In an LP screened rows leave the matrix, on the path they keep their diagonal blocks.
#pragma once
#include <cstddef>
#include <vector>

#include "lp/packing_lp.hpp"

namespace jam::inside {

// Slack of the last of the rows that may carry force, when sorted. Infinite when there are fewer.
double carrying_slack(const std::vector<double> &c, int dim, int32_t n);

// The split of the rows of an LP: `lp` is an LP of its own on the pairs that it owns.
struct WorkingSet {
  PackingLp lp;
  PairList pairs;                       // without offsets: the rows of `lp` say all
  std::vector<size_t> index, screened;  // rows of the whole LP, both ascending
  double threshold = 0.0;               // slack above which a row started as screened
  // All up to far_slack times carrying_slack or a share of the step bound.
  void choose(const PackingLp &whole);
  // Rows k with take[k] join the working set.
  void join(const PackingLp &whole, const std::vector<char> &take);

 private:
  void gather(const PackingLp &whole, const std::vector<char> &taken);
};

}  // namespace jam::inside
