// Sparse Cholesky A = L L^T of symmetric positive (semi-)definite matrices made of d x d blocks on a particle graph.
// Multifrontal on supernodes (Duff and Reid, ACM Trans. Math. Softw. 9, 302 (1983)): order the particle graph,
// eliminate supernode by supernode on dense fronts with BLAS-3, hand each front's Schur complement to its parent.
#pragma once
#include <memory>

#include "linalg/block_matrix.hpp"
#include "linalg/workers.hpp"

namespace jam::inside {

// Room for numbers whose old values are not needed.

// Doubles, or as many floats in half the room, that are written before they are read. Nothing is cleared, since
// gigabytes take seconds. The old block goes before the new one comes. A new one is an eighth larger than asked, so
// that a list with a few pairs more fits into it. Pages beyond what was requested stay untouched.
class ScratchBuffer {
 public:
  void need(size_t size) {
    if (size <= capacity_) return;
    release();
    memory_.reset(new unsigned char[(size + size / 8) * sizeof(double)]);
    capacity_ = size + size / 8;
  }
  void release() {
    memory_.reset();
    capacity_ = 0;
  }
  template <class Real>
  Real *as() {
    return reinterpret_cast<Real *>(memory_.get());
  }
  template <class Real>
  const Real *as() const {
    return reinterpret_cast<const Real *>(memory_.get());
  }
  size_t capacity() const { return capacity_; }  // in doubles

 private:
  std::unique_ptr<unsigned char[]> memory_;
  size_t capacity_ = 0;
};

enum class Precision { full, single };  // doubles or floats

class BlockCholesky {
 public:
  // Both parts may be left by Cancelled, and analyse() fails where the numbers exceed the memory of the call: the next
  // call is then analyse().
  // Symbolic part: n nodes, unique undirected edges (ei[k], ej[k]), ei != ej. threads: above 1 independent subtrees and
  // parts of large fronts run side by side, with the same bits for every such number. order[k] is the node that is
  // eliminated k-th; empty: nested dissection.
  void analyse(int dim, int32_t n, const int32_t *ei, const int32_t *ej, size_t edges, int threads = 1,
               std::vector<int32_t> order = {});
  // The same with the elimination order of the last call, for a graph that changed little; analyse() when n is another.
  void analyse_keep_order(int dim, int32_t n, const int32_t *ei, const int32_t *ej, size_t edges, int threads = 1);
  // A pivot at or below max(relative * its diagonal entry in A, floor) counts as lost. Default 1e-16 and 0. Floats have
  // 4e-6 for `relative`.
  void set_pivot_rule(double relative, double floor) { relative_ = relative, floor_ = floor; }
  // Numeric part, allocates nothing. diag: n blocks of dim * dim, full and symmetric; off: one block an edge,
  // row-major, rows of ei and columns of ej. A pivot lost to rounding is replaced by a huge number, which fixes that
  // component of the solution at 0 (S. J. Wright, Primal-Dual Interior-Point Methods, SIAM 1997, ch. 11). Returns how
  // many were; -1: the result is not finite. In single precision it takes some half of the time, and solutions have six
  // digits over the condition number; matrix and solutions stay doubles. A pivot lost there is replaced by the bound,
  // so that the factor can still be a preconditioner.
  int factorise(const double *diag, const double *off, Precision precision = Precision::full);
  // x := A^-1 x, n * dim. May run on several x at once from different threads.
  void solve(double *x) const { solve_many(x, 1); }
  // The same for nrhs vectors one after the other in x.
  void solve_many(double *x, int nrhs) const;

  // For error bounds of a factor in doubles: the most entries in a row of L, and the largest row sum of |L| |L^T|,
  // which bounds its 2-norm; both at or above the exact ones.
  struct AbsoluteSize {
    size_t longest_row;
    double absolute_square;
  };
  AbsoluteSize absolute_size() const;

  // Frees the memory of the numbers. The next call is analyse() or analyse_keep_order().
  void release();

  // What analyse() would come to, without the memory for the numbers: flops of one factorisation; doubles in the factor
  // and in the fronts beside it.
  struct Sizes {
    double flops;
    size_t factor, fronts;
  };
  static Sizes measure(int dim, int32_t n, const int32_t *ei, const int32_t *ej, size_t edges, int threads);

  // The fronts from the leaves to the roots: index of the parent (-1: none), rows and columns of their panel.
  struct Front {
    int32_t parent;
    size_t rows, columns;
  };
  std::vector<Front> fronts() const;

  double flops() const { return flops_; }
  size_t bytes() const;
  size_t factor_nonzeros() const { return value_count_; }
  size_t front_numbers() const { return stack_count_; }
  size_t supernodes() const { return supernodes_.size(); }

