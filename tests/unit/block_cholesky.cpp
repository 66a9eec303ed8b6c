// Sparse block Cholesky against dense factorisations: random graphs in d = 1..8, disconnected, tiny, singular,
// indefinite and non-finite matrices; natural and dissected orders, one thread and several.
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <set>
#include <thread>
#include "core/error.hpp"
#include "core/rng.hpp"
#include "linalg/block_cholesky.hpp"
#include "linalg/dense_front.hpp"
#include "test.h"

using namespace jam::inside;

namespace {

struct Problem {
  int dim = 0;
  int32_t n = 0;
  std::vector<int32_t> ei, ej;
  std::vector<double> diag, off;
  Eigen::MatrixXd dense() const {
    const int b = dim * dim;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n * dim, n * dim);
    for (int32_t i = 0; i < n; ++i)
      for (int p = 0; p < b; ++p) a(i * dim + p / dim, i * dim + p % dim) = diag[i * b + p];
    for (size_t k = 0; k < ei.size(); ++k)
      for (int p = 0; p < b; ++p) {
        a(ei[k] * dim + p / dim, ej[k] * dim + p % dim) = off[k * b + p];
        a(ej[k] * dim + p % dim, ei[k] * dim + p / dim) = off[k * b + p];
      }
    return a;
  }
};

// Edges between points of a cube (`local`) or between any two nodes, about `degree` at a node, in either direction.
Problem make_problem(int dim, int32_t n, double degree, bool local, int64_t seed) {
  Problem p;
  p.dim = dim, p.n = n;
  Rng rng(seed, Stream::analysis_start);
  std::vector<double> x(3 * static_cast<size_t>(n));
  for (double &v : x) v = rng.uniform();
  const double radius = std::cbrt(degree / (4.19 * n));
  for (int32_t i = 0; i < n; ++i)
    for (int32_t j = i + 1; j < n; ++j) {
      double r2 = 0.0;
      for (int c = 0; c < 3; ++c) {
        double t = std::fabs(x[3 * i + c] - x[3 * j + c]);
        t = std::min(t, 1.0 - t);
        r2 += t * t;
      }
      const bool joined = local ? r2 < radius * radius : rng.uniform() * n < degree;
      if (joined && rng.uniform() < 0.5)
        p.ei.push_back(i), p.ej.push_back(j);
      else if (joined)
        p.ei.push_back(j), p.ej.push_back(i);
    }
  const int b = dim * dim;
  p.diag.assign(static_cast<size_t>(n) * b, 0.0), p.off.resize(p.ei.size() * b);
  for (double &v : p.off) v = 2.0 * rng.uniform() - 1.0;
  for (int32_t i = 0; i < n; ++i) {
    for (int q = 0; q < b; ++q)
      if (q % dim <= q / dim) p.diag[i * b + q] = p.diag[i * b + (q % dim) * dim + q / dim] = rng.uniform() - 0.5;
    for (int q = 0; q < dim; ++q) p.diag[i * b + q * (dim + 1)] = dim + rng.uniform();
  }
  for (size_t k = 0; k < p.ei.size(); ++k)
    for (int q = 0; q < dim; ++q)
      p.diag[p.ei[k] * b + q * (dim + 1)] += dim, p.diag[p.ej[k] * b + q * (dim + 1)] += dim;
  return p;
}

// Stiffness of unit springs: sum over edges of n n^T, translations are its null space when the graph hangs together.
void make_springs(Problem &p, int64_t seed) {
  Rng rng(seed, Stream::velocities);
  const int d = p.dim, b = d * d;
  std::fill(p.diag.begin(), p.diag.end(), 0.0);
  for (size_t k = 0; k < p.ei.size(); ++k)
    for (int q = 0; q < d; ++q) {
      const double weight = 0.5 + rng.uniform();
      for (int c = 0; c < d; ++c) p.off[k * b + q * d + c] = q == c ? -weight : 0.0;
      p.diag[p.ei[k] * b + q * (d + 1)] += weight, p.diag[p.ej[k] * b + q * (d + 1)] += weight;
    }
}

