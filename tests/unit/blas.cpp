// The dense routines, those of the build and our own loops of each instruction set, against sums in long double, for
// sizes around those of tiles and vectors. Our own loops give the same bits in every instruction set. Packed storage,
// neighbours and the upper triangle stay as they were.
#include "linalg/blas.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "core/rng.hpp"
#include "linalg/blas/routines.hpp"
#include "test.h"

using namespace jam::inside;

namespace {

// best: what the build calls (JAM_BLAS).
template <class Real>
BlasRoutines<Real> routines_of(InstructionSet set) {
  using B = Blas<Real>;
  if (set != InstructionSet::best) return blas_routines<Real>(set);
  return {B::minus_product, B::minus_square,       B::divide, B::solve, B::solve_transposed,
          B::multiply,      B::subtract_transposed};
}

// A matrix by columns, with rows to spare.
template <class Real>
struct Matrix {
  int rows, columns, ld;
  std::vector<Real> value;
  Matrix(int m, int n, Rng &rng) : rows(m), columns(n), ld(m + 3), value(static_cast<size_t>(ld) * n) {
    for (Real &x : value) x = static_cast<Real>(rng.normal());
  }
  Real *data() { return value.data(); }
  Real &operator()(int i, int j) { return value[static_cast<size_t>(j) * ld + i]; }
};

template <class Real>
Matrix<Real> triangle(int n, Rng &rng) {
  Matrix<Real> l(n, n, rng);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (i > j) l(i, j) /= static_cast<Real>(n);  // so that the inverse stays near one
      if (i == j) l(i, j) = 1 + std::fabs(l(i, j));
      if (i < j) l(i, j) = std::numeric_limits<Real>::quiet_NaN();  // never read
    }
  return l;
}

// What a routine may be off from the exact sum: a rounding for each of the operations, on the sum of magnitudes.
template <class Real>
void assert_near(Real got, long double exact, long double magnitude, int operations) {
  const long double bound = (operations + 4) * std::numeric_limits<Real>::epsilon() * magnitude;
  if (!(std::fabs(static_cast<long double>(got) - exact) <= bound))
    fail_msg("%.17g is not %.17Lg within %Lg", static_cast<double>(got), exact, bound);
}

template <class Real>
void products_are_sums(InstructionSet set, int m, int n, int k) {
  Rng rng(m + 100 * n + 10000 * k, Stream::analysis_start);
  const BlasRoutines<Real> blas = routines_of<Real>(set);
  Matrix<Real> a(m, k, rng), b(n, k, rng), x(k, 2, rng), y(m, 2, rng);
  for (const Result result : {Result::written, Result::added})
    for (const bool square : {false, true}) {
      Matrix<Real> c(m, square ? m : n, rng), before = c;
      Matrix<Real> &second = square ? a : b;
      if (square)
        blas.minus_square(m, k, a.data(), a.ld, result, c.data(), c.ld);
      else
        blas.minus_product(m, n, k, a.data(), a.ld, b.data(), b.ld, result, c.data(), c.ld);
      for (int j = 0; j < c.columns; ++j)
        for (int i = 0; i < c.ld; ++i) {
          if (i >= m || (square && i < j)) {
            assert_true(c(i, j) == before(i, j));
            continue;
          }
          long double sum = result == Result::added ? before(i, j) : 0, size = std::fabs(sum);
          for (int q = 0; q < k; ++q) {
            const long double term = static_cast<long double>(a(i, q)) * second(j, q);
            sum -= term, size += std::fabs(term);
          }
          assert_near(c(i, j), sum, size, 2 * k);
        }
    }
  Matrix<Real> product = y, rest = x;
  blas.multiply(m, k, 2, a.data(), a.ld, x.data(), x.ld, product.data(), product.ld);
  blas.subtract_transposed(m, k, 2, a.data(), a.ld, y.data(), y.ld, rest.data(), rest.ld);
  for (int r = 0; r < 2; ++r) {
    for (int i = 0; i < m; ++i) {
      long double sum = 0, size = 0;
      for (int q = 0; q < k; ++q) {
        const long double term = static_cast<long double>(a(i, q)) * x(q, r);
        sum += term, size += std::fabs(term);
      }
      assert_near(product(i, r), sum, size, 2 * k);
    }
    for (int q = 0; q < k; ++q) {
      long double sum = x(q, r), size = std::fabs(sum);
      for (int i = 0; i < m; ++i) {
        const long double term = static_cast<long double>(a(i, q)) * y(i, r);
        sum -= term, size += std::fabs(term);
      }
      assert_near(rest(q, r), sum, size, 2 * m);
    }
  }
}

