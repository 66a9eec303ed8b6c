// The full spectrum by own loops, with the same bits on all processors: Householder reduction by panels (Dongarra,
// Hammarling and Sorensen, J. Comput. Appl. Math. 27, 215 (1989)), then QL with implicit shifts (Golub and Van Loan,
// Matrix Computations, sec. 8.3).
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/modes.hpp"
#include "core/error.hpp"
#include "linalg/blas.hpp"

namespace jam::inside {
namespace {

using Stop = std::function<bool(double)>;
using Tuning = DenseTuning;
constexpr int panel = Tuning::panel, strip = Tuning::strip;

// A symmetric matrix becomes tridiagonal: `diagonal`, `off`. Below the diagonal of A stay the vectors v of the
// reflections 1 - tau v v^T.
struct Reduction {
  int n;
  std::vector<double> &a;
  std::vector<double> diagonal, off, tau;
  Reduction(int size, std::vector<double> &matrix)
      : n(size), a(matrix), diagonal(size), off(size, 0.0), tau(size, 0.0) {}
  double *at(int row, int column) { return &a[static_cast<size_t>(column) * n + row]; }

  // v and tau of the reflection that maps x to a multiple of its first entry, which is returned; x becomes v.
  double reflect(int m, double *x, double &factor) {
    double rest = 0.0;
    Blas<double>::subtract_transposed(m - 1, 1, 1, x + 1, m, x + 1, m, &rest, 1);
    rest = -rest;
    if (rest == 0.0) {
      factor = 0.0;
      return x[0];
    }
    const double length = std::sqrt(x[0] * x[0] + rest), alpha = x[0] > 0.0 ? -length : length;
    x[0] -= alpha;
    factor = 2.0 / (x[0] * x[0] + rest);
    return alpha;
  }

  // Columns k to k + width. left = (V, W) and right = (W, V), of `rest` rows: A - left right^T is the matrix so far.
  void reduce_panel(int k, int width, std::vector<double> &left, std::vector<double> &right) {
    const int rest = n - k;
    const auto v = [&](int c) { return &left[static_cast<size_t>(c) * rest]; };
    const auto w = [&](int c) { return &left[static_cast<size_t>(width + c) * rest]; };
    std::vector<double> dots(2 * static_cast<size_t>(width)), change(rest);
    std::fill(left.begin(), left.end(), 0.0);
    std::fill(right.begin(), right.end(), 0.0);
    for (int c = 0; c < width; ++c) {
      double *const column = at(k, k + c);
      for (int q = 0; q < c; ++q)
        for (int i = c; i < rest; ++i) column[i] -= v(q)[i] * w(q)[c] + w(q)[i] * v(q)[c];
      diagonal[k + c] = column[c];
      const int m = rest - c - 1;
      if (m == 0) return;
      off[k + c] = reflect(m, column + c + 1, tau[k + c]);
      std::copy(column + c + 1, column + rest, v(c) + c + 1);
      const double *const x = v(c) + c + 1;
      double *const p = w(c) + c + 1;
      Blas<double>::multiply(m, m, 1, at(k + c + 1, k + c + 1), n, x, m, p, m);
      std::fill(dots.begin(), dots.end(), 0.0);
      if (c > 0) {  // p -= V (W . x) + W (V . x), with right = (W, V)
        Blas<double>::subtract_transposed(m, 2 * width, 1, &right[c + 1], rest, x, m, dots.data(), 2 * width);
        Blas<double>::multiply(m, 2 * width, 1, &left[c + 1], rest, dots.data(), 2 * width, change.data(), m);
        // The column of p itself has the factor zero, since that of x in `right` is not yet there.
        for (int i = 0; i < m; ++i) p[i] += change[i];
      }
      double product = 0.0;
      Blas<double>::subtract_transposed(m, 1, 1, p, m, x, m, &product, 1);
      const double t = tau[k + c], half = 0.5 * t * t * product;
      for (int i = 0; i < m; ++i) p[i] = t * p[i] + half * x[i];
      std::copy(p, p + m, &right[static_cast<size_t>(c) * rest + c + 1]);
      std::copy(x, x + m, &right[static_cast<size_t>(width + c) * rest + c + 1]);
    }
    const int m = rest - width;
    if (m > 0)
      Blas<double>::minus_product(m, m, 2 * width, &left[width], rest, &right[width], rest, Result::added,
                                  at(k + width, k + width), n);
  }

  bool run(const Stop &stop) {
    for (int k = 0; k < n; k += panel) {
      const double left_over = 1.0 - static_cast<double>(k) / n;
      if (stop(Tuning::reduction * (1.0 - left_over * left_over * left_over))) return false;
      const int width = std::min(panel, n - k);
      std::vector<double> left(static_cast<size_t>(n - k) * 2 * width), right(left.size());
      reduce_panel(k, width, left, right);
    }
    return true;
  }