double solve_error(const Problem &p, const BlockCholesky &f, int nrhs) {
  const Eigen::MatrixXd a = p.dense();
  Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.rows(), nrhs), x = b;
  if (nrhs == 1)
    f.solve(x.data());
  else
    f.solve_many(x.data(), nrhs);
  if (!x.allFinite()) return 1e300;
  return (a * x - b).norm() / (a.norm() * x.norm() + b.norm());
}

int analyse_and_factorise(BlockCholesky &f, const Problem &p, int threads, std::vector<int32_t> order = {}) {
  f.analyse(p.dim, p.n, p.ei.data(), p.ej.data(), p.ei.size(), threads, std::move(order));
  return f.factorise(p.diag.data(), p.off.data());
}

CASE(random_graphs) {
  for (int dim = 1; dim <= 8; ++dim)
    for (int32_t n : {1, 2, 3, 7, 40, 150, 400})
      for (double degree : {0.0, 1.0, 6.0, 14.0})
        for (int local = 0; local < 2; ++local) {
          if ((n > 150 && dim > 3) || (n > 40 && dim > 5)) continue;
          const Problem p = make_problem(dim, n, degree, local, dim * 1000 + n);
          for (const bool natural : {false, true}) {
            std::vector<int32_t> order(natural ? n : 0);
            std::iota(order.begin(), order.end(), 0);
            BlockCholesky f;
            assert_int_equal(analyse_and_factorise(f, p, 1 + n % 2, order), 0);
            assert_true(solve_error(p, f, 1) < 1e-14);
            assert_true(solve_error(p, f, 3) < 1e-14);
            assert_true(f.factor_nonzeros() >= static_cast<size_t>(n) * dim * (dim + 1) / 2);
          }
        }
}

// Floats solve to their own digits and leave nothing behind: doubles after them have the bits of doubles alone.
CASE(single_precision) {
  for (int dim = 1; dim <= 8; ++dim)
    for (const int threads : {1, 2}) {
      const Problem p = make_problem(dim, dim > 5 ? 40 : 300, 9.0, true, dim);
      BlockCholesky f, full;
      f.analyse(dim, p.n, p.ei.data(), p.ej.data(), p.ei.size(), threads);
      assert_int_equal(f.factorise(p.diag.data(), p.off.data(), Precision::single), 0);
      for (const int count : {1, 3}) {
        const double error = solve_error(p, f, count);
        assert_true(error < 3e-7 && error > 1e-12);
      }
      assert_int_equal(f.factorise(p.diag.data(), p.off.data()), 0);
      assert_int_equal(analyse_and_factorise(full, p, threads), 0);
      std::vector<double> x(static_cast<size_t>(p.n) * dim, 1.0), y = x;
      f.solve(x.data()), full.solve(y.data());
      assert_true(x == y);
    }
}

// A pivot that doubles find and floats lose is raised to 4e-6 of its entry, and counted. With that
// pivot x[1] is -1 / 4e-6 and x[0] is 1 / 4e-6, up to the roundings of floats.
CASE(single_precision_loses_pivots) {
  const std::vector<double> diag = {1.0, 1.0}, off = {1.0 - 1e-9};
  const int32_t i = 0, j = 1;
  BlockCholesky f;
  f.analyse(1, 2, &i, &j, 1);
  assert_int_equal(f.factorise(diag.data(), off.data()), 0);
  assert_int_equal(f.factorise(diag.data(), off.data(), Precision::single), 1);
  double x[2] = {1.0, 0.0};
  f.solve(x);
  assert_true(std::fabs(x[1] * 4e-6 + 1.0) < 1e-5 && std::fabs(x[0] * 4e-6 - 1.0) < 1e-4);
}

CASE(released_and_used_again) {
  for (const int threads : {1, 2}) {
    const Problem p = make_problem(3, 300, 9.0, true, 1);
    BlockCholesky f;
    assert_int_equal(analyse_and_factorise(f, p, threads), 0);
    std::vector<double> x(static_cast<size_t>(p.n) * 3, 1.0), y = x;
    f.solve(x.data());
    const size_t before = f.bytes();
    f.release();
    assert_true(f.bytes() + 8 * f.factor_nonzeros() < before);
    assert_int_equal(analyse_and_factorise(f, p, threads), 0);
    assert_int_equal(f.bytes(), before);
    f.solve(y.data());
    assert_true(x == y);
  }
}

