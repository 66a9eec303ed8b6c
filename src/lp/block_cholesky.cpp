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

// C = -B B^T, lower triangle, on two threads when it is worth it: columns are split where the two areas are even.
void minus_square(double *c, int n, const double *b, int ldb, int k, int threads) {
  if (n == 0 || k == 0) return;
  if (threads < 2 || static_cast<double>(n) * n * k < 2e7) {
    dsyrk_("L", "N", &n, &k, &minus_one, b, &ldb, &zero, c, &n);
    return;
  }
  const int left = static_cast<int>(0.29289 * n), right = n - left;
  std::thread other([&] { dsyrk_("L", "N", &right, &k, &minus_one, b + left, &ldb, &zero, c + static_cast<size_t>(left) * n + left, &n); });
  dsyrk_("L", "N", &left, &k, &minus_one, b, &ldb, &zero, c, &n);
  dgemm_("N", "T", &right, &left, &k, &minus_one, b + left, &ldb, b, &ldb, &zero, c + left, &n);
  other.join();
}

// The triangle on top of a panel, forward ("N") or backward ("T").
void solve_top(const double *panel, int front, int width, double *x, int ld, int nrhs, const char *trans) {
  if (nrhs == 1) dtrsv_("L", trans, "N", &width, panel, &front, x, &inc);
  else dtrsm_("L", "L", trans, "N", &width, &nrhs, &one, panel, &front, x, &ld);
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

// Adds a child's Schur complement to the parent, run by run: to its panel when `update` is NULL (before the panel is
// factored), else to its Schur complement (after that was written, so that it needs no clearing).
void BlockCholesky::extend_add(int32_t child, double *update) {
  const Supernode &c = supernodes_[child], &p = supernodes_[c.parent];
  const auto &runs = runs_[child];
  const size_t d = dim_, mc = below(c), own = p.last - p.first, mp = below(p), stride = update ? mp : columns(p) + mp;
  double *into = update ? update : &values_[p.value_start];
  const size_t shift = update ? own * d : 0;
  size_t first = 0;
  while (first < runs.size() && static_cast<size_t>(runs[first].to) < own) ++first;
  for (size_t b = update ? first : 0; b < (update ? runs.size() : first); ++b)
    for (size_t column = 0; column < static_cast<size_t>(runs[b].count) * d; ++column) {
      const double *x = update_[child] + (runs[b].from * d + column) * mc;
      double *to = into + (runs[b].to * d + column - shift) * stride;
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

// A parent's Schur complement goes on the other of two stacks than its children's, which are dropped from the top of
// theirs when it is done: nothing is ever moved.
void BlockCholesky::eliminate(int32_t index, const double *diag, const double *off, Stack &stack, int threads, int &replaced) {
  const Supernode &s = supernodes_[index];
  const size_t m = below(s);
  const int front = static_cast<int>(columns(s) + m), width = static_cast<int>(columns(s)), rows = static_cast<int>(m);
  double *panel = &values_[s.value_start];
  assemble(s, diag, off);
  for (const int32_t c : s.children) extend_add(c, nullptr);
  replaced += factor_panel(panel, front, width, &original_diagonal_[static_cast<size_t>(s.first) * dim_]);
  const int side = s.depth % 2;
  double *update = kept_[index].empty() ? stack.memory[side].data() + stack.top[side] : kept_[index].data();
  minus_square(update, rows, panel + width, front, width, threads);
  for (const int32_t c : s.children) {
    if (m) extend_add(c, update);
    if (kept_[c].empty()) stack.top[1 - side] -= below(supernodes_[c]) * below(supernodes_[c]);
  }
  if (kept_[index].empty()) stack.top[side] += m * m;
  update_[index] = update;
}

void BlockCholesky::run_list(const std::vector<int32_t> &list, const double *diag, const double *off, Stack &stack, int threads, int &replaced) {
  stack.top[0] = stack.top[1] = 0;
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

// Supernode by supernode for all right-hand sides at once, so that a panel is read once.
void BlockCholesky::solve_many(double *x, int nrhs) const {
  const BlasSingleThread single;
  const size_t d = dim_, unknowns = static_cast<size_t>(n_) * d;
  const int ld = static_cast<int>(unknowns), most = static_cast<int>(largest_below_);
  std::vector<double> y(unknowns * nrhs), gathered(largest_below_ * nrhs);
  const auto permute = [&](bool back) {
    for (int r = 0; r < nrhs; ++r)
      for (int32_t k = 0; k < n_; ++k) {
        double *mine = &y[r * unknowns + static_cast<size_t>(position_[k]) * d], *theirs = x + r * unknowns + k * d;
        for (size_t c = 0; c < d; ++c) back ? theirs[c] = mine[c] : mine[c] = theirs[c];
      }
  };
  permute(false);
  for (const Supernode &s : supernodes_) {
    const int width = static_cast<int>(columns(s)), rows = static_cast<int>(below(s)), front = width + rows;
    const double *panel = &values_[s.value_start];
    double *top = &y[static_cast<size_t>(s.first) * d];
    solve_top(panel, front, width, top, ld, nrhs, "N");
    if (rows == 0) continue;
    if (nrhs == 1) dgemv_("N", &rows, &width, &one, panel + width, &front, top, &inc, &zero, gathered.data(), &inc);
    else dgemm_("N", "N", &rows, &nrhs, &width, &one, panel + width, &front, top, &ld, &zero, gathered.data(), &most);
    for (int r = 0; r < nrhs; ++r)
      for (size_t k = 0; k < s.row_count; ++k)
        for (size_t c = 0; c < d; ++c) y[r * unknowns + static_cast<size_t>(rows_[s.row_start + k]) * d + c] -= gathered[r * largest_below_ + k * d + c];
  }
  for (size_t index = supernodes_.size(); index-- > 0;) {
    const Supernode &s = supernodes_[index];
    const int width = static_cast<int>(columns(s)), rows = static_cast<int>(below(s)), front = width + rows;
    const double *panel = &values_[s.value_start];
    double *top = &y[static_cast<size_t>(s.first) * d];
    for (int r = 0; r < nrhs; ++r)
      for (size_t k = 0; k < s.row_count; ++k)
        for (size_t c = 0; c < d; ++c) gathered[r * largest_below_ + k * d + c] = y[r * unknowns + static_cast<size_t>(rows_[s.row_start + k]) * d + c];
    if (rows > 0 && nrhs == 1) dgemv_("T", &rows, &width, &minus_one, panel + width, &front, gathered.data(), &inc, &one, top, &inc);
    if (rows > 0 && nrhs > 1) dgemm_("T", "N", &width, &nrhs, &rows, &minus_one, panel + width, &front, gathered.data(), &most, &one, top, &ld);
    solve_top(panel, front, width, top, ld, nrhs, "T");
  }
  permute(true);
}

}  // namespace jam