// Solutions are judged by what they leave: L x - b.
template <class Real>
void solutions_fit(InstructionSet set, int m, int n) {
  Rng rng(m + 1000 * n, Stream::analysis_start);
  const BlasRoutines<Real> blas = routines_of<Real>(set);
  Matrix<Real> l = triangle<Real>(n, rng), b(m, n, rng), x(n, 3, rng);
  Matrix<Real> divided = b, down = x, up = x;
  blas.divide(m, n, l.data(), l.ld, divided.data(), divided.ld);
  blas.solve(n, 3, l.data(), l.ld, down.data(), down.ld);
  blas.solve_transposed(n, 3, l.data(), l.ld, up.data(), up.ld);
  const auto check = [&](const auto &l_of, const auto &got, long double wanted) {
    long double sum = 0, size = std::fabs(wanted);
    for (int q = 0; q < n; ++q) {
      const long double term = static_cast<long double>(l_of(q)) * got(q);
      sum += term, size += std::fabs(term);
    }
    assert_near(static_cast<Real>(0), sum - wanted, size, 3 * n);
  };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j)
      check([&](int q) { return q <= j ? l(j, q) : Real(0); }, [&](int q) { return divided(i, q); }, b(i, j));
  for (int j = 0; j < n; ++j)
    for (int i = m; i < b.ld; ++i) assert_true(divided(i, j) == b(i, j));
  for (int r = 0; r < 3; ++r)
    for (int j = 0; j < n; ++j) {
      check([&](int q) { return q <= j ? l(j, q) : Real(0); }, [&](int q) { return down(q, r); }, x(j, r));
      check([&](int q) { return q >= j ? l(q, j) : Real(0); }, [&](int q) { return up(q, r); }, x(j, r));
    }
}

constexpr int some[] = {1, 2, 3, 5, 8, 13, 24, 31, 49};
constexpr InstructionSet sets[] = {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512};
constexpr InstructionSet with_build[] = {InstructionSet::best, InstructionSet::portable, InstructionSet::avx2,
                                         InstructionSet::avx512};

CASE(products_equal_their_sums) {
  for (const InstructionSet set : with_build) {
    if (!has_instruction_set(set)) continue;
    for (const int m : some)
      for (const int n : some)
        for (const int k : {1, 2, 7, 16})
          products_are_sums<double>(set, m, n, k), products_are_sums<float>(set, m, n, k);
    products_are_sums<double>(set, 101, 601, 300);  // more than a block in each direction
    products_are_sums<float>(set, 101, 601, 600);
  }
}

CASE(solutions_solve_their_equations) {
  for (const InstructionSet set : with_build) {
    if (!has_instruction_set(set)) continue;
    for (const int m : some)
      for (const int n : some) solutions_fit<double>(set, m, n), solutions_fit<float>(set, m, n);
  }
}

// All numbers that the routines compute for one size.
template <class Real>
std::vector<Real> all_results(InstructionSet set, int m, int n, int k) {
  Rng rng(m + n + k, Stream::analysis_start);
  const BlasRoutines<Real> blas = routines_of<Real>(set);
  Matrix<Real> a(m, k, rng), b(n, k, rng), c(m, n, rng), square(m, m, rng), l = triangle<Real>(k, rng), x(k, 2, rng),
                                                                            y(m, 2, rng);
  blas.minus_product(m, n, k, a.data(), a.ld, b.data(), b.ld, Result::added, c.data(), c.ld);
  blas.minus_square(m, k, a.data(), a.ld, Result::added, square.data(), square.ld);
  blas.divide(m, k, l.data(), l.ld, a.data(), a.ld);
  blas.solve(k, 2, l.data(), l.ld, x.data(), x.ld);
  blas.subtract_transposed(m, k, 2, a.data(), a.ld, y.data(), y.ld, x.data(), x.ld);
  blas.solve_transposed(k, 2, l.data(), l.ld, x.data(), x.ld);
  blas.multiply(m, k, 2, a.data(), a.ld, x.data(), x.ld, y.data(), y.ld);
  std::vector<Real> all;
  for (Matrix<Real> *matrix : {&a, &c, &square, &x, &y})
    for (int j = 0; j < matrix->columns; ++j)
      for (int i = 0; i < matrix->rows; ++i) all.push_back((*matrix)(i, j));
  return all;
}

template <class Real>
void assert_same_bits(int m, int n, int k) {
  const std::vector<Real> first = all_results<Real>(InstructionSet::portable, m, n, k);
  for (const InstructionSet set : sets) {
    if (!has_instruction_set(set)) continue;
    const std::vector<Real> other = all_results<Real>(set, m, n, k);
    assert_memory_equal(first.data(), other.data(), first.size() * sizeof(Real));
  }
}

CASE(instruction_sets_give_the_same_bits) {
  for (const int m : some)
    for (const int n : some) assert_same_bits<double>(m, n, m + n), assert_same_bits<float>(m, n, m + n);
  assert_same_bits<double>(203, 531, 301);
  assert_same_bits<float>(203, 531, 601);
}

}  // namespace
