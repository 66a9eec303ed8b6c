// The chain of LPs: neighbour radius and step bound, solve, check, step, until nothing moves.
#include "crunch/sequential_lp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "core/error.hpp"

namespace jam {
namespace {

// Median gap of the d n nearest pairs below which a start may be jammed already.
constexpr double already_closed = 1e-11;

double gain_of(const LpSolution &x) { return std::sqrt(1.0 + std::max(x.g, 0.0)) - 1.0; }

}  // namespace

SequentialLp::SequentialLp(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History &history,
                           const CrunchSeams &seams)
    : o_(o), monitor_(monitor), history_(history), seams_(seams), ipm_(system_) {
  out_.packing = start;
  out_.contacts.coordination.assign(start.n(), 0);
  out_.report.struct_size = sizeof out_.report;
  history_.begin(start, o.steps != 0);
}

CrunchResult SequentialLp::run() {
  try {
    if (contact_gap(out_.packing) <
        already_closed) {  // one LP in full, as narrow as the last one of a run, tells whether it is jammed
      bound_ = narrowest, last_gain_ = 0.0;
      one_lp();
    }
    bound_ = first_bound(), last_gain_ = 1.0;
    do {
      while (out_.report.stop_reason == JAM_STOP_NONE) {
        one_lp();
        if (out_.report.stop_reason == JAM_STOP_NONE && closes()) break;
        if (out_.report.stop_reason == JAM_STOP_NONE && in_valley(out_.report.gain, out_.report.max_step))
          follow_path();
      }
    } while (wants_another_lp());
    finish();
  } catch (const Error &e) {
    stop(JAM_STOP_SOLVER, e.code());
    out_.text = e.what();
    finish_failed();
  } catch (const std::bad_alloc &) {
    stop(JAM_STOP_SOLVER, JAM_E_MEMORY);
    finish_failed();
  }
  return std::move(out_);
}

bool SequentialLp::cut_off() {
  if (monitor_.cancelled()) return stop(JAM_STOP_CANCELLED, JAM_CANCELLED), true;
  if (monitor_.interrupted()) return stop(JAM_STOP_WALL_TIME, JAM_LIMIT), true;
  return false;
}

bool SequentialLp::show(jam_phase phase, double gain, double step, bool finished) {
  jam_progress progress{};
  progress.phase = phase;
  progress.packing_fraction = packing_fraction(out_.packing);
  progress.pressure = progress.fraction = std::numeric_limits<double>::quiet_NaN();
  progress.gain = gain;
  progress.max_step = step;
  progress.steps = out_.report.lp_solves;
  progress.factorisations = system_.factorisations;
  history_.step().shown = finished && history_.details();
  const bool stop = monitor_.report(progress, true);
  history_.step().shown = false;
  return stop;
}

void SequentialLp::build_lp() {
  Packing &p = out_.packing;
  unit_ = diameter_mean(p);
  reach_ = 2.2 * bound_ * unit_;
  if (o_.neighbour_radius > 0.0) reach_ = std::max(0.0, o_.neighbour_radius * unit_ - diameter_max(p));
  PairList pairs = find_pairs(p, reach_, 1.0);
  if (pairs.size() == 0) fail(JAM_E_ARGUMENT, "no pair within the neighbour radius %g", o_.neighbour_radius);
  pairs_ = std::move(pairs);
  lp_ = make_lp(p, pairs_, unit_);
  lp_.bound = bound_;
  forces_ = carry_over(known_.pairs, known_.y, pairs_);
}

bool SequentialLp::acceptable(const LpSolution &x, LpCheck &check) const {
  check = check_lp(lp_, x);
  // An LP that ends early leans on step bounds that it has not reached yet; any feasible answer of it is a safe step.
  const double tight = early_ > 0.0 ? std::numeric_limits<double>::infinity()
                       : x.g > 1e-9 ? 1e-3
                                    : 1e-5;  // the rest is left to polish
  return x.solved && check.infeasibility < 1e-9 && check.gamma < 1e-6 && check.balance < tight && std::isfinite(x.g);
}

// One solver's answer; true when it is kept or nothing more is to be done.
bool SequentialLp::ask(jam_lp_solver solver, const IpmControl &control) {
  answer_ = solver == JAM_LP_IPM ? ipm_.solve(lp_, control, &monitor_) : solve_lp_clp(lp_, 1e-9, &monitor_);
  if (seams_.answer) seams_.answer(answer_, solver);
  LpCheck check;
  const bool good = acceptable(answer_, check);
  // An interior point that was interrupted says so by an answer that does not check out; one that did is not thrown
  // away.
  if (good && !monitor_.cancelled()) return keep(check, solver), true;
  if (monitor_.interrupted()) return true;
  monitor_.log(JAM_LOG_WARNING, "%s: infeasibility %.1e balance %.1e |sum y - 1| %.1e",
               solver == JAM_LP_IPM ? "interior point" : "Clp", check.infeasibility, check.balance, check.gamma);
  return false;
}

// The chosen solver first; then a cold interior point with small steps, then Clp.
void SequentialLp::solve() {
  kept_ = false;
  IpmControl control;
  control.tolerance = o_.lp_tolerance;
  control.early_fraction = early_;
  control.threads = o_.threads;
  if (o_.lp_solver == JAM_LP_IPM) {
    if (moved_ <= settled && held_ == 0) control.multipliers = &forces_;
    if (early_ > 0.0)  // in a valley the path takes over, and wants slack where the chain wants its vertex
      control.leave = [this](const LpSolution &x) {
        return in_valley(gain_of(x), largest_step(x, find_network(lp_, x), lp_.dim));
      };
    if (ask(JAM_LP_IPM, control)) return;
    control.multipliers = nullptr;
    control.leave = nullptr;
    control.correctors = 0;
    control.early_fraction = 0;
    control.max_iterations = 200;
    if (ask(JAM_LP_IPM, control)) return;
    monitor_.log(JAM_LOG_WARNING, "the interior point failed twice; Clp takes over");
  }
  if (!ask(JAM_LP_CLP, control))
    fail(JAM_E_SOLVER, "no LP solver gave an answer that checks out; the log has the residuals");
}

void SequentialLp::keep(const LpCheck &check, jam_lp_solver solver) {
  out_.report.lp_solver = solver;
  out_.report.gamma_residual = check.gamma;
  out_.report.duality_gap = std::fabs(check.gap);
  ++out_.report.lp_solves;
  kept_ = true;
}

void SequentialLp::one_lp() {
  network_ = Network();  // belongs to the list that build_lp replaces: an interrupted LP leaves no contacts
  build_lp();
  early_ = last_gain_ > 1e-7 && o_.lp_solver == JAM_LP_IPM && !o_.steps ? 0.02 : 0.0;
  solve();
  if (monitor_.cancelled()) return stop(JAM_STOP_CANCELLED, JAM_CANCELLED);
  if (!kept_) return stop(JAM_STOP_WALL_TIME, JAM_LIMIT);
  known_ = {pairs_, answer_.y};
  network_ = find_network(lp_, answer_);
  if (history_.details()) history_.take_network(out_.packing, lp_, answer_);
  const double alpha = take_step(out_.packing, pairs_, reach_, answer_, unit_);
  const double gain = gain_of(answer_), step = largest_step(answer_, network_, lp_.dim);
  out_.report.gain = gain;
  out_.report.max_step = moved_ = step;
  monitor_.log(
      JAM_LOG_INFO,
      "LP %lld: gain %.3e step %.3e alpha %.3f pairs %zu iterations %d contacts %zu stable %lld bound %.3g phi %.12f",
      static_cast<long long>(out_.report.lp_solves), gain, step, alpha, pairs_.size(), answer_.iterations,
      network_.active.size(), static_cast<long long>(network_.stable_count), bound_, packing_fraction(out_.packing));
  lp_step(alpha);
  if (show(JAM_PHASE_CRUNCH, gain, step)) return stop(JAM_STOP_CANCELLED, JAM_CANCELLED);
  judge(gain, step, alpha);
}

void SequentialLp::lp_step(double alpha) {
  std::vector<double> moved = answer_.s;
  for (double &s : moved) s *= alpha * unit_;
  HistoryRow &row = history_.moved(out_.packing, JAM_STEP_LP, monitor_.seconds(), system_.factorisations, moved.data());
  held_ = 0;
  for (const double s : answer_.s) held_ += std::fabs(s) > 0.999 * lp_.bound;
  const double contacts = static_cast<double>(network_.active.size()),
               stable = static_cast<double>(network_.stable_count);
  row[JAM_HISTORY_GAIN] = std::expm1(0.5 * std::log1p(alpha * answer_.g));
  row[JAM_HISTORY_CONTACTS] = contacts;
  row[JAM_HISTORY_EXCESS] = contacts - (stable > 0.0 ? lp_.dim * (stable - 1.0) + 1.0 : 0.0);
  row[JAM_HISTORY_RATTLERS] = static_cast<double>(lp_.n) - stable;
  row[JAM_HISTORY_ITERATIONS] = answer_.iterations;
  row[JAM_HISTORY_DUALITY_GAP] = out_.report.duality_gap;
  row[JAM_HISTORY_PAIRS] = static_cast<double>(pairs_.size());
  row[JAM_HISTORY_HELD] = static_cast<double>(held_);
  row[JAM_HISTORY_PART] = alpha;
  row[JAM_HISTORY_BOUND] = lp_.bound;
}

void SequentialLp::judge(double gain, double step, double alpha) {
  if (gain <= o_.gain_tolerance && step <= o_.step_tolerance && early_ == 0.0)
    return stop(JAM_STOP_CONVERGED, JAM_OK);  // rigid or not: `finish`
  if (alpha == 0.0) return stop(JAM_STOP_STALLED, JAM_NOT_CONVERGED);
  if (out_.report.lp_solves >= o_.max_lps) return stop(JAM_STOP_LP_LIMIT, JAM_LIMIT);
  if (cut_off()) return;
  // Rounding floor: the gain is below tolerance and the steps do not get there.
  if (gain <= o_.gain_tolerance) ++idle_;
  if (idle_ >= 12) return stop(JAM_STOP_STALLED, JAM_NOT_CONVERGED);
  // An LP that ended early leaves gaps of a part of its gain. Where only the bound ends a gain that does not fall, or a
  // floppy mode that has yet to close a contact, it is too tight.
  const bool floppy = network_.stable_count > 0 &&
                      static_cast<int64_t>(network_.active.size()) <= lp_.dim * (network_.stable_count - 1);
  const double wider = held_ > 0 && (floppy || gain > 0.2 * last_gain_) ? 5.0 * lp_.bound : 0.0;
  if (o_.step_bound == 0.0)
    bound_ = std::min(std::max({5.0 * step, gain, narrowest, wider}), alpha < 1.0 ? 0.7 * bound_ : 0.5);
  last_gain_ = gain;
}

}  // namespace jam