  // The product of all reflections.
  bool vectors(const Stop &stop, std::vector<double> &z) {
    for (int first = 0; first < n; first += panel) {
      if (stop(Tuning::reduction + Tuning::reflections * first / n)) return false;
      const int columns = std::min(panel, n - first);
      double dots[panel];
      for (int c = 0; c < columns; ++c) z[static_cast<size_t>(first + c) * n + first + c] = 1.0;
      for (int k = n - 2; k >= 0; --k) {
        if (tau[k] == 0.0) continue;
        double *const rows = &z[static_cast<size_t>(first) * n + k + 1];
        std::fill(dots, dots + columns, 0.0);
        Blas<double>::subtract_transposed(n - k - 1, columns, 1, rows, n, at(k + 1, k), n, dots, columns);
        for (int c = 0; c < columns; ++c) dots[c] *= -tau[k];
        Blas<double>::minus_product(n - k - 1, columns, 1, at(k + 1, k), n, dots, columns, Result::added, rows, n);
      }
    }
    return true;
  }
};

struct Rotation {
  int column;  // with the next one
  double c, s;
};

// Turns the columns of z, strip by strip, and forgets the rotations.
void apply(std::vector<Rotation> &waiting, int n, std::vector<double> &z) {
  for (int row = 0; row < n && !z.empty(); row += strip) {
    const int rows = std::min(strip, n - row);
    for (const Rotation &r : waiting) {
      double *const x = &z[static_cast<size_t>(r.column) * n + row], *const y = x + n;
      for (int i = 0; i < rows; ++i) {
        const double left = x[i], right = y[i];
        x[i] = r.c * left - r.s * right;
        y[i] = r.s * left + r.c * right;
      }
    }
  }
  waiting.clear();
}

// One step of QL on the rows l to m, which nothing couples to others.
void ql_step(int l, int m, double *d, double *e, bool vectors, std::vector<Rotation> &waiting) {
  double g = (d[l + 1] - d[l]) / (2.0 * e[l]), r = std::sqrt(g * g + 1.0);
  g = d[m] - d[l] + e[l] / (g + (g >= 0.0 ? r : -r));
  double s = 1.0, c = 1.0, p = 0.0;
  for (int i = m - 1; i >= l; --i) {
    const double f = s * e[i], b = c * e[i];
    e[i + 1] = r = std::sqrt(f * f + g * g);
    if (r == 0.0) {  // the rows come apart here
      d[i + 1] -= p;
      e[m] = 0.0;
      return;
    }
    s = f / r, c = g / r;
    g = d[i + 1] - p;
    r = (d[i] - g) * s + 2.0 * c * b;
    p = s * r;
    d[i + 1] = g + p;
    g = c * r - b;
    if (vectors) waiting.push_back({i, c, s});
  }
  d[l] -= p, e[l] = g, e[m] = 0.0;
}

bool diagonalise(int n, double *d, double *e, std::vector<double> &z, const Stop &stop) {
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  std::vector<Rotation> waiting;
  for (int l = 0; l < n; ++l) {
    if (l % panel == 0 && stop(1.0 - (1.0 - Tuning::reduction - Tuning::reflections) * (n - l) / n)) return false;
    for (int iteration = 0;; ++iteration) {
      int m = l;
      while (m + 1 < n && std::fabs(e[m]) > rounding * (std::fabs(d[m]) + std::fabs(d[m + 1]))) ++m;
      if (m == l) break;
      if (iteration == Tuning::most_iterations) fail(JAM_E_SOLVER, "QL did not converge at eigenvalue %d of %d", l, n);
      ql_step(l, m, d, e, !z.empty(), waiting);
      if (waiting.size() > Tuning::most_waiting) apply(waiting, n, z);
    }
  }
  apply(waiting, n, z);
  return true;
}

}  // namespace

bool dense_eigen_builtin(int n, std::vector<double> &a, std::vector<double> &lambda, bool vectors, const Stop &stop) {
  lambda.assign(n, 0.0);
  if (n == 0) return true;
  double largest = 0.0;
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) {
      const double x = a[static_cast<size_t>(j) * n + i];
      a[static_cast<size_t>(i) * n + j] = x;
      largest = std::max(largest, std::fabs(x));
    }
  int exponent = 0;
  std::frexp(largest, &exponent);  // squares of numbers near one neither overflow nor vanish
  for (double &x : a) x = std::ldexp(x, -exponent);
  Reduction reduction(n, a);
  std::vector<double> z(vectors ? static_cast<size_t>(n) * n : 0);
  if (!reduction.run(stop) || (vectors && !reduction.vectors(stop, z))) return false;
  double *const d = reduction.diagonal.data();
  if (!diagonalise(n, d, reduction.off.data(), z, stop)) return false;
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return d[i] < d[j]; });
  for (int k = 0; k < n; ++k) {
    lambda[k] = std::ldexp(d[order[k]], exponent);
    if (vectors) std::copy_n(&z[static_cast<size_t>(order[k]) * n], n, &a[static_cast<size_t>(k) * n]);
  }
  return true;
}

