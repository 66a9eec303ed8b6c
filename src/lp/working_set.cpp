#include "lp/working_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jam::inside {
namespace {

// Spheres with at most d working-set rows get their rows_per_dim * d tightest rows: else they would run until they meet
// a screened one.
void add_rows_of_loose_spheres(const PackingLp &lp, std::vector<char> &taken) {
  std::vector<int32_t> degree(lp.n, 0);
  std::vector<std::vector<size_t>> rows(lp.n);
  for (size_t k = 0; k < taken.size(); ++k)
    if (taken[k]) for_spheres(lp.pairs->i[k], lp.pairs->j[k], [&](int32_t v) { ++degree[v]; });
  for (size_t k = 0; k < taken.size(); ++k)
    for_spheres(lp.pairs->i[k], lp.pairs->j[k], [&](int32_t v) {
      if (degree[v] <= lp.dim) rows[v].push_back(k);
    });
  const auto tighter = [&](size_t a, size_t b) { return lp.c[a] != lp.c[b] ? lp.c[a] < lp.c[b] : a < b; };
  for (auto &of : rows) {
    const size_t most = std::min(of.size(), WorkingSetTuning::rows_per_dim * static_cast<size_t>(lp.dim));
    std::partial_sort(of.begin(), of.begin() + most, of.end(), tighter);
    for (size_t q = 0; q < most; ++q) taken[of[q]] = 1;
  }
}

}  // namespace

double carrying_slack(const std::vector<double> &c, int dim, int32_t n) {
  const size_t rank = static_cast<size_t>(WorkingSetTuning::carrying_rows * dim * n);
  if (rank >= c.size()) return std::numeric_limits<double>::infinity();
  std::vector<double> sorted = c;
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  return sorted[rank];
}

void WorkingSet::choose(const PackingLp &whole) {
  using T = WorkingSetTuning;
  const size_t rows = whole.rows();
  const double slack = carrying_slack(whole.c, whole.dim, whole.n);
  threshold = std::numeric_limits<double>::infinity();
  std::vector<char> taken(rows, 1);
  if (std::isfinite(slack)) {
    const double smallest = *std::min_element(whole.c.begin(), whole.c.end());
    threshold = T::far_slack * (slack - smallest);
    if (std::isfinite(whole.bound)) threshold = std::max(threshold, T::per_bound * whole.bound);
    for (size_t k = 0; k < rows; ++k) taken[k] = whole.c[k] - smallest <= threshold;
    add_rows_of_loose_spheres(whole, taken);
    // Screening only a few saves nothing.
    if (std::count(taken.begin(), taken.end(), 1) > T::nearly_all * static_cast<double>(rows)) taken.assign(rows, 1);
  }
  gather(whole, taken);
}

void WorkingSet::join(const PackingLp &whole, const std::vector<char> &take) {
  std::vector<char> taken = take;
  for (const size_t k : index) taken[k] = 1;
  gather(whole, taken);
}

void WorkingSet::gather(const PackingLp &whole, const std::vector<char> &taken) {
  const size_t d = whole.dim, strains = static_cast<size_t>(whole.strains);
  index.clear(), screened.clear();
  for (size_t k = 0; k < taken.size(); ++k) (taken[k] ? index : screened).push_back(k);
  pairs = PairList();
  lp.dim = whole.dim, lp.n = whole.n, lp.bound = whole.bound;
  lp.pairs = &pairs;
  lp.strains = whole.strains;
  lp.strain.resize(index.size() * strains);
  lp.a.resize(index.size() * d);
  lp.c.resize(index.size());
  for (size_t q = 0; q < index.size(); ++q) {
    const size_t k = index[q];
    pairs.i.push_back(whole.pairs->i[k]);
    pairs.j.push_back(whole.pairs->j[k]);
    lp.c[q] = whole.c[k];
    std::copy(&whole.a[k * d], &whole.a[k * d] + d, &lp.a[q * d]);
    std::copy_n(whole.strain.begin() + k * strains, strains, lp.strain.begin() + q * strains);
  }
}

}  // namespace jam::inside
