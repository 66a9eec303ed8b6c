// The first LP of a crunch by the interior point with factors in floats and in doubles: processor time against the
// errors of gain and forces, for tolerances on the duality gap. The reference is the LP in doubles to 1e-15. JSON to
// stdout.
//   lp_precision FILE [runs = 3]     FILE in any format jam_read takes
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "crunch/tuning.hpp"
#include "lp/interior_point.hpp"
#include "packing_of.hpp"

using namespace jam::inside;

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Solved {
  LpSolution x;
  double seconds = 0.0;
};

// The median time of some runs.
Solved solved(const PackingLp &lp, const SinglePrecision &single, double tolerance, int runs) {
  std::vector<double> seconds;
  Solved out;
  for (int run = 0; run < runs; ++run) {
    NewtonSystem system;
    InteriorPoint solver(system, single);
    IpmControl control;
    control.tolerance = tolerance;
    const double begin = processor_seconds();
    out.x = solver.solve(lp, control);
    seconds.push_back(processor_seconds() - begin);
  }
  std::sort(seconds.begin(), seconds.end());
  out.seconds = seconds[seconds.size() / 2];
  return out;
}

// Largest error of a multiplier over the mean of those that carry.
double force_error(const PackingLp &lp, const LpSolution &x, const LpSolution &exact) {
  double worst = 0.0;
  for (size_t k = 0; k < x.y.size(); ++k) worst = std::max(worst, std::fabs(x.y[k] - exact.y[k]));
  return worst * static_cast<double>(lp.spheres());
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: lp_precision FILE [runs]\n"), 1;
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  const Packing p = packing_of(argv[1]);
  const double unit = diameter_mean(p), bound = 0.03;
  const PairList pairs = find_pairs(p, Tuning().reach_per_bound * bound * unit, 1.0);
  PackingLp lp = make_lp(p, pairs, unit);
  lp.bound = bound;
  SinglePrecision floats = Tuning().single;
  floats.work = 0.0;
  const LpSolution exact = solved(lp, SinglePrecision(), 1e-15, 1).x;
  std::printf("{\"benchmark\": \"lp_precision\", \"n\": %zu, \"rows\": %zu, \"gain\": %.17g, \"points\": [\n", p.n(),
              lp.rows(), exact.g);
  for (int digits = 7; digits <= 15; digits += 2)
    for (const bool single : {true, false}) {
      const double tolerance = std::pow(10.0, -digits);
      const Solved s = solved(lp, single ? floats : SinglePrecision(), tolerance, runs);
      std::printf(
          "  {\"precision\": \"%s\", \"tolerance\": %g, \"solved\": %s, \"seconds\": %.4g, \"iterations\": %d, "
          "\"gain_error\": %.3g, \"force_error\": %.3g}%s\n",
          single ? "single" : "double", tolerance, s.x.solved ? "true" : "false", s.seconds, s.x.iterations,
          std::fabs(s.x.g - exact.g), force_error(lp, s.x, exact), digits == 15 && !single ? "" : ",");
      std::fflush(stdout);
    }
  std::printf("]}\n");
  return 0;
}