CASE(dimension_refused) {
  const Problem p = make_problem(2, 7, 3.0, false, 1);
  for (const int dim : {0, 9}) {
    BlockCholesky f;
    try {
      f.analyse(dim, p.n, p.ei.data(), p.ej.data(), p.ei.size());
      fail_msg("blocks of %d were taken", dim);
    } catch (const Error &e) {
      assert_int_equal(e.code(), JAM_E_INTERNAL);
    }
  }
}

CASE(threads_agree) {
  const Problem p = make_problem(3, 700, 13.0, true, 3);
  BlockCholesky one, two;
  assert_int_equal(analyse_and_factorise(one, p, 1), 0);
  std::vector<double> b(static_cast<size_t>(p.n) * 3, 1.0), x = b, y = b, z = b;
  one.solve(x.data());
  one.factorise(p.diag.data(), p.off.data());
  one.solve(y.data());
  assert_true(x == y);  // bit for bit
  assert_int_equal(analyse_and_factorise(two, p, 2), 0);
  y = b;
  two.solve(y.data());
  for (size_t k = 0; k < x.size(); ++k) assert_true(std::fabs(x[k] - y[k]) < 1e-12);
  std::thread other([&] { one.solve(z.data()); });
  y = b;
  one.solve(y.data());
  other.join();
  assert_true(x == y && x == z);
}

// Where the system has no second thread to give, the parts run one after the other, to the same bits. In a process of
// its own, which may not have the memory for another stack.
CASE(no_second_thread) {
#ifdef JAM_SANITIZED
  print_message("not with a sanitizer, which needs that memory itself\n");
  skip();
#else
  const Problem p = make_problem(3, 2500, 25.0, true, 4);
  BlockCholesky f, one;
  std::vector<double> x(static_cast<size_t>(p.n) * 3, 1.0);
  one.analyse(3, p.n, p.ei.data(), p.ej.data(), p.ei.size(), 1);
  f.analyse(3, p.n, p.ei.data(), p.ej.data(), p.ei.size(), 2);
  const size_t bytes = x.size() * sizeof(double);
  void *shared = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  assert_true(shared != MAP_FAILED);
  const pid_t child = fork();
  if (child == 0) {
    std::vector<double> y = x;
    one.factorise(p.diag.data(), p.off.data());
    f.factorise(p.diag.data(), p.off.data());  // a BLAS library has the buffers of two threads then
    mallopt(M_MMAP_THRESHOLD, 1 << 30), mallopt(M_TRIM_THRESHOLD, 1 << 30);
    std::vector<char>(1 << 25);  // stays in the heap for what is allocated on the way
    const struct rlimit tight = {1 << 20, 1 << 20};
    setrlimit(RLIMIT_AS, &tight);
    bool threads = true;
    try {  // stacks of threads that are gone are used again: until there are none
      for (int k = 0; k < 100; ++k) std::thread([] { pause(); }).detach();
    } catch (const std::system_error &) {
      threads = false;
    }
    if (threads) _exit(2);
    if (f.factorise(p.diag.data(), p.off.data()) != 0) _exit(1);
    f.solve(y.data());
    std::memcpy(shared, y.data(), bytes);
    _exit(0);
  }
  int status = -1;
  assert_true(child > 0 && waitpid(child, &status, 0) == child);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  assert_int_equal(f.factorise(p.diag.data(), p.off.data()), 0);
  f.solve(x.data());
  assert_memory_equal(shared, x.data(), bytes);
  munmap(shared, bytes);
#endif
}

