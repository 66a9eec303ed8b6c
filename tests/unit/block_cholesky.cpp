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
#include <thread>
#include "core/rng.hpp"
#include "linalg/block_cholesky.hpp"
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

double solve_error(const Eigen::MatrixXd &a, const BlockCholesky &f, int nrhs) {
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
          const Eigen::MatrixXd a = p.dense();
          for (const bool natural : {false, true}) {
            std::vector<int32_t> order(natural ? n : 0);
            std::iota(order.begin(), order.end(), 0);
            BlockCholesky f;
            assert_int_equal(analyse_and_factorise(f, p, 1 + n % 2, order), 0);
            assert_true(solve_error(a, f, 1) < 1e-14);
            assert_true(solve_error(a, f, 3) < 1e-14);
            assert_true(f.factor_nonzeros() >= static_cast<size_t>(n) * dim * (dim + 1) / 2);
          }
        }
}

// Floats solve to their own digits and leave nothing behind: doubles after them have the bits of doubles alone.
CASE(single_precision) {
  for (int dim = 1; dim <= 8; ++dim)
    for (const int threads : {1, 2}) {
      const Problem p = make_problem(dim, dim > 5 ? 40 : 300, 9.0, true, dim);
      const Eigen::MatrixXd a = p.dense();
      BlockCholesky f, full;
      f.analyse(dim, p.n, p.ei.data(), p.ej.data(), p.ei.size(), threads);
      assert_int_equal(f.factorise(p.diag.data(), p.off.data(), Precision::single), 0);
      for (const int count : {1, 3}) {
        const double error = solve_error(a, f, count);
        assert_true(error < 3e-7 && error > 1e-12);
      }
      assert_int_equal(f.factorise(p.diag.data(), p.off.data()), 0);
      assert_int_equal(analyse_and_factorise(full, p, threads), 0);
      std::vector<double> x(static_cast<size_t>(p.n) * dim, 1.0), y = x;
      f.solve(x.data()), full.solve(y.data());
      assert_true(x == y);
    }
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
  for (size_t r = 0; r < 4; ++r) {  // A x - b, row by row
    const double *at = x.data() + r * unknowns;
    std::vector<double> rest(unknowns);
    for (size_t u = 0; u < unknowns; ++u) rest[u] = -b[r * unknowns + u];
    const auto add = [&](size_t i, size_t j, const double *block, bool turned) {
      for (size_t c = 0; c < 9; ++c) rest[3 * i + c / 3] += block[turned ? c % 3 * 3 + c / 3 : c] * at[3 * j + c % 3];
    };
    for (size_t i = 0; i < unknowns / 3; ++i) add(i, i, &p.diag[9 * i], false);
    for (size_t k = 0; k < p.ei.size(); ++k)
      add(p.ei[k], p.ej[k], &p.off[9 * k], false), add(p.ej[k], p.ei[k], &p.off[9 * k], true);
    for (const double v : rest) assert_true(std::fabs(v) < 1e-12);
  }
  for (size_t k = 0; k < x.size(); ++k) assert_true(std::fabs(x[k] - y[k]) < 1e-12 * largest);
  assert_int_equal(two.factorise(p.diag.data(), p.off.data()), 0);
  assert_true(solved(two) == y);  // parts are split the same way each time: bit for bit
  std::vector<double> beside;     // two callers solve with one factor
  std::thread other([&] { beside = solved(one); });
  const std::vector<double> here = solved(one);
  other.join();
  assert_true(here == x && beside == x);
  for (const int threads : {3, 64}) {
    BlockCholesky more;
    assert_int_equal(analyse_and_factorise(more, p, threads), 0);
    assert_true(solved(more) == y);
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
  assert_true(solve_error(good.dense(), f, 1) < 1e-14);
}

}  // namespace
