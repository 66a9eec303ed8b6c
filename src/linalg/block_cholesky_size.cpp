// Sizes of the factor: its fronts, and what bounds the rounding of a factorisation, rows and absolute values.
#include <algorithm>
#include <cmath>

#include "linalg/block_cholesky.hpp"

namespace jam::inside {

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