 private:
  // Columns [first, last) of nodes in elimination order; rows: the nodes below them. Front = columns then rows.
  struct Supernode {
    int32_t first, last, parent;
    int side;                     // which of the two memories of a stack takes its Schur complement
    size_t row_start, row_count;  // in rows_ and places_
    size_t value_start;           // panel in values_, column-major, leading dimension = front size
    size_t entry_start, entry_count;
    std::vector<int32_t> children;
  };
  struct Entry {
    int64_t edge;   // >= 0: off-diagonal block; else diagonal block -1 - node
    size_t target;  // in values_
    bool transposed;
  };
  struct Stack {
    ScratchBuffer memory[2];  // of even and odd depth in the tree
    size_t top[2] = {0, 0};
  };
  static constexpr size_t on_stack = static_cast<size_t>(-1);  // in kept_at_
  size_t columns(const Supernode &s) const { return static_cast<size_t>(s.last - s.first) * dim_; }
  size_t below(const Supernode &s) const { return s.row_count * dim_; }

  void find_supernodes(const std::vector<int32_t> &parent, std::vector<std::vector<int32_t>> &structure);
  void place_entries(const int32_t *ei, const int32_t *ej, size_t edges);
  void plan();
  void allocate();
  void share_out(const std::vector<double> &work);
  void keep();
  void lay_stacks(const std::vector<int32_t> &list, size_t *need);
  size_t stack_need(int worker, int side) const;
  int worker_count() const;
  template <class Real>
  int factorise_as(const double *diag, const double *off, int threads);
  template <class Real>
  void eliminate(int32_t s, const double *diag, const double *off, Stack &stack, Workers &workers, int &replaced);
  template <class Real>
  void assemble(const Supernode &s, const double *diag, const double *off);
  template <class Real>
  void extend_add(int32_t child, Real *update, Workers &workers);
  template <int D, class Real>
  void extend_add_columns(int32_t child, Real *update, size_t start, size_t stride);
  template <class Real>
  void run_list(const std::vector<int32_t> &list, const double *diag, const double *off, Stack &stack, Workers &workers,
                int &replaced);

  template <class Real>
  void solve_as(double *x, int nrhs, int threads) const;
  template <class Real>
  void forward(const std::vector<int32_t> &list, Real *y, Real *above, Real *below_rows, int nrhs,
               Workers &workers) const;
  template <class Real>
  void backward(const std::vector<int32_t> &list, Real *y, Real *below_rows, int nrhs, Workers &workers) const;

  int dim_ = 0, threads_ = 1;
  bool dry_ = false;  // sizes only
  int32_t n_ = 0;
  double flops_ = 0.0, relative_ = 1e-16, floor_ = 0.0;
  std::vector<int32_t> order_;     // of the last analyse(), for analyse_keep_order()
  std::vector<int32_t> position_;  // node -> place in the elimination order
  std::vector<Supernode> supernodes_;
  std::vector<int32_t> rows_, places_;  // below a supernode; where in its parent's front they are
  std::vector<Entry> entries_;
  ScratchBuffer values_;
  ScratchBuffer original_diagonal_;
  Precision precision_ = Precision::full;
  std::vector<void *> update_;   // Schur complement of each supernode while it is needed
  std::vector<size_t> kept_at_;  // where in kept_ that of a subtree's root is, which outlives its thread's stack
  ScratchBuffer kept_;
  std::vector<std::vector<int32_t>> subtrees_;  // their supernodes, the root last; none with one thread
  std::vector<int32_t> top_;                    // all others
  std::vector<Stack> stacks_;                   // of each worker
  size_t largest_below_ = 0, value_count_ = 0, stack_count_ = 0, kept_count_ = 0;
  size_t subtree_need_[2] = {}, top_need_[2] = {};  // of stacks; the first one is that of the top, too
};

// Sparse Cholesky of a block matrix plus a multiple of the unit matrix.

class ShiftedFactor {
 public:
  explicit ShiftedFactor(const BlockMatrix &m);  // keeps a reference to m; its pattern is ordered once, its
                                                 // values are read again by every factorise
  ~ShiftedFactor();
  // Factorises m + shift; false when that is not positive definite.
  bool factorise(double shift);
  // The smallest shift of start * 10^k that gives a positive definite matrix; JAM_E_SOLVER past the norm of m.
  void factorise_from(double start);
  double shift() const { return shift_; }
  void solve(double *x) const { solve_many(x, 1); }  // x := (m + shift)^-1 x
  void solve_many(double *x, int count) const;       // count vectors one after the other
  size_t rows() const { return m_.rows(); }
  using Size = BlockCholesky::AbsoluteSize;
  Size size() const;

 private:
  struct Impl;
  const BlockMatrix &m_;
  std::unique_ptr<Impl> impl_;
  double shift_ = 0.0;
};

}  // namespace jam::inside
