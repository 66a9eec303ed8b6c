// One LP of the crunch by four solvers: our interior point, and Clp's dual simplex, primal simplex and barrier. JSON to
// stdout, a row a solver: processor seconds, distance of the gain from our solver's, and residuals by check_lp.
//   clp_race FILE [runs] [limit]     FILE in any format jam_read takes; limit: seconds for each of Clp's, default 300
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include <coin/ClpSimplex.hpp>
#include <coin/CoinPackedMatrix.hpp>

#include "lp/interior_point.hpp"
#include "packing_of.hpp"

using namespace jam::inside;

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The LP as lp/clp_backend.cpp scales it: lengths and gain over the bound.
void load(const PackingLp &lp, ClpSimplex &model) {
  const int d = lp.dim, spheres = lp.n * d, columns = spheres + 1, rows = static_cast<int>(lp.rows());
  std::vector<int> row_of, column_of;
  std::vector<double> value, low(columns, -1.0), high(columns, 1.0), cost(columns, 0.0), row_low(rows),
      row_high(rows, COIN_DBL_MAX);
  for (int k = 0; k < rows; ++k) {
    for (int c = 0; c < d; ++c) {
      const double a = lp.a[static_cast<size_t>(k) * d + c];
      row_of.insert(row_of.end(), {k, k});
      column_of.insert(column_of.end(), {lp.pairs->i[k] * d + c, lp.pairs->j[k] * d + c});
      value.insert(value.end(), {a, -a});
    }
    row_of.push_back(k), column_of.push_back(spheres), value.push_back(-1.0);
    row_low[k] = -lp.c[k] / lp.bound;
  }
  low[spheres] = -COIN_DBL_MAX, high[spheres] = COIN_DBL_MAX;
  cost[spheres] = -static_cast<double>(spheres);
  const CoinPackedMatrix matrix(true, row_of.data(), column_of.data(), value.data(),
                                static_cast<CoinBigIndex>(value.size()));
  model.loadProblem(matrix, low.data(), high.data(), cost.data(), row_low.data(), row_high.data());
}

LpSolution answer_of(const PackingLp &lp, const ClpSimplex &model) {
  LpSolution out;
  const double *x = model.primalColumnSolution(), *y = model.dualRowSolution();
  const size_t spheres = lp.spheres();
  out.s.resize(spheres);
  for (size_t k = 0; k < spheres; ++k) out.s[k] = x[k] * lp.bound;
  out.g = x[spheres] * lp.bound;
  for (size_t k = 0; k < lp.rows(); ++k) {
    out.y.push_back(std::fabs(y[k]) / static_cast<double>(spheres));
    out.w.push_back(lp.c[k] + lp.change(k, out.s.data(), nullptr) - out.g);
  }
  out.solved = model.isProvenOptimal();
  return out;
}

enum class Way { dual, primal, barrier };

LpSolution by_clp(const PackingLp &lp, Way way, double limit) {
  ClpSimplex model;
  model.setLogLevel(0);
  load(lp, model);
  model.setMaximumSeconds(limit);
  model.setPrimalTolerance(1e-9), model.setDualTolerance(1e-9);
  if (way == Way::dual) model.initialDualSolve();
  if (way == Way::primal) model.initialPrimalSolve();
  if (way == Way::barrier) model.initialBarrierNoCrossSolve();
  return answer_of(lp, model);
}

void row(const char *solver, const PackingLp &lp, const LpSolution &x, double seconds, double ours, double gain) {
  const LpCheck c = check_lp(lp, x);
  std::printf(
      "%s\n  {\"solver\": \"%s\", \"solved\": %d, \"seconds\": %.4g, \"ratio\": %.4g, \"gain_error\": %.2g, "
      "\"infeasibility\": %.2g, \"duality_gap\": %.2g, \"force_residual\": %.2g}",
      ours == seconds ? "" : ",", solver, x.solved, seconds, seconds / ours, std::fabs(x.g - gain), c.infeasibility,
      std::fabs(c.gap), c.balance);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: clp_race FILE [runs] [limit]\n"), 2;
  const Packing p = packing_of(argv[1]);
  const int runs = argc > 2 ? std::atoi(argv[2]) : 5;
  const double limit = argc > 3 ? std::atof(argv[3]) : 300.0;
  const double unit = diameter_mean(p);
  const PairList pairs = find_pairs(p, 0.22 * unit, 1.0);
  PackingLp lp = make_lp(p, pairs, unit);
  lp.bound = 0.1;
  std::vector<double> seconds;
  LpSolution ours;
  for (int k = 0; k < runs; ++k) {
    const double began = processor_seconds();
    NewtonSystem system;
    ours = InteriorPoint(system).solve(lp, IpmControl());
    seconds.push_back(processor_seconds() - began);
  }
  std::nth_element(seconds.begin(), seconds.begin() + runs / 2, seconds.end());
  const double mine = seconds[runs / 2];
  std::printf("{\"spheres\": %zu, \"rows\": %zu, \"solvers\": [", p.n(), lp.rows());
  row("interior point", lp, ours, mine, mine, ours.g);
  const std::pair<const char *, Way> ways[] = {
      {"Clp barrier", Way::barrier}, {"Clp dual simplex", Way::dual}, {"Clp primal simplex", Way::primal}};
  for (const auto &[name, way] : ways) {
    const double began = processor_seconds();
    const LpSolution x = by_clp(lp, way, limit);
    row(name, lp, x, processor_seconds() - began, mine, ours.g);
  }
  std::printf("]}\n");
}