// Modes from the whole spectrum: all of them, and the choice among them without translations.

jam_status all_modes(const BlockMatrix &h, Monitor &monitor, Modes &out) {
  const int n = static_cast<int>(h.rows()), d = h.dim;
  std::vector<double> a = lapack_array(static_cast<size_t>(n) * n);
  auto put = [&](int32_t i, int32_t j, const double *block) {
    for (int r = 0; r < d; ++r)
      for (int c = 0; c < d; ++c) a[static_cast<size_t>(j * d + c) * n + (i * d + r)] = block[r * d + c];
  };
  for (int32_t i = 0; i < h.nodes; ++i) put(i, i, &h.diag[static_cast<size_t>(i) * d * d]);
  for (size_t e = 0; e < h.ei.size(); ++e)
    put(h.ej[e], h.ei[e], &h.off[e * d * d]);  // lower triangle; blocks are symmetric
  auto stop = [&](double fraction) {
    jam_progress p = progress_of(JAM_PHASE_ANALYSE);
    p.fraction = fraction;
    return monitor.report(p, fraction == 0.0);
  };
  if (!dense_eigen(n, a, out.lambda, stop)) return JAM_CANCELLED;
  out.vector = std::move(a);
  return JAM_OK;
}

void select_modes(const RigidityMatrix &g, const jam_modes_options &o, Modes &m) {
  const size_t n = g.unknowns();
  std::vector<size_t> keep;
  // Translations may be mixed with other zero modes: take them out of the vectors and drop what is left of least
  // length.
  const double tiny =  // in the unit of the stiffness, which after jam_relax is any
      m.lambda.empty() ? 0.0 : 1e-9 * std::max(std::fabs(m.lambda.front()), std::fabs(m.lambda.back()));
  Eigen::Map<Eigen::MatrixXd> v(m.vector.data(), static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  std::vector<size_t> zero;
  for (size_t k = 0; k < n; ++k)
    if (std::fabs(m.lambda[k]) <= tiny) zero.push_back(k);
  Eigen::MatrixXd z(n, zero.size());
  Eigen::Index rank = 0;
  const Eigen::Index room = std::max<Eigen::Index>(0, static_cast<Eigen::Index>(zero.size()) - g.symmetries());
  for (Eigen::Index pass = 0; pass < static_cast<Eigen::Index>(zero.size()) && rank < room; ++pass) {
    Eigen::VectorXd x = v.col(static_cast<Eigen::Index>(zero[pass]));
    for (int twice = 0; twice < 2; ++twice) {
      g.remove_symmetries(x.data());
      if (rank > 0) x -= z.leftCols(rank) * (z.leftCols(rank).transpose() * x).eval();
    }
    if (x.norm() < ModesTuning::spent && pass + (room - rank) < static_cast<Eigen::Index>(zero.size())) continue;
    z.col(rank++) = x.normalized();
  }
  for (Eigen::Index k = 0; k < rank; ++k) v.col(static_cast<Eigen::Index>(zero[k])) = z.col(k);
  for (size_t k = 0, seen = 0; k < n; ++k)
    if (std::fabs(m.lambda[k]) > tiny || static_cast<Eigen::Index>(seen++) < rank) keep.push_back(k);
  const double target = o.frequency * o.frequency;
  const size_t want = std::min<size_t>(keep.size(), static_cast<size_t>(o.count));
  if (o.which == JAM_MODES_HIGHEST) keep.erase(keep.begin(), keep.end() - static_cast<std::ptrdiff_t>(want));
  if (o.which == JAM_MODES_NEAR) {
    std::stable_sort(keep.begin(), keep.end(), [&](size_t x, size_t y) {
      return std::fabs(m.lambda[x] - target) < std::fabs(m.lambda[y] - target);
    });
    keep.resize(want);
    std::sort(keep.begin(), keep.end());
  }
  keep.resize(want);
  Modes cut;
  for (size_t k : keep) {
    cut.lambda.push_back(m.lambda[k]);
    cut.vector.insert(cut.vector.end(), &m.vector[k * n], &m.vector[k * n] + n);
  }
  m = std::move(cut);
}

}  // namespace jam::inside
