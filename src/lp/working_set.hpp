// Which rows of a packing LP are worth a place in the normal equations. A row far from tight has a multiplier near zero
// and only costs fill; it is left out until the iterate comes near it, and every step is cut before it is crossed.
#pragma once
#include <cstddef>
#include <vector>

#include "lp/packing_lp.hpp"

namespace jam {

// Rows slacker than this many times carrying_slack are far: what they couple is weak by the square of that, and every
// step is searched on all rows anyway. In an LP they leave the matrix, on the path they keep their diagonal blocks.
constexpr double far_slack = 2.0;

// Slack of the row that is 1.05 dim n-th when sorted: about dim n rows carry force at the end. Infinite when there are
// fewer.
double carrying_slack(const std::vector<double> &c, int dim, int32_t n);

// The split of the rows of an LP: `near` is an LP of its own on the pairs that it owns.
struct WorkingSet {
  PackingLp near;
  PairList near_pairs;             // without offsets: the rows of `near` say all
  std::vector<size_t> index, far;  // rows of the whole LP, both ascending
  double threshold = 0.0;          // slack above which a row started as far
  // Near: all up to far_slack times carrying_slack or a tenth of the step bound.
  void choose(const PackingLp &lp);
  // Rows k with take[k] join the near ones.
  void join(const PackingLp &lp, const std::vector<char> &take);

 private:
  void gather(const PackingLp &lp, const std::vector<char> &is_near);
};

}  // namespace jam
