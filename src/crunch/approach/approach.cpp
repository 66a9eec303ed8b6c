#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "crunch/phases.hpp"
#include "linalg/dot.hpp"
#include "lp/interior_point.hpp"
#include "network/rattlers.hpp"

namespace jam::inside {
namespace {

// The answer in s.last, if it can be used. An LP that ended early has no balanced duals yet. Its point is still
// feasible, so the step is safe if it gains no less than staying does.
LpAnswer try_solver(CrunchState &s, jam_lp_solver solver, const IpmControl &control) {
  s.last.answer = solver == JAM_LP_IPM ? s.interior_point.solve(s.last.lp, control, &s.monitor)
                                       : solve_lp_clp(s.last.lp, lp_rounding, &s.monitor);
  if (s.hooks.answer) s.hooks.answer(s.last.answer, solver);
  const LpSolution &x = s.last.answer;
  const LpCheck check = check_lp(s.last.lp, x);
  const bool early = control.early_fraction > 0.0,
             good = x.solved && check.infeasibility < lp_rounding && check.gamma < Tuning::lp_unit_sum &&
                    check.balance < (early ? HUGE_VAL : InteriorPointTuning::rough_balance) && x.g > -lp_rounding;
  if (good && !s.monitor.cancelled()) {
    s.out.report.lp_solver = solver;
    s.out.report.gamma_residual = check.gamma;
    s.out.report.duality_gap = std::fabs(check.gap);
    ++s.out.report.lp_solves;
    s.last.early = early && std::fabs(check.gap) > std::max(s.next.gain_tolerance, control.tolerance);
    return LpAnswer::kept;
  }
  if (s.monitor.interrupted()) return LpAnswer::interrupted;
  s.monitor.log(JAM_LOG_WARNING, "%s: infeasibility %.1e balance %.1e |sum y - 1| %.1e",
                solver == JAM_LP_IPM ? "interior point" : "Clp", check.infeasibility, check.balance, check.gamma);
  return LpAnswer::refused;
}

// LPs alone finish a nearly jammed packing. One path at most: a second one after saddles gains nothing.
bool path_is_shorter(const CrunchState &s, double gain, double step) {
  const Tuning &t = s.tuning;
  if (s.o.method != JAM_CRUNCH_BARRIER_PATH || s.history.stage.path_taken) return false;
  const double isostatic = s.last.lp.dim * static_cast<double>(s.last.lp.n);
  if (gain < t.close_gap && hyperstatic(s.last.answer.y, isostatic, t)) return false;
  return step > t.min_bound || (step * step > contact_gap_limit && t.opening * step * step > gain);
}

// What follows an LP with this gain and longest step, of which the part alpha was made.
Phase next_phase(CrunchState &s, double gain, double step, double alpha) {
  const bool gained = gain > s.next.gain_tolerance || s.last.early;
  // Contacts that close and forces that balance end a crunch; the bare LP must also move nothing.
  if (!gained && (s.o.polish || step <= s.o.step_tolerance)) return Phase::identify;
  if (!gained) ++s.next.stalled;
  if (alpha == 0.0 || (s.next.stalled > 0 && s.next.stalled >= s.tuning.max_narrow_lps))
    return stop(s, JAM_STOP_STALLED, JAM_NOT_CONVERGED), Phase::identify;
  if (stop_at_lp_limit(s) || stop_if_interrupted(s)) return Phase::identify;
  if (s.o.step_bound == 0.0) {
    const double most = alpha < 1.0 ? s.tuning.shrink * s.next.bound : s.tuning.max_bound;
    s.next.bound = std::min(std::max({s.tuning.bound_per_step * step, gain, s.tuning.min_bound}), most);
  }
  return path_is_shorter(s, gain, step) ? Phase::barrier_path : Phase::approach;
}

}  // namespace

LpAnswer solve_lp(CrunchState &s, IpmControl control) {
  control.threads = s.o.threads;
  LpAnswer answer = LpAnswer::refused;
  if (s.o.lp_solver == JAM_LP_IPM) {
    std::vector<double> forces;
    if (s.next.moved <= s.tuning.warm_step && s.last.at_bound == 0) {
      forces = carry_over(s.next.multipliers.pairs, s.next.multipliers.y, s.last.pairs);
      control.multipliers = &forces;
    }
    answer = try_solver(s, JAM_LP_IPM, control);
    if (answer == LpAnswer::refused) {
      control.multipliers = nullptr;
      control.correctors = 0;
      control.early_fraction = 0.0;
      answer = try_solver(s, JAM_LP_IPM, control);
    }
    if (answer == LpAnswer::refused) s.monitor.log(JAM_LOG_WARNING, "the interior point failed twice; Clp takes over");
  }
  control.early_fraction = 0.0;
  if (answer == LpAnswer::refused) answer = try_solver(s, JAM_LP_CLP, control);
  if (answer == LpAnswer::kept) s.next.multipliers = {s.last.pairs, s.last.answer.y};
  return answer;
}

Phase approach(CrunchState &s) {
  if (stop_at_lp_limit(s)) return Phase::identify;
  const double reach = build_lp(s, lp_reach(s.out.packing, s.o, s.tuning, s.next.bound));
  IpmControl control;
  control.tolerance = s.o.lp_tolerance;
  control.early_fraction = s.o.full_lps ? 0.0 : s.tuning.early_gap;
  const LpAnswer answer = solve_lp(s, control);
  if (answer == LpAnswer::refused)
    fail(JAM_E_SOLVER, "no LP solver gave an answer that checks out; the log has the residuals");
  if (answer == LpAnswer::interrupted) return stop_if_interrupted(s), Phase::done;
  const LpStep step = make_step(s, reach);
  if (s.first_gain == 0.0) s.first_gain = step.gain;
  s.out.report.gain = step.gain;
  s.out.report.max_step = s.next.moved = step.longest;
  if (report_step(s, JAM_PHASE_CRUNCH, step.gain, step.longest))
    return stop(s, JAM_STOP_CANCELLED, JAM_CANCELLED), Phase::identify;
  return next_phase(s, step.gain, step.longest, step.part);
}

bool frees_cell(const CrunchState &s) {
  return s.o.strain != JAM_STRAIN_NONE && s.next.strain.count() == 0 && s.out.report.stop_reason == JAM_STOP_NONE;
}

Phase free_cell(CrunchState &s) {
  const bool edges = (s.o.strain & JAM_STRAIN_EDGES) != 0, tilts = (s.o.strain & JAM_STRAIN_TILTS) != 0;
  s.next.strain = strain_basis(s.out.packing.dim, edges, tilts, ~s.out.packing.container.closed());
  s.monitor.log(JAM_LOG_INFO, "fixed cell: phi %.12f; %d strains join", packing_fraction(s.out.packing),
                s.next.strain.count());
  restart_lps(s, s.tuning.first_bound);
  s.history.stage.path_taken = false;
  s.history.stage.cell_free = true;
  return Phase::approach;
}

// At a strictly complementary optimum a row has either force or slack. Both are compared in their own units: y times
// d n, about the number of carrying rows, is a force over the mean force; w is twice a relative gap. A solver that
// ends at a vertex may leave a closed row without force: no slack counts as well.
std::vector<char> force_carrying(const PackingLp &lp, const LpSolution &x, double closed) {
  std::vector<char> on(lp.rows());
  const double carrying = static_cast<double>(lp.dim) * static_cast<double>(lp.n);
  for (size_t k = 0; k < on.size(); ++k) on[k] = x.y[k] * carrying > x.w[k] || x.w[k] < closed;
  return on;
}

ActiveSet find_active_set(const PackingLp &lp, const LpSolution &x, double closed) {
  const PairList &pairs = *lp.pairs;
  std::vector<char> on = force_carrying(lp, x, closed);
  std::vector<double> normal(lp.a);
  for (size_t k = 0; k < on.size(); ++k) {
    on[k] = on[k] && (lp.strains > 0 || !pairs.own_image(k));
    const double a2 = squared(&normal[k * lp.dim], lp.dim);
    for (int c = 0; c < lp.dim && a2 > 0.0; ++c) normal[k * lp.dim + c] /= std::sqrt(a2);
  }
  drop_unbalanced(lp.dim, static_cast<size_t>(lp.n), pairs.i, pairs.j, normal, on);
  ActiveSet active;
  active.coordination.assign(lp.n, 0);
  for (size_t k = 0; k < on.size(); ++k)
    if (on[k]) {
      active.rows.push_back(k);
      for_spheres(pairs.i[k], pairs.j[k], [&](int32_t i) { ++active.coordination[i]; });
    }
  active.stable = stable_spheres(active.coordination);
  return active;
}

double largest_step(const LpSolution &x, const ActiveSet &active, int dim, uint32_t closed_axes) {
  return active.stable > 0 ? spread(x.s, dim, 1.0, &active.coordination, closed_axes).largest
                           : spread(x.s, dim, 1.0, nullptr, ~0u).largest;
}

ContactNetwork make_contacts(const Packing &p, const PairList &pairs, const LpSolution &x, const ActiveSet &active) {
  ContactNetwork out;
  out.coordination = active.coordination;
  double sum = 0.0;
  for (const size_t k : active.rows) {
    const double length = add_contact(p, pairs, k, out), sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
    out.force.push_back(x.y[k] / (sigma * sigma) * length);
    sum += out.force.back();
  }
  out.force_scale = out.size() ? sum / static_cast<double>(out.size()) : 0.0;
  for (double &f : out.force) f /= out.force_scale;
  return out;
}

bool hyperstatic(const std::vector<double> &y, double isostatic, const Tuning &t) {
  const auto strong = std::count_if(y.begin(), y.end(), [&](double v) { return v * isostatic > t.crystal_force; });
  return static_cast<double>(strong) > WorkingSetTuning::carrying_rows * isostatic;
}

}  // namespace jam::inside