// Large enough that single panels and triangular solves are split: 4e6 numbers in the factor, fronts of 800 rows and
// more.
CASE(threads_share_fronts) {
  const Problem p = make_problem(3, 2500, 25.0, true, 4);
  BlockCholesky one, two;
  assert_int_equal(analyse_and_factorise(one, p, 1), 0);
  assert_int_equal(analyse_and_factorise(two, p, 2), 0);
  assert_true(one.factor_nonzeros() > 4000000);
  const size_t unknowns = static_cast<size_t>(p.n) * 3;
  std::vector<double> b(4 * unknowns);
  for (size_t k = 0; k < b.size(); ++k) b[k] = std::sin(static_cast<double>(k));
  const auto solved = [&](BlockCholesky &f) {  // alone, and three at once
    std::vector<double> x = b;
    f.solve_many(x.data(), 1);
    f.solve_many(x.data() + unknowns, 3);
    return x;
  };
  const std::vector<double> x = solved(one), y = solved(two);
  double largest = 0.0;
  for (const double v : x) largest = std::max(largest, std::fabs(v));
  for (size_t k = 0; k < x.size(); ++k) assert_true(std::fabs(x[k] - y[k]) < 1e-12 * largest);
  assert_int_equal(two.factorise(p.diag.data(), p.off.data()), 0);
  assert_true(solved(two) == y);  // parts are split the same way each time: bit for bit
  for (const int threads : {3, 4, 8, 64}) {
    BlockCholesky more;
    assert_int_equal(analyse_and_factorise(more, p, threads), 0);
    assert_true(solved(more) == y);
  }
}

// A panel tall enough that threads split every kernel, against Eigen.
CASE(panels) {
  const int rows = 5000, columns = 300, below = rows - columns;
  Eigen::MatrixXd a = Eigen::MatrixXd::Random(rows, columns);
  a.topRows(columns) = (a.topRows(columns) + a.topRows(columns).transpose()).eval();
  a.topRows(columns).diagonal().array() += 4.0 * columns;
  const Eigen::VectorXd diagonal = a.diagonal();
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    Eigen::MatrixXd l = a;
    assert_int_equal(factor_panel(l.data(), rows, rows, columns, diagonal.data(), {1e-16, 0.0}, workers), 0);
    const Eigen::MatrixXd upper = l.topRows(columns).triangularView<Eigen::Lower>().toDenseMatrix().transpose(),
                          rest = l.bottomRows(below);
    assert_true((upper.transpose() * upper - a.topRows(columns)).norm() < 1e-13 * a.norm());
    assert_true((rest * upper - a.bottomRows(below)).norm() < 1e-13 * a.norm());
    for (const int count : {1, 2}) {
      Eigen::MatrixXd top = Eigen::MatrixXd::Random(columns, count), under(below, count);
      const Eigen::MatrixXd forward = upper.transpose().triangularView<Eigen::Lower>().solve(top);
      panel_forward(l.data(), rows, below, columns, top.data(), columns, under.data(), below, count, workers);
      assert_true((top - forward).norm() < 1e-13 * forward.norm());
      assert_true((under - rest * forward).norm() < 1e-13 * under.norm());
      const Eigen::MatrixXd backward = upper.triangularView<Eigen::Upper>().solve(forward - rest.transpose() * under);
      panel_backward(l.data(), rows, below, columns, top.data(), columns, under.data(), below, count, workers);
      assert_true((top - backward).norm() < 1e-13 * backward.norm());
    }
  }
}

CASE(singular) {
  for (int dim = 2; dim <= 5; ++dim) {
    Problem p = make_problem(dim, 60, 16.0, true, 11);
    make_springs(p, 2);
    BlockCholesky f;
    f.set_pivot_rule(1e-12, 0.0);
    // One translation per direction in every part that hangs together.
    const int zeros = static_cast<int>(p.dense().rows()) -
                      static_cast<int>(Eigen::FullPivLU<Eigen::MatrixXd>(p.dense()).setThreshold(1e-10).rank());
    assert_true(zeros >= dim);
    assert_int_equal(analyse_and_factorise(f, p, 1), zeros);
    // A right-hand side in the range is solved, with 0 in the replaced components.
    Eigen::VectorXd b = p.dense() * Eigen::VectorXd::Random(p.n * dim), x = b;
    f.solve(x.data());
    assert_true((p.dense() * x - b).norm() < 1e-10 * b.norm());
    f.set_pivot_rule(0.0, 1e9);  // everything below the floor
    assert_int_equal(f.factorise(p.diag.data(), p.off.data()), p.n * dim);
    f.solve(x.data());
    assert_true(x.norm() < 1e-90);
  }
}

