// Numeric part: fronts, dense panels, triangular solves.
#include "lp/block_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <thread>

#include "lp/blas.hpp"

namespace jam {
namespace {

constexpr double one = 1.0, minus_one = -1.0, zero = 0.0;
constexpr int inc = 1;
constexpr double huge_pivot = 1e64;  // the square root of what replaces it

// Unblocked Cholesky of the leading columns of a small block; returns the number of replaced pivots.
int factor_small(double *a, int lda, int columns, const double *original, double relative, double least) {
  int replaced = 0;
  for (int j = 0; j < columns; ++j) {
    double *cj = a + static_cast<size_t>(j) * lda;
    double pivot = cj[j];
    if (pivot > std::max(relative * original[j], least)) {
      pivot = std::sqrt(pivot);
    } else if (std::isfinite(pivot)) {  // else it stays and factorise() finds it
      pivot = huge_pivot;
      ++replaced;
    }
    cj[j] = pivot;
    const double inverse = 1.0 / pivot;
    for (int i = j + 1; i < columns; ++i) cj[i] *= inverse;
    for (int k = j + 1; k < columns; ++k) {
      double *ck = a + static_cast<size_t>(k) * lda;
      const double f = cj[k];
      for (int i = k; i < columns; ++i) ck[i] -= f * cj[i];
    }
  }
  return replaced;
}

// C -= B B^T, lower triangle, on two threads when it is worth it: columns are split where the two areas are even.
void subtract_square(double *c, int n, const double *b, int ldb, int k, int threads) {
  if (n == 0 || k == 0) return;
  if (threads < 2 || static_cast<double>(n) * n * k < 2e7) {
    dsyrk_("L", "N", &n, &k, &minus_one, b, &ldb, &one, c, &n);
    return;
  }
  const int left = static_cast<int>(0.29289 * n), right = n - left;
  std::thread other([&] { dsyrk_("L", "N", &right, &k, &minus_one, b + left, &ldb, &one, c + static_cast<size_t>(left) * n + left, &n); });
  dsyrk_("L", "N", &left, &k, &minus_one, b, &ldb, &one, c, &n);
  dgemm_("N", "T", &right, &left, &k, &minus_one, b + left, &ldb, b, &ldb, &one, c + left, &n);
  other.join();
}

}  // namespace

void BlockCholesky::assemble(const Supernode &s, const double *diag, const double *off) {
  const size_t front = columns(s) + below(s), block = static_cast<size_t>(dim_) * dim_;
  std::memset(&values_[s.value_start], 0, columns(s) * front * sizeof(double));
  for (size_t k = s.entry_start; k < s.entry_start + s.entry_count; ++k) {
    const Entry &e = entries_[k];
    double *to = &values_[e.target];
    const double *from = e.edge >= 0 ? off + static_cast<size_t>(e.edge) * block : diag + static_cast<size_t>(-1 - e.edge) * block;
    // from is row-major: element (row p, column q) at p * dim + q; the panel is column-major.
    for (int q = 0; q < dim_; ++q)
      for (int p = 0; p < dim_; ++p) to[q * front + p] = e.transposed ? from[q * dim_ + p] : from[p * dim_ + q];
  }
  for (int32_t k = s.first; k < s.last; ++k)
    for (int q = 0; q < dim_; ++q) {
      const size_t c = static_cast<size_t>(k - s.first) * dim_ + q;
      original_diagonal_[static_cast<size_t>(k) * dim_ + q] = values_[s.value_start + c * front + c];
    }
}

// Adds a child's Schur complement to the parent's panel and Schur complement, run by run.
void BlockCholesky::extend_add(int32_t child, double *update) {
  const Supernode &c = supernodes_[child], &p = supernodes_[c.parent];
  const auto &runs = runs_[child];
  const size_t d = dim_, mc = below(c), own = p.last - p.first, front = columns(p) + below(p), mp = below(p);
  const double *from = update_[child];
  for (size_t b = 0; b < runs.size(); ++b)
    for (size_t column = 0; column < static_cast<size_t>(runs[b].count) * d; ++column) {
      const size_t from_column = runs[b].from * d + column, to_column = runs[b].to * d + column;
      const bool in_panel = static_cast<size_t>(runs[b].to) < own;
      double *to = in_panel ? &values_[p.value_start + to_column * front] : update + (to_column - own * d) * mp;
      const size_t shift = in_panel ? 0 : own * d;
      const double *x = from + from_column * mc;
      for (size_t a = b; a < runs.size(); ++a) {
        const size_t skip = a == b ? column : 0, length = runs[a].count * d - skip;
        const double *xa = x + runs[a].from * d + skip;
        double *ya = to + runs[a].to * d + skip - shift;
        for (size_t i = 0; i < length; ++i) ya[i] += xa[i];
      }
    }
}

// Cholesky of the panel's top, by blocks of columns; the rows below follow.
int BlockCholesky::factor_panel(double *panel, int front, int width, const double *original) {
  constexpr int block = 48;
  int replaced = 0;
  for (int j = 0; j < width; j += block) {
    const int now = std::min(block, width - j), rest = front - j - now, inside = width - j - now;
    double *a = panel + static_cast<size_t>(j) * front + j;
    replaced += factor_small(a, front, now, original + j, relative_, floor_);
    if (rest == 0) continue;
    dtrsm_("R", "L", "T", "N", &rest, &now, &one, a, &front, a + now, &front);
    if (inside == 0) continue;
    double *trailing = a + static_cast<size_t>(now) * front + now;
    dsyrk_("L", "N", &inside, &now, &minus_one, a + now, &front, &one, trailing, &front);
    const int rows = rest - inside;
    if (rows > 0) dgemm_("N", "T", &rows, &inside, &now, &minus_one, a + now + inside, &front, a + now, &front, &one, trailing + inside, &front);
  }
  return replaced;
}

void BlockCholesky::eliminate(int32_t index, const double *diag, const double *off, Stack &stack, int threads, int &replaced) {
  const Supernode &s = supernodes_[index];
  const size_t m = below(s);
  const int front = static_cast<int>(columns(s) + m), width = static_cast<int>(columns(s)), rows = static_cast<int>(m);
  double *panel = &values_[s.value_start];
  assemble(s, diag, off);
  const bool keep = !kept_[index].empty();
  double *update = keep ? kept_[index].data() : stack.memory.data() + stack.top;
  if (m) std::memset(update, 0, m * m * sizeof(double));
  size_t freed = 0;
  for (const int32_t c : s.children) {
    extend_add(c, update);
    if (kept_[c].empty()) freed += below(supernodes_[c]) * below(supernodes_[c]);
  }
  replaced += factor_panel(panel, front, width, &original_diagonal_[static_cast<size_t>(s.first) * dim_]);
  subtract_square(update, rows, panel + width, front, width, threads);
  // The children lie right below on this stack: close the hole.
  stack.top -= freed;
  if (!keep) {
    double *down = stack.memory.data() + stack.top;
    if (freed && m) std::memmove(down, update, m * m * sizeof(double));
    update = down;
    stack.top += m * m;
  }
  update_[index] = update;
}

void BlockCholesky::run_list(const std::vector<int32_t> &list, const double *diag, const double *off, Stack &stack, int threads, int &replaced) {
  stack.top = 0;
  for (const int32_t s : list) eliminate(s, diag, off, stack, threads, replaced);
}

int BlockCholesky::factorise(const double *diag, const double *off) {
  const BlasSingleThread single;
  int replaced[3] = {0, 0, 0};
  if (!lists_[1].empty()) {
    std::thread other([&] { run_list(lists_[1], diag, off, stacks_[1], 1, replaced[1]); });
    run_list(lists_[0], diag, off, stacks_[0], 1, replaced[0]);
    other.join();
  } else {
    run_list(lists_[0], diag, off, stacks_[0], 1, replaced[0]);
  }
  run_list(lists_[2], diag, off, stacks_[0], threads_, replaced[2]);
  for (const Supernode &s : supernodes_) {
    const size_t front = columns(s) + below(s);
    for (size_t c = 0; c < columns(s); ++c)
      if (!std::isfinite(values_[s.value_start + c * front + c])) return -1;
  }
  return replaced[0] + replaced[1] + replaced[2];
}

void BlockCholesky::solve_many(double *x, int nrhs) const {
  const BlasSingleThread single;
  const size_t d = dim_, unknowns = static_cast<size_t>(n_) * d;
  std::vector<double> y(unknowns), gathered(largest_below_);
  for (int r = 0; r < nrhs; ++r) {
    double *v = x + static_cast<size_t>(r) * unknowns;
    for (int32_t k = 0; k < n_; ++k) std::copy(v + k * d, v + (k + 1) * d, &y[static_cast<size_t>(position_[k]) * d]);
    for (const Supernode &s : supernodes_) {
      const int width = static_cast<int>(columns(s)), rows = static_cast<int>(below(s)), front = width + rows;
      const double *panel = &values_[s.value_start];
      double *top = &y[static_cast<size_t>(s.first) * d];
      dtrsv_("L", "N", "N", &width, panel, &front, top, &inc);
      if (rows == 0) continue;
      dgemv_("N", &rows, &width, &one, panel + width, &front, top, &inc, &zero, gathered.data(), &inc);
      for (size_t k = 0; k < s.row_count; ++k) {
        double *to = &y[static_cast<size_t>(rows_[s.row_start + k]) * d];
        for (size_t c = 0; c < d; ++c) to[c] -= gathered[k * d + c];
      }
    }
    for (size_t index = supernodes_.size(); index-- > 0;) {
      const Supernode &s = supernodes_[index];
      const int width = static_cast<int>(columns(s)), rows = static_cast<int>(below(s)), front = width + rows;
      const double *panel = &values_[s.value_start];
      double *top = &y[static_cast<size_t>(s.first) * d];
      for (size_t k = 0; k < s.row_count; ++k) {
        const double *from = &y[static_cast<size_t>(rows_[s.row_start + k]) * d];
        for (size_t c = 0; c < d; ++c) gathered[k * d + c] = from[c];
      }
      if (rows > 0) dgemv_("T", &rows, &width, &minus_one, panel + width, &front, gathered.data(), &inc, &one, top, &inc);
      dtrsv_("L", "T", "N", &width, panel, &front, top, &inc);
    }
    for (int32_t k = 0; k < n_; ++k) std::copy(&y[static_cast<size_t>(position_[k]) * d], &y[static_cast<size_t>(position_[k]) * d] + d, v + k * d);
  }
}

}  // namespace jam
