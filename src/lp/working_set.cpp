#include "lp/working_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jam {
namespace {

// A sphere with too few near rows to be held would run until it meets a far one: it gets its 4 dim tightest.
void hold_loose_spheres(const PackingLp &lp, std::vector<char> &is_near) {
  std::vector<int32_t> degree(lp.n, 0);
  std::vector<std::vector<size_t>> rows(lp.n);
  for (size_t k = 0; k < is_near.size(); ++k)
    if (is_near[k]) ++degree[lp.pairs->i[k]], ++degree[lp.pairs->j[k]];
  for (size_t k = 0; k < is_near.size(); ++k)
    for (const int32_t v : {lp.pairs->i[k], lp.pairs->j[k]})
      if (degree[v] <= lp.dim) rows[v].push_back(k);
  const auto tighter = [&](size_t a, size_t b) { return lp.c[a] != lp.c[b] ? lp.c[a] < lp.c[b] : a < b; };
  for (auto &of : rows) {
    const size_t most = std::min(of.size(), static_cast<size_t>(4 * lp.dim));
    std::partial_sort(of.begin(), of.begin() + most, of.end(), tighter);
    for (size_t q = 0; q < most; ++q) is_near[of[q]] = 1;
  }
}

}  // namespace

double carrying_slack(const std::vector<double> &c, int dim, int32_t n) {
  const size_t rank = static_cast<size_t>(1.05 * dim * n);
  if (rank >= c.size()) return std::numeric_limits<double>::infinity();
  std::vector<double> sorted = c;
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  return sorted[rank];
}

void WorkingSet::choose(const PackingLp &lp) {
  const size_t rows = lp.rows();
  const double slack = carrying_slack(lp.c, lp.dim, lp.n);
  threshold = std::numeric_limits<double>::infinity();
  std::vector<char> is_near(rows, 1);
  if (std::isfinite(slack)) {
    const double smallest = *std::min_element(lp.c.begin(), lp.c.end());
    threshold = far_slack * (slack - smallest);
    if (std::isfinite(lp.bound))
      threshold = std::max(threshold, 0.1 * lp.bound);  // what a step may well close, however even the slacks
    for (size_t k = 0; k < rows; ++k) is_near[k] = lp.c[k] - smallest <= threshold;
    hold_loose_spheres(lp, is_near);
    // To leave out a few saves nothing.
    if (std::count(is_near.begin(), is_near.end(), 1) > 0.9 * static_cast<double>(rows)) is_near.assign(rows, 1);
  }
  gather(lp, is_near);
}

void WorkingSet::join(const PackingLp &lp, const std::vector<char> &take) {
  std::vector<char> is_near = take;
  for (const size_t k : index) is_near[k] = 1;
  gather(lp, is_near);
}

void WorkingSet::gather(const PackingLp &lp, const std::vector<char> &is_near) {
  const size_t d = lp.dim;
  index.clear(), far.clear();
  for (size_t k = 0; k < is_near.size(); ++k) (is_near[k] ? index : far).push_back(k);
  near_pairs = PairList();
  near.dim = lp.dim, near.n = lp.n, near.bound = lp.bound;
  near.pairs = &near_pairs;
  near.strains = lp.strains;
  const size_t strains = static_cast<size_t>(lp.strains);
  near.strain.resize(index.size() * strains);
  near.a.resize(index.size() * d);
  near.c.resize(index.size());
  for (size_t q = 0; q < index.size(); ++q) {
    const size_t k = index[q];
    near_pairs.i.push_back(lp.pairs->i[k]);
    near_pairs.j.push_back(lp.pairs->j[k]);
    near.c[q] = lp.c[k];
    std::copy(&lp.a[k * d], &lp.a[k * d] + d, &near.a[q * d]);
    std::copy_n(lp.strain.begin() + k * strains, strains, near.strain.begin() + q * strains);
  }
}

}  // namespace jam