CASE(indefinite_and_not_finite) {
  Problem p = make_problem(3, 300, 12.0, true, 8);
  BlockCholesky f;
  assert_int_equal(analyse_and_factorise(f, p, 1), 0);
  const Problem good = p;
  for (int q = 0; q < 3; ++q) p.diag[100 * 9 + q * 4] = -5.0;
  assert_true(f.factorise(p.diag.data(), p.off.data()) > 0);
  std::vector<double> x(900, 1.0);
  f.solve(x.data());
  assert_true(std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); }));
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
    for (int where = 0; where < 8; ++where) {
      p = good;
      if (where < 4)
        p.diag[where * 9 * 70 + 3] = bad;  // below the diagonal of its block
      else
        p.off[p.off.size() / 9 * (where - 4)] = bad;
      for (int threads = 1; threads <= 2; ++threads) {
        BlockCholesky g;
        assert_int_equal(analyse_and_factorise(g, p, threads), -1);
      }
    }
  assert_int_equal(f.factorise(good.diag.data(), good.off.data()), 0);  // no memory of what was before
  assert_true(solve_error(good, f, 1) < 1e-14);
}

CASE(order_kept) {
  Problem p = make_problem(3, 300, 12.0, true, 21);
  BlockCholesky f;
  assert_int_equal(analyse_and_factorise(f, p, 1), 0);
  for (int k = 0; k < 20; ++k) p.ei.pop_back(), p.ej.pop_back();
  const std::set<std::pair<int32_t, int32_t>> present = [&] {
    std::set<std::pair<int32_t, int32_t>> s;
    for (size_t k = 0; k < p.ei.size(); ++k) s.insert({std::min(p.ei[k], p.ej[k]), std::max(p.ei[k], p.ej[k])});
    return s;
  }();
  for (int32_t i = 0; i < 20; ++i)
    if (!present.count({i, i + 150})) p.ei.push_back(i), p.ej.push_back(i + 150);
  p.off.assign(p.ei.size() * 9, -0.05);
  f.analyse_keep_order(3, p.n, p.ei.data(), p.ej.data(), p.ei.size());
  assert_int_equal(f.factorise(p.diag.data(), p.off.data()), 0);
  assert_true(solve_error(p, f, 1) < 1e-14);
}

// A crunch analyses graphs of the same size again and again: all of them together take hardly more room than one, and
// that is what was promised beforehand.
CASE(scratch_memory_is_reused) {
  for (const int threads : {1, 2, 64}) {
    BlockCholesky f;
    size_t largest = 0, promised = 0;
    for (int seed = 1; seed <= 6; ++seed) {
      const Problem p = make_problem(3, 1500, 12.0, true, seed);
      BlockCholesky alone;
      alone.analyse(3, p.n, p.ei.data(), p.ej.data(), p.ei.size(), threads);
      largest = std::max(largest, alone.bytes());
      const BlockCholesky::Sizes sizes = BlockCholesky::measure(3, p.n, p.ei.data(), p.ej.data(), p.ei.size(), threads);
      promised = std::max(promised, sizes.factor + sizes.fronts);
      f.analyse(3, p.n, p.ei.data(), p.ej.data(), p.ei.size(), threads);
    }
    assert_true(static_cast<double>(f.bytes()) < 1.15 * static_cast<double>(largest));
    assert_true(static_cast<double>(largest) <
                1.15 * 8.0 * static_cast<double>(promised) + 1e6);  // tables of the symbolic part
  }
}

// Fronts come before their parents, share all columns, and pass on fewer rows than their parent has.
CASE(fronts_make_up_the_factor) {
  const Problem p = make_problem(3, 500, 12.0, true, 1);
  BlockCholesky f;
  f.analyse(3, p.n, p.ei.data(), p.ej.data(), p.ei.size());
  const auto fronts = f.fronts();
  assert_int_equal(fronts.size(), f.supernodes());
  size_t numbers = 0, columns = 0;
  for (size_t k = 0; k < fronts.size(); ++k) {
    numbers += fronts[k].rows * fronts[k].columns, columns += fronts[k].columns;
    const int32_t parent = fronts[k].parent;
    if (parent < 0)
      assert_int_equal(fronts[k].rows, fronts[k].columns);
    else
      assert_true(parent > static_cast<int32_t>(k) && fronts[k].rows - fronts[k].columns <= fronts[parent].rows);
  }
  assert_int_equal(numbers, f.factor_nonzeros());
  assert_int_equal(columns, 1500);
}

}  // namespace
