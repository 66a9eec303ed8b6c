// The packing LP by Clp's dual simplex. The only file that includes Clp.
#include <ClpEventHandler.hpp>
#include <ClpFactorization.hpp>
#include <ClpSimplex.hpp>
#include <CoinMessageHandler.hpp>
#include <CoinPackedMatrix.hpp>

#include <algorithm>
#include <cmath>

#include "lp/packing_lp.hpp"

namespace jam::inside {
namespace {

class StopWhenInterrupted : public ClpEventHandler {
 public:
  explicit StopWhenInterrupted(const Monitor *monitor) : monitor_(monitor) {}
  int event(Event) override { return monitor_ && monitor_->interrupted() ? 0 : -1; }  // 0: end; -1: continue
  ClpEventHandler *clone() const override { return new StopWhenInterrupted(monitor_); }

 private:
  const Monitor *monitor_;
};

// Clp asserts that all numbers are below 1e100, which ends the host.
bool clp_can_take(const std::vector<double> &numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::fabs(x) < clp_largest; });
}

// Clp's tolerances are absolute: with a finite bound the LP is scaled by it (s, g and c over the bound), so that they
// follow the size of the step, and the objective makes the mean multiplier of a carrying row one. Variables: s
// (n * dim), strain amplitudes, then g. Rows: c + a . (s_i - s_j) + b . e - g >= 0.
class PackingModel {
 public:
  PackingModel(const PackingLp &lp, double tolerance, const Monitor *monitor)
      : lp_(lp), scale_(std::isfinite(lp.bound) ? lp.bound : 1.0), stop_(monitor) {
    const int d = lp.dim, strains = lp.strains, spheres = lp.n * d, columns = spheres + strains + 1,
              rows = static_cast<int>(lp.rows());
    std::vector<int> row_of, column_of;
    std::vector<double> value;
    for (int k = 0; k < rows; ++k) {
      const int i = lp.pairs->i[k], j = lp.pairs->j[k];
      for (int c = 0; c < d && i != j; ++c) {
        const double a = lp.a[static_cast<size_t>(k) * d + c];
        row_of.push_back(k), column_of.push_back(i * d + c), value.push_back(a);
        if (j >= 0) row_of.push_back(k), column_of.push_back(j * d + c), value.push_back(-a);
      }
      for (int q = 0; q < strains; ++q)
        row_of.push_back(k), column_of.push_back(spheres + q),
            value.push_back(lp.strain[static_cast<size_t>(k) * strains + q]);
      row_of.push_back(k), column_of.push_back(columns - 1), value.push_back(-1.0);
    }
    // Triples with the same row and column (images of one pair never share a row) do not occur.
    const CoinPackedMatrix matrix(true, row_of.data(), column_of.data(), value.data(),
                                  static_cast<CoinBigIndex>(value.size()));
    const double most = std::isfinite(lp.bound) ? 1.0 : COIN_DBL_MAX;
    std::vector<double> low(columns, -most), high(columns, most), cost(columns, 0.0), row_low(rows),
        row_high(rows, COIN_DBL_MAX);
    low.back() = -COIN_DBL_MAX, high.back() = COIN_DBL_MAX;
    for (int k = 0; k < rows; ++k) row_low[k] = -lp.c[k] / scale_;
    usable = rows > 0 && clp_can_take(row_low) && clp_can_take(value);  // without rows nothing bounds g
    if (!usable) return;
    silent_.setLogLevel(0);
    model.passInMessageHandler(&silent_);
    model.setLogLevel(0);
    model.passInEventHandler(&stop_);
    model.loadProblem(matrix, low.data(), high.data(), cost.data(), row_low.data(), row_high.data());
    model.setPrimalTolerance(tolerance);
    model.setDualTolerance(tolerance);
    model.setMaximumIterations(clp_pivots_a_row * rows);
    // No dense part: Clp would factorise it by the LAPACK that it is linked with, whose bits depend on the processor.
    model.factorization()->setDenseThreshold(0);
  }
  // Displacements and g, with the slack of every row; where some rows miss the tolerance, all hold for a g less by as
  // much.
  // warm: from a basis near the optimum, where the primal simplex copes better with many rows that are closed at the
  // same time.
  LpSolution solve(bool warm) {
    LpSolution out;
    if (warm)
      model.primal();
    else
      model.dual();
    out.solved = model.status() == 0;
    out.iterations = model.numberIterations();
    const int columns = model.numberColumns(), strains = lp_.strains;
    const double *x = model.primalColumnSolution();
    out.s.assign(x, x + columns - 1 - strains), out.strain.assign(x + columns - 1 - strains, x + columns - 1);
    out.g = x[columns - 1] * scale_;
    for (auto *v : {&out.s, &out.strain})
      for (double &s : *v) s = std::min(std::max(s * scale_, -lp_.bound), lp_.bound);
    out.w.resize(lp_.rows());
    double missed = 0.0;
    for (size_t k = 0; k < out.w.size(); ++k) {
      out.w[k] = lp_.c[k] - out.g + lp_.change(k, out.s.data(), out.strain.data());
      missed = std::max(missed, -out.w[k]);
    }
    out.g -= missed;
    for (double &w : out.w) w += missed;
    return out;
  }

  // No step, and not solved.
  LpSolution none() const {
    LpSolution out;
    out.s.assign(static_cast<size_t>(lp_.n) * lp_.dim, 0.0);
    out.y.assign(lp_.rows(), 0.0);
    out.w = lp_.c;
    return out;
  }

  ClpSimplex model;
  bool usable = false;

 private:
  const PackingLp &lp_;
  const double scale_;
  CoinMessageHandler silent_;
  StopWhenInterrupted stop_;
};

}  // namespace

bool clp_is_built() { return true; }

LpSolution solve_lp_clp(const PackingLp &lp, double tolerance, const Monitor *monitor, const LpSolution *start) {
  PackingModel packing(lp, tolerance, monitor);
  if (!packing.usable) return packing.none();
  ClpSimplex &model = packing.model;
  const int columns = model.numberColumns(), rows = model.numberRows();
  const double carrying = static_cast<double>(columns);
  model.setObjectiveCoefficient(columns - 1, -carrying);
  if (start && !start->basis_columns.empty()) {
    const auto status = [](double v) { return static_cast<ClpSimplex::Status>(static_cast<int>(v) - 1); };
    model.createStatus();
    for (int k = 0; k < rows; ++k)
      model.setRowStatus(k, start->basis_rows[k] > 0.0 ? status(start->basis_rows[k]) : ClpSimplex::basic);
    for (int k = 0; k < columns; ++k) model.setColumnStatus(k, status(start->basis_columns[k]));
  }
  LpSolution out = packing.solve(start && !start->basis_columns.empty());
  const double *dual = model.dualRowSolution();
  for (int k = 0; k < rows; ++k) out.y.push_back(std::max(dual[k] / carrying, 0.0));
  for (int k = 0; k < rows; ++k) out.basis_rows.push_back(1.0 + model.getRowStatus(k));
  for (int k = 0; k < columns; ++k) out.basis_columns.push_back(1.0 + model.getColumnStatus(k));
  return out;
}

}  // namespace jam::inside
