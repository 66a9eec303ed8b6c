// Phase 1: sequential LPs. Each LP maximises Gamma over displacements within a bound; the spheres move, the pairs are
// listed anew (Artiaco et al., Phys. Rev. E 106, 055310 (2022)).
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "crunch/state.hpp"
#include "lp/interior_point.hpp"

namespace jam {
namespace {

double gain_of(const LpSolution &x) { return std::sqrt(1.0 + std::max(x.g, 0.0)) - 1.0; }

// What an answer must fulfil to be used. One that ended early leans on bounds that it has not reached: any feasible
// point is a safe step, if it gains no less than staying does.
bool acceptable(const CrunchState &s, const LpSolution &x, bool early, LpCheck &check) {
  check = check_lp(s.lp, x);
  const double balance = early ? std::numeric_limits<double>::infinity() : 1e-3;  // polish balances forces to rounding
  constexpr double rounding = 1e-9;
  return x.solved && check.infeasibility < rounding && check.gamma < 1e-6 && check.balance < balance && x.g > -rounding;
}

// One solver's answer. True when it is kept (`solved`), or when the call was interrupted.
bool ask(CrunchState &s, jam_lp_solver solver, const IpmControl &control, bool &solved) {
  s.answer = solver == JAM_LP_IPM ? s.interior_point.solve(s.lp, control, &s.monitor)
                                  : solve_lp_clp(s.lp, clp_tolerance, &s.monitor);
  if (s.hooks.answer) s.hooks.answer(s.answer, solver);
  LpCheck check;
  const bool good = acceptable(s, s.answer, control.early_fraction > 0.0, check);
  if (good && !s.monitor.cancelled()) {
    s.out.report.lp_solver = solver;
    s.out.report.gamma_residual = check.gamma;
    s.out.report.duality_gap = std::fabs(check.gap);
    ++s.out.report.lp_solves;
    s.early = control.early_fraction > 0.0 && std::fabs(check.gap) > 0.1 * s.gain_tolerance;
    return solved = true;
  }
  if (s.monitor.interrupted()) return true;
  s.monitor.log(JAM_LOG_WARNING, "%s: infeasibility %.1e balance %.1e |sum y - 1| %.1e",
                solver == JAM_LP_IPM ? "interior point" : "Clp", check.infeasibility, check.balance, check.gamma);
  return false;
}

// The interior point, warm where the forces hardly changed; then a cold one with small steps; then Clp. False when the
// call was interrupted.
bool solve(CrunchState &s) {
  bool solved = false;
  IpmControl control;
  control.tolerance = s.o.lp_tolerance;
  control.early_fraction = s.o.full_lps ? 0.0 : s.tuning.early_gap;
  control.threads = s.o.threads;
  if (s.o.lp_solver == JAM_LP_IPM) {
    std::vector<double> forces;
    if (s.moved <= s.tuning.warm_step && s.at_bound == 0) {
      forces = carry_over(s.multipliers.pairs, s.multipliers.y, s.pairs);
      control.multipliers = &forces;
    }
    if (ask(s, JAM_LP_IPM, control, solved)) return solved;
    control.multipliers = nullptr;
    control.correctors = 0;
    control.early_fraction = 0;
    control.max_iterations = 200;
    if (ask(s, JAM_LP_IPM, control, solved)) return solved;
    s.monitor.log(JAM_LOG_WARNING, "the interior point failed twice; Clp takes over");
  }
  control.early_fraction = 0;
  if (!ask(s, JAM_LP_CLP, control, solved))
    fail(JAM_E_SOLVER, "no LP solver gave an answer that checks out; the log has the residuals");
  return solved;
}

void add_history_row(CrunchState &s, double alpha, double unit) {
  std::vector<double> moved = s.answer.s;
  for (double &x : moved) x *= alpha * unit;
  HistoryRow &row =
      s.history.moved(s.out.packing, JAM_STEP_LP, s.monitor.seconds(), s.system.factorisations, moved.data());
  row[JAM_HISTORY_GAIN] = math::expm1(0.5 * math::log1p(alpha * s.answer.g));
  row[JAM_HISTORY_CONTACTS] = static_cast<double>(s.active.rows.size());
  row[JAM_HISTORY_EXCESS] = static_cast<double>(excess_of(s.active, s.lp.dim));
  row[JAM_HISTORY_RATTLERS] = static_cast<double>(s.lp.n - s.active.stable);
  row[JAM_HISTORY_ITERATIONS] = s.answer.iterations;
  row[JAM_HISTORY_DUALITY_GAP] = s.out.report.duality_gap;
  row[JAM_HISTORY_PAIRS] = static_cast<double>(s.pairs.size());
  row[JAM_HISTORY_HELD] = static_cast<double>(s.at_bound);
  row[JAM_HISTORY_PART] = alpha;
  row[JAM_HISTORY_BOUND] = s.lp.bound;
  s.history.over_stable(s.active.coordination, s.lp.dim, diameter_mean(s.out.packing));
}

// What follows an LP with this gain and longest step, of which the part alpha was made.
Phase next_phase(CrunchState &s, double gain, double step, double alpha) {
  const bool gained = gain > s.gain_tolerance || s.early;
  // Contacts that close and forces that balance end a crunch; the bare LP must also move nothing.
  if (!gained && (s.o.polish || step <= s.o.step_tolerance)) return Phase::identify;
  if (!gained) ++s.stalled;
  const bool limit = s.out.report.lp_solves >= s.o.max_lps;
  if (alpha == 0.0 || (s.stalled > 0 && s.stalled >= s.tuning.max_stalled_lps))
    return s.stop(JAM_STOP_STALLED, JAM_NOT_CONVERGED), Phase::identify;
  if (limit) return s.stop(JAM_STOP_LP_LIMIT, JAM_LIMIT), Phase::identify;
  if (s.interrupted()) return Phase::identify;
  if (s.o.step_bound == 0.0) {
    const double most = alpha < 1.0 ? 0.7 * s.bound : s.tuning.max_bound;
    s.bound = std::min(std::max({s.tuning.bound_per_step * step, gain, s.tuning.min_bound}), most);
  }
  return path_is_shorter(s, gain, step) ? Phase::barrier_path : Phase::approach;
}

}  // namespace

double build_lp(CrunchState &s, double reach) {
  s.active = ActiveSet();  // it belongs to the list that is replaced: an interrupted LP leaves no contacts
  if (s.strain.count() > 0) shorten_cell(s.out.packing);
  PairList pairs = find_pairs(s.out.packing, reach, 1.0);
  // A few spheres, or very unequal ones, may be farther apart than their bound lets them move. Something must bound
  // their growth: the nearest pair, at last a sphere and its own image.
  for (; pairs.size() == 0 && s.o.neighbour_radius == 0.0; reach *= 2.0)
    pairs = find_pairs(s.out.packing, 2.0 * reach, 1.0);
  if (pairs.size() == 0) fail(JAM_E_ARGUMENT, "no pair within the neighbour radius %g", s.o.neighbour_radius);
  s.pairs = std::move(pairs);
  s.lp = make_lp(s.out.packing, s.pairs, diameter_mean(s.out.packing), s.strain);
  s.lp.bound = s.bound;
  return reach;
}

double first_bound(const Packing &p, const jam_crunch_options &o, const Tuning &t) {
  if (o.step_bound > 0.0) return o.step_bound;
  const double spacing = t.first_bound + t.bound_per_spacing * free_spacing(p);
  const double closed = t.bound_per_root_gap * std::sqrt(contact_gap(p));
  return std::min(spacing, std::max(t.min_bound, closed));
}

double lp_reach(const Packing &p, const jam_crunch_options &o, const Tuning &t, double bound) {
  const double unit = diameter_mean(p);
  if (o.neighbour_radius > 0.0) return std::max(0.0, o.neighbour_radius * unit - contact_distance_max(p));
  return t.reach_per_bound * bound * unit;
}

LpStep make_step(CrunchState &s, double reach) {
  const double unit = diameter_mean(s.out.packing);
  // What a simplex solver leaves of a closed row, and rounding.
  s.active = find_active_set(s.lp, s.answer, std::max(2.0 * clp_tolerance * s.bound, s.tuning.closed_gap));
  s.at_bound =
      std::count_if(s.answer.s.begin(), s.answer.s.end(), [&](double x) { return std::fabs(x) > 0.999 * s.lp.bound; });
  if (s.history.details()) s.history.take_network(s.out.packing, s.lp, s.answer);
  const double alpha = take_step(s.out.packing, s.pairs, reach, s.answer, unit, s.strain);
  const double gain = gain_of(s.answer), step = largest_step(s.answer, s.active, s.lp.dim);
  s.monitor.log(
      JAM_LOG_INFO,
      "LP %lld: gain %.3e step %.3e alpha %.3f pairs %zu iterations %d contacts %zu stable %lld bound %.3g phi %.12f",
      static_cast<long long>(s.out.report.lp_solves), gain, step, alpha, s.pairs.size(), s.answer.iterations,
      s.active.rows.size(), static_cast<long long>(s.active.stable), s.lp.bound, packing_fraction(s.out.packing));
  add_history_row(s, alpha, unit);
  return {gain, step, alpha};
}

Phase approach(CrunchState &s) {
  const double reach = build_lp(s, lp_reach(s.out.packing, s.o, s.tuning, s.bound));
  if (!solve(s)) return s.interrupted(), Phase::done;
  s.multipliers = {s.pairs, s.answer.y};
  const LpStep step = make_step(s, reach);
  s.out.report.gain = step.gain;
  s.out.report.max_step = s.moved = step.longest;
  if (s.show(JAM_PHASE_CRUNCH, step.gain, step.longest))
    return s.stop(JAM_STOP_CANCELLED, JAM_CANCELLED), Phase::identify;
  return next_phase(s, step.gain, step.longest, step.part);
}

}  // namespace jam
