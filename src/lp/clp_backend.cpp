// LPs by Clp's dual simplex: the packing LP as the independent check, and small dense ones. The only file that includes
// Clp.
#include <ClpEventHandler.hpp>
#include <ClpSimplex.hpp>
#include <CoinMessageHandler.hpp>
#include <CoinPackedMatrix.hpp>

#include <algorithm>
#include <cmath>

#include "lp/packing_lp.hpp"
#include "lp/small_lp.hpp"

namespace jam {
namespace {

class StopWhenInterrupted : public ClpEventHandler {
 public:
  explicit StopWhenInterrupted(const Monitor *monitor) : monitor_(monitor) {}
  int event(Event) override { return monitor_ && monitor_->interrupted() ? 0 : -1; }  // 0: end; -1: go on
  ClpEventHandler *clone() const override { return new StopWhenInterrupted(monitor_); }

 private:
  const Monitor *monitor_;
};

// Clp asserts that all numbers are below 1e100, which ends the host. Far below that its tolerances mean nothing.
bool clp_can_take(const std::vector<double> &numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::fabs(x) < 1e30; });
}

}  // namespace

// Clp's tolerances are absolute: with a finite bound the LP is scaled by it (s, g and c over the bound), so that they
// follow the size of the step. Variables: s (n * dim), then g. Rows: c + a . (s_i - s_j) - g >= 0. Clp minimises, so
// the objective is -g.
LpSolution solve_lp_clp(const PackingLp &lp, double tolerance, const Monitor *monitor) {
  const double scale = std::isfinite(lp.bound) ? lp.bound : 1.0;
  const int d = lp.dim, columns = lp.n * d + 1, rows = static_cast<int>(lp.rows());
  std::vector<int> row_of, column_of;
  std::vector<double> value;
  for (int k = 0; k < rows; ++k) {
    const int i = lp.pairs->i[k], j = lp.pairs->j[k];
    for (int c = 0; c < d && i != j; ++c) {
      const double a = lp.a[static_cast<size_t>(k) * d + c];
      row_of.insert(row_of.end(), {k, k});
      column_of.insert(column_of.end(), {i * d + c, j * d + c});
      value.insert(value.end(), {a, -a});
    }
    row_of.push_back(k), column_of.push_back(columns - 1), value.push_back(-1.0);
  }
  // Triples with the same row and column (images of one pair never share a row) do not occur.
  CoinPackedMatrix matrix(true, row_of.data(), column_of.data(), value.data(), static_cast<CoinBigIndex>(value.size()));
  std::vector<double> low(columns, -1.0), high(columns, 1.0), cost(columns, 0.0), row_low(rows),
      row_high(rows, COIN_DBL_MAX);
  if (!std::isfinite(lp.bound)) {
    std::fill(low.begin(), low.end(), -COIN_DBL_MAX);
    std::fill(high.begin(), high.end(), COIN_DBL_MAX);
  }
  low.back() = -COIN_DBL_MAX, high.back() = COIN_DBL_MAX, cost.back() = -1.0;
  for (int k = 0; k < rows; ++k) row_low[k] = -lp.c[k] / scale;
  if (!clp_can_take(row_low) || !clp_can_take(value)) {
    LpSolution none;  // no step, and not solved
    none.s.assign(static_cast<size_t>(columns - 1), 0.0);
    none.y.assign(static_cast<size_t>(rows), 0.0);
    none.w = lp.c;
    return none;
  }

  ClpSimplex model;
  CoinMessageHandler silent;
  silent.setLogLevel(0);
  model.passInMessageHandler(&silent);
  model.setLogLevel(0);
  const StopWhenInterrupted stop(monitor);
  model.passInEventHandler(&stop);
  model.loadProblem(matrix, low.data(), high.data(), cost.data(), row_low.data(), row_high.data());
  model.setPrimalTolerance(tolerance);
  model.setDualTolerance(tolerance);
  LpSolution out;
  model.dual();
  out.solved = model.status() == 0;
  out.iterations = model.numberIterations();
  const double *x = model.primalColumnSolution(), *dual = model.dualRowSolution();
  out.s.assign(x, x + columns - 1);
  out.g = x[columns - 1] * scale;
  for (double &s : out.s) s = std::min(std::max(s * scale, -lp.bound), lp.bound);
  out.y.resize(rows);
  out.w.resize(rows);
  for (int k = 0; k < rows; ++k) {
    out.y[k] = std::max(dual[k], 0.0);
    const size_t i = static_cast<size_t>(lp.pairs->i[k]) * d, j = static_cast<size_t>(lp.pairs->j[k]) * d;
    out.w[k] = lp.c[k] - out.g;
    for (int c = 0; c < d; ++c) out.w[k] += lp.a[static_cast<size_t>(k) * d + c] * (out.s[i + c] - out.s[j + c]);
  }
  // Some rows may miss the tolerance: all hold for a g less by as much.
  const double missed = out.w.empty() ? 0.0 : -std::min(0.0, *std::min_element(out.w.begin(), out.w.end()));
  out.g -= missed;
  for (double &w : out.w) w += missed;
  return out;
}

std::vector<double> solve_small_lp(const std::vector<double> &cost, const std::vector<double> &rows,
                                   const std::vector<double> &rhs) {
  const int columns = static_cast<int>(cost.size()), count = static_cast<int>(rhs.size());
  std::vector<int> start(columns + 1), length(columns, count), index(rows.size());
  std::vector<double> value(rows.size());
  for (int k = 0; k < columns; ++k) {
    start[k] = k * count;
    for (int r = 0; r < count; ++r)
      index[k * count + r] = r, value[k * count + r] = rows[static_cast<size_t>(r) * columns + k];
  }
  start[columns] = columns * count;
  if (!clp_can_take(cost) || !clp_can_take(rows) || !clp_can_take(rhs)) return {};
  const std::vector<double> low(columns, 0.0), high(columns, COIN_DBL_MAX);
  ClpSimplex model;
  CoinMessageHandler silent;
  silent.setLogLevel(0);
  model.passInMessageHandler(&silent);
  model.setLogLevel(0);
  model.loadProblem(columns, count, start.data(), index.data(), value.data(), low.data(), high.data(), cost.data(),
                    rhs.data(), rhs.data());
  model.setPrimalTolerance(1e-10);
  model.setDualTolerance(1e-10);
  model.dual();
  if (model.status() != 0) return {};
  std::vector<double> x(columns, 0.0);
  for (int k = 0; k < columns; ++k)
    if (model.getColumnStatus(k) == ClpSimplex::basic) x[k] = std::max(0.0, model.primalColumnSolution()[k]);
  return x;
}

}  // namespace jam
