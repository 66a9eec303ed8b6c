// Crunch of one packing by every method and solver at several tolerances: time against accuracy. JSON to stdout.
//   crunch_race FILE [runs] [clp]       FILE in any format jam_read takes; `clp` adds the first LP by Clp's dual
//   simplex
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "core/monitor.hpp"
#include "crunch/crunch.hpp"
#include "jam/jam.h"
#include "lp/interior_point.hpp"
#include "packing_of.hpp"

using namespace jam::inside;

namespace {

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

CrunchResult once(const Packing &p, const jam_crunch_options &o) {
  Monitor monitor;
  monitor.begin();
  return crunch(p, o, monitor);
}

bool first = true;
void row(const char *method, const Packing &p, jam_crunch_options o, int runs, double reference) {
  std::vector<double> seconds;
  CrunchResult r;
  for (int k = 0; k < runs; ++k) {
    r = once(p, o);
    seconds.push_back(r.report.seconds);
  }
  std::printf(
      "%s\n    {\"method\": \"%s\", \"gain_tolerance\": %g, \"polish\": %d, \"seconds\": %.6g, \"seconds_factor\": "
      "%.6g, \"phi\": %.15f, "
      "\"phi_error\": %.3g, \"force_residual\": %.3g, \"max_overlap\": %.3g, \"excess\": %lld, \"lps\": %lld, "
      "\"factorisations\": %lld, \"jammed\": %d}",
      first ? "" : ",", method, o.gain_tolerance, o.polish, median(seconds), r.report.seconds_factor,
      r.report.packing_fraction, std::fabs(r.report.packing_fraction - reference), r.report.force_residual,
      r.report.max_overlap, static_cast<long long>(r.report.excess_contacts),
      static_cast<long long>(r.report.lp_solves), static_cast<long long>(r.report.factorisations), r.report.jammed);
  std::fflush(stdout);
  first = false;
}

// One LP, solved to full accuracy by both solvers: with libjam's first reach and bound, and with those of
// CALiPPSO's first stage (pairs nearer than 4 R, |s_ik| < (2 R - 1.5 R) / sqrt(d)).
void first_lp(const Packing &p, int runs, const char *name, double reach, double bound) {
  const double unit = diameter_mean(p);
  const PairList pairs = find_pairs(p, reach * unit, 1.0);
  PackingLp lp = make_lp(p, pairs, unit);
  lp.bound = bound;
  std::vector<double> ours;
  LpSolution a;
  for (int k = 0; k < runs; ++k) {
    const double t0 = now_seconds();
    NewtonSystem system;
    a = InteriorPoint(system).solve(lp, IpmControl());
    ours.push_back(now_seconds() - t0);
  }
  Monitor patient;
  patient.begin(), patient.wall_time = 900.0;
  const double t1 = now_seconds();
  const LpSolution b = solve_lp_clp(lp, 1e-9, &patient);
  const double clp = now_seconds() - t1;
  const LpCheck ca = check_lp(lp, a), cb = check_lp(lp, b);
  std::printf(
      ",\n  \"first_lp_%s\": {\"rows\": %zu, \"ipm_seconds\": %.6g, \"clp_seconds\": %.6g, \"ratio\": %.4g, "
      "\"ipm_iterations\": %d, \"g_difference\": %.3g, "
      "\"ipm_gap\": %.3g, \"clp_gap\": %.3g, \"ipm_balance\": %.3g, \"clp_balance\": %.3g}",
      name, lp.rows(), median(ours), clp, clp / median(ours), a.iterations, std::fabs(a.g - b.g), ca.gap, cb.gap,
      ca.balance, cb.balance);
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: crunch_race FILE [runs] [clp]\n"), 2;
  const Packing p = packing_of(argv[1]);
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  jam_crunch_options o = default_crunch_options();
  const double reference = once(p, o).report.packing_fraction;
  std::printf("{\"n\": %zu, \"dim\": %d, \"reference_phi\": %.15f, \"rows\": [", p.n(), p.dim, reference);
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-12}) {
    o.gain_tolerance = tolerance;
    o.step_tolerance = std::max(1e-9, tolerance * 1e3);
    for (int polish = 0; polish < 2; ++polish) {
      o.polish = polish;
      o.method = JAM_CRUNCH_BARRIER_PATH;
      row("barrier_path", p, o, runs, reference);
      o.method = JAM_CRUNCH_SEQUENTIAL_LP;
      row("sequential_lp", p, o, runs, reference);
    }
  }
  if (argc > 3 && !std::strcmp(argv[3], "clp")) {
    o = default_crunch_options();
    o.lp_solver = JAM_LP_CLP;
    o.gain_tolerance = 1e-9, o.step_tolerance = 1e-6, o.polish = 0;
    row("barrier_path, last LPs by Clp", p, o, 1, reference);
  }
  std::printf("\n  ]");
  if (argc > 3 && !std::strcmp(argv[3], "clp")) {
    first_lp(p, runs, "libjam", 0.22, 0.1);
    first_lp(p, runs, "calippso", 1.0, 0.25 / std::sqrt(static_cast<double>(p.dim)));
  }
  std::printf("\n}\n");
}
