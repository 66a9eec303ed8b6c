// Numeric part: fronts, dense panels, triangular solves.
#include "linalg/block_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/with_dimension.hpp"
#include "linalg/blas.hpp"
#include "linalg/dense_front.hpp"
#include "linalg/tuning.hpp"

namespace jam::inside {
namespace {

using BlockSizes = Numbered<1, 2, 3, 4, 5, 6, 7, 8>;

}  // namespace

template <class Real>
void BlockCholesky::assemble(const Supernode &s, const double *diag, const double *off) {
  const size_t front = columns(s) + below(s), block = static_cast<size_t>(dim_) * dim_;
  Real *values = values_.as<Real>(), *original = original_diagonal_.as<Real>();
  for (size_t c = 0; c < columns(s); ++c) {  // what lies above the diagonal blocks is never read
    if (c % ThreadTuning::columns_a_look == ThreadTuning::columns_a_look - 1)
      CallScope::look();  // the system clears new pages
    const size_t top = c / dim_ * dim_;
    std::memset(&values[s.value_start + c * front + top], 0, (front - top) * sizeof(Real));
  }
  for (size_t k = s.entry_start; k < s.entry_start + s.entry_count; ++k) {
    const Entry &e = entries_[k];
    Real *to = &values[e.target];
    const double *from =
        e.edge >= 0 ? off + static_cast<size_t>(e.edge) * block : diag + static_cast<size_t>(-1 - e.edge) * block;
    // from is row-major: element (row p, column q) at p * dim + q; the panel is column-major.
    for (int q = 0; q < dim_; ++q)
      for (int p = 0; p < dim_; ++p)
        to[q * front + p] = static_cast<Real>(e.transposed ? from[q * dim_ + p] : from[p * dim_ + q]);
  }
  for (int32_t k = s.first; k < s.last; ++k)
    for (int q = 0; q < dim_; ++q) {
      const size_t c = static_cast<size_t>(k - s.first) * dim_ + q;
      original[static_cast<size_t>(k) * dim_ + q] = values[s.value_start + c * front + c];
    }
}

// Adds every `stride`-th block column of a child's Schur complement to the parent: to its panel when `update` is NULL
// (before the panel is factored), else to its Schur complement (after that was written, so that it needs no clearing).
template <int D, class Real>
void BlockCholesky::extend_add_columns(int32_t child, Real *update, size_t start, size_t stride) {
  const Supernode &c = supernodes_[child], &p = supernodes_[c.parent];
  const int32_t *place = &places_[c.row_start], own = p.last - p.first;
  const size_t mc = below(c), split = std::lower_bound(place, place + c.row_count, own) - place;
  const size_t ld = update ? below(p) : columns(p) + below(p), shift = update ? static_cast<size_t>(own) : 0;
  const Real *schur = static_cast<const Real *>(update_[child]);
  Real *into = update ? update : values_.as<Real>() + p.value_start;
  for (size_t b = (update ? split : 0) + start; b < (update ? c.row_count : split); b += stride) {
    if (b % ThreadTuning::blocks_a_look == ThreadTuning::blocks_a_look - 1) CallScope::look();
    const Real *from = schur + b * D * mc;
    Real *to = into + (place[b] - shift) * D * ld;
    for (size_t column = 0; column < D; ++column)
      for (size_t q = column; q < D; ++q) to[column * ld + (place[b] - shift) * D + q] += from[column * mc + b * D + q];
    for (size_t a = b + 1; a < c.row_count; ++a) {
      const Real *x = from + a * D;
      Real *y = to + (place[a] - shift) * D;
      for (size_t column = 0; column < D; ++column)
        for (size_t q = 0; q < D; ++q) y[column * ld + q] += x[column * mc + q];
    }
  }
}

template <class Real>
void BlockCholesky::extend_add(int32_t child, Real *update, Workers &workers) {
  const double mc = static_cast<double>(below(supernodes_[child]));
  const int parts = workers.parts(mc * mc, ThreadTuning::additions);
  workers.run(parts, [&](int part, int) {
    with_number(BlockSizes{}, dim_, [&](auto size) { extend_add_columns<size>(child, update, part, parts); });
  });
}

// A parent's Schur complement is put on the other of two stacks than its children's, which are dropped from the top of
// theirs when it is done: nothing is ever moved.
template <class Real>
void BlockCholesky::eliminate(int32_t index, const double *diag, const double *off, Stack &stack, Workers &workers,
                              int &replaced) {
  const Supernode &s = supernodes_[index];
  const size_t m = below(s);
  const int front = static_cast<int>(columns(s) + m), width = static_cast<int>(columns(s)), rows = static_cast<int>(m);
  Real *panel = values_.as<Real>() + s.value_start;
  const bool floats = sizeof(Real) == sizeof(float);
  const PivotRule rule{floats ? SupernodeTuning::lost_in_floats : relative_, floor_, floats};
  assemble<Real>(s, diag, off);
  for (const int32_t c : s.children) extend_add<Real>(c, nullptr, workers);
  replaced += factor_panel(panel, front, front, width,
                           original_diagonal_.as<Real>() + static_cast<size_t>(s.first) * dim_, rule, workers);
  const int side = s.side;
  const bool stacked = kept_at_[index] == on_stack;
  Real *update = stacked ? stack.memory[side].as<Real>() + stack.top[side] : kept_.as<Real>() + kept_at_[index];
  minus_square(update, rows, panel + width, front, width, workers);
  for (const int32_t c : s.children) {
    if (m) extend_add(c, update, workers);
    if (kept_at_[c] == on_stack) stack.top[1 - side] -= below(supernodes_[c]) * below(supernodes_[c]);
  }
  if (stacked) stack.top[side] += m * m;
  update_[index] = update;
}

template <class Real>
void BlockCholesky::run_list(const std::vector<int32_t> &list, const double *diag, const double *off, Stack &stack,
                             Workers &workers, int &replaced) {
  stack.top[0] = stack.top[1] = 0;
  for (const int32_t s : list) {
    eliminate<Real>(s, diag, off, stack, workers, replaced);
    CallScope::look();
  }
}

int BlockCholesky::factorise(const double *diag, const double *off, Precision precision) {
  const BlasThreads allowed(worker_count());
  precision_ = precision;
  const int threads = allowed.count();
  return precision == Precision::single ? factorise_as<float>(diag, off, threads)
                                        : factorise_as<double>(diag, off, threads);
}

template <class Real>
int BlockCholesky::factorise_as(const double *diag, const double *off, int threads) {
  Workers workers(threads, threads_ > 1);
  std::vector<int> lost(subtrees_.size() + 1, 0);
  workers.run(static_cast<int>(subtrees_.size()), [&](int tree, int worker) {
    Workers alone(1);
    run_list<Real>(subtrees_[tree], diag, off, stacks_[worker], alone, lost[tree]);
  });
  run_list<Real>(top_, diag, off, stacks_[0], workers, lost.back());
  for (const Supernode &s : supernodes_) {
    const size_t front = columns(s) + below(s);
    for (size_t c = 0; c < columns(s); ++c)
      if (!std::isfinite(values_.as<Real>()[s.value_start + c * front + c])) return -1;
  }
  return std::accumulate(lost.begin(), lost.end(), 0);
}

// Supernode by supernode for all right-hand sides at once, so that a panel is read once. above: as long as y, takes
// what is subtracted from entries behind the supernodes of the list. below_rows: room for the rows of one supernode.
template <class Real>
void BlockCholesky::forward(const std::vector<int32_t> &list, Real *y, Real *above, Real *below_rows, int nrhs,
                            Workers &workers) const {
  const size_t d = dim_, unknowns = static_cast<size_t>(n_) * d;
  const int32_t end = list.empty() ? 0 : supernodes_[list.back()].last;
  for (const int32_t index : list) {
    const Supernode &s = supernodes_[index];
    const int width = static_cast<int>(columns(s)), rows = static_cast<int>(below(s)), front = width + rows;
    if (static_cast<size_t>(front) * width > ThreadTuning::long_panel) CallScope::look();
    panel_forward(values_.as<Real>() + s.value_start, front, rows, width, y + static_cast<size_t>(s.first) * d,
                  static_cast<int>(unknowns), below_rows, static_cast<int>(largest_below_), nrhs, workers);
    for (int r = 0; r < nrhs; ++r)
      for (size_t k = 0; k < s.row_count; ++k) {
        const int32_t row = rows_[s.row_start + k];
        Real *to = (row < end ? y : above) + r * unknowns + static_cast<size_t>(row) * d;
        for (size_t c = 0; c < d; ++c) to[c] -= below_rows[r * largest_below_ + k * d + c];
      }
  }
}

template <class Real>
void BlockCholesky::backward(const std::vector<int32_t> &list, Real *y, Real *below_rows, int nrhs,
                             Workers &workers) const {
  const size_t d = dim_, unknowns = static_cast<size_t>(n_) * d;
  for (size_t at = list.size(); at-- > 0;) {
    const Supernode &s = supernodes_[list[at]];
    const int width = static_cast<int>(columns(s)), rows = static_cast<int>(below(s)), front = width + rows;
    if (static_cast<size_t>(front) * width > ThreadTuning::long_panel) CallScope::look();
    for (int r = 0; r < nrhs; ++r)
      for (size_t k = 0; k < s.row_count; ++k)
        for (size_t c = 0; c < d; ++c)
          below_rows[r * largest_below_ + k * d + c] =
              y[r * unknowns + static_cast<size_t>(rows_[s.row_start + k]) * d + c];
    panel_backward(values_.as<Real>() + s.value_start, front, rows, width, y + static_cast<size_t>(s.first) * d,
                   static_cast<int>(unknowns), below_rows, static_cast<int>(largest_below_), nrhs, workers);
  }
}

// Subtrees run at the same time, and each changes entries of the top of the tree. A worker collects these changes in a
// vector of its own that starts at zero; they are then added to y in the order of the subtrees.
template <class Real>
void BlockCholesky::solve_as(double *x, int nrhs, int threads) const {
  const size_t d = dim_, unknowns = static_cast<size_t>(n_) * d, room = largest_below_ * nrhs;
  const int trees = static_cast<int>(subtrees_.size());
  const bool large = value_count_ > ThreadTuning::factor;
  const int count = large ? threads : 1;
  Workers workers(count, large && threads_ > 1);
  std::vector<Real> y(unknowns * nrhs), above(trees > 0 ? count * y.size() : 0), below_rows(count * room);
  std::vector<std::vector<Real>> left(trees);
  const auto permute = [&](bool back) {
    for (int r = 0; r < nrhs; ++r)
      for (int32_t k = 0; k < n_; ++k) {
        Real *mine = &y[r * unknowns + static_cast<size_t>(position_[k]) * d];
        double *theirs = x + r * unknowns + k * d;
        for (size_t c = 0; c < d; ++c)
          if (back)
            theirs[c] = mine[c];
          else
            mine[c] = static_cast<Real>(theirs[c]);
      }
  };
  // Visits the entries above a subtree: those that its root passes on.
  const auto entries_above = [&](int tree, const auto &visit) {
    const Supernode &root = supernodes_[subtrees_[tree].back()];
    for (int r = 0; r < nrhs; ++r)
      for (size_t k = 0; k < root.row_count; ++k)
        for (size_t c = 0; c < d; ++c) visit(r * unknowns + static_cast<size_t>(rows_[root.row_start + k]) * d + c);
  };
  permute(false);
  for (int tree = 0; tree < trees; ++tree) left[tree].resize(supernodes_[subtrees_[tree].back()].row_count * d * nrhs);
  workers.run(trees, [&](int tree, int worker) {
    Workers one(1);
    Real *mine = above.data() + worker * y.size(), *to = left[tree].data();
    forward(subtrees_[tree], y.data(), mine, below_rows.data() + worker * room, nrhs, one);
    entries_above(tree, [&](size_t k) { *to++ = std::exchange(mine[k], Real(0)); });
  });
  for (int tree = 0; tree < trees; ++tree) {
    const Real *from = left[tree].data();
    entries_above(tree, [&](size_t k) { y[k] += *from++; });
  }
  forward(top_, y.data(), y.data(), below_rows.data(), nrhs, workers);
  backward(top_, y.data(), below_rows.data(), nrhs, workers);
  workers.run(trees, [&](int tree, int worker) {
    Workers one(1);
    backward(subtrees_[tree], y.data(), below_rows.data() + worker * room, nrhs, one);
  });
  permute(true);
}

void BlockCholesky::solve_many(double *x, int nrhs) const {
  const BlasThreads allowed(worker_count());
  precision_ == Precision::single ? solve_as<float>(x, nrhs, allowed.count())
                                  : solve_as<double>(x, nrhs, allowed.count());
}

struct ShiftedFactor::Impl {
  BlockCholesky cholesky;
  bool analysed = false;
};

ShiftedFactor::ShiftedFactor(const BlockMatrix &m) : m_(m), impl_(new Impl) {}

ShiftedFactor::~ShiftedFactor() = default;

bool ShiftedFactor::factorise(double shift) {
  shift_ = shift;
  if (!impl_->analysed) impl_->cholesky.analyse(m_.dim, m_.nodes, m_.ei.data(), m_.ej.data(), m_.ei.size());
  impl_->analysed = true;
  std::vector<double> diag(m_.diag);
  const size_t d = static_cast<size_t>(m_.dim);
  for (size_t i = 0; i < static_cast<size_t>(m_.nodes); ++i)
    for (size_t c = 0; c < d; ++c) diag[i * d * d + c * d + c] += shift;
  return impl_->cholesky.factorise(diag.data(), m_.off.data()) == 0;  // no pivot was replaced: positive definite
}

void ShiftedFactor::factorise_from(double start) {
  const double bound = 2.0 * m_.norm_bound() + start;
  if (!std::isfinite(bound)) fail(JAM_E_SOLVER, "the matrix has entries that are not finite");
  for (double shift = start; shift < 10.0 * bound; shift *= 10.0)
    if (factorise(shift)) return;
  fail(JAM_E_SOLVER, "the matrix is not positive definite even with a shift of %g", bound);
}

ShiftedFactor::Size ShiftedFactor::size() const { return impl_->cholesky.absolute_size(); }

void ShiftedFactor::solve_many(double *x, int count) const { impl_->cholesky.solve_many(x, count); }

}  // namespace jam::inside
