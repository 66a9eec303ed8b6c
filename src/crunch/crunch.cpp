// The chain of LPs: neighbour radius and step bound, solve, check, step, until nothing moves.
#include "crunch/crunch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "core/error.hpp"
#include "crunch/relinearise.hpp"
#include "lp/interior_point.hpp"

namespace jam {

namespace {

// Median gap of the d n nearest pairs below which a start may be jammed already.
constexpr double already_closed = 1e-11;
// An LP that gains more than this strides through dilute space; one whose longest step is below this (mean diameters)
// is the first of a few.
constexpr double strides = 3e-3, nearly_there = 1e-2;
// Step bound of the last LPs, mean diameters.
constexpr double narrowest = 1e-6;
// LPs without a gain five times below all before, after which the barrier path is asked.
constexpr int patience = 3, most_returns = 4;
// Gaps that the path opens to at least: two digits above where rounding of coordinates blurs the barrier.
constexpr double least_room = 1e-10;

class Chain {
 public:
  Chain(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History &history, const CrunchSeams &seams)
      : o_(o), monitor_(monitor), history_(history), seams_(seams), ipm_(system_) {
    out_.packing = start;
    out_.contacts.coordination.assign(start.n(), 0);
    out_.report.struct_size = sizeof out_.report;
    history_.begin(start, o.steps != 0);
  }

  CrunchResult run() {
    try {
      if (contact_gap(out_.packing) < already_closed) {  // one LP in full, as narrow as the last one of a run, tells whether it is jammed
        bound_ = narrowest, last_gain_ = 0.0;
        one_lp();
      }
      bound_ = first_bound(), last_gain_ = 1.0;
      if (out_.report.stop_reason == JAM_STOP_NONE && o_.method == JAM_CRUNCH_RELINEARISE) approach();
      do {
        while (out_.report.stop_reason == JAM_STOP_NONE) {
          one_lp();
          if (creeping() && out_.report.stop_reason == JAM_STOP_NONE) follow_path();
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

 private:
  // The free spacing of a dilute start, down to a tenth of a diameter near jamming and less where gaps h are closed: floppy
  // motion goes some tens of sqrt(h).
  double first_bound() const {
    if (o_.step_bound > 0.0) return o_.step_bound;
    return std::min(0.1 + 0.6 * free_spacing(out_.packing), std::max(1e-3, 100.0 * std::sqrt(contact_gap(out_.packing))));
  }

  // LPs take a dilute start in a few long strides, and finish at once what is all but jammed: short steps tell. Between
  // the two lies the curved valley that the barrier path is for.
  void approach() {
    do one_lp();
    while (out_.report.stop_reason == JAM_STOP_NONE && out_.report.gain > strides);
    if (out_.report.stop_reason == JAM_STOP_NONE && out_.report.max_step > nearly_there) follow_path();
  }

  // A saddle: gains no longer fall, each LP goes a little farther than the last along a mode that buckles. The barrier path, at
  // the scale of those steps, gets off it in fewer factorisations.
  bool creeping() {
    if (o_.method != JAM_CRUNCH_RELINEARISE || out_.report.max_step < narrowest) return false;
    if (out_.report.gain < 0.2 * lowest_gain_) lowest_gain_ = out_.report.gain, slow_lps_ = 0;
    else ++slow_lps_;
    return slow_lps_ >= patience && returns_++ < most_returns;
  }

  // Down the barrier path to where a few LPs finish. Where the path wanders the chain goes on from the state reached.
  void follow_path() {
    walked_ = true;
    RelineariseControl control;
    // Gaps to be gained further on: a contact across a step of length l opens by l^2.
    control.room = std::max({0.5 * out_.report.gain, 0.1 * out_.report.max_step * out_.report.max_step, least_room});
    control.target = std::min(control.target, 0.01 * control.room);
    control.threads = o_.threads;
    control.wall_time = o_.wall_time;
    control.on_step = [this](double gap, size_t pairs) { path_step(gap, pairs); };
    const RelineariseResult path = relinearise(out_.packing, control, system_, monitor_);
    if (history_.behind(out_.packing)) path_step(path.gap, 0);
    if (monitor_.cancelled()) return stop(JAM_STOP_CANCELLED, JAM_CANCELLED);
    if (monitor_.seconds() > o_.wall_time) return stop(JAM_STOP_WALL_TIME, JAM_LIMIT);
    monitor_.log(JAM_LOG_INFO, "path: %s duality gap %.2e after %d factorisations, %d saddles, phi %.12f", path.reached ? "reached" : "stopped at", path.gap,
                 path.factorisations, path.reheats, packing_fraction(out_.packing));
    bound_ = first_bound();
    if (path.reached && o_.step_bound == 0.0) bound_ = std::min(1e-3, std::max(10.0 * std::sqrt(path.gap), 100.0 * narrowest));
    lowest_gain_ = std::numeric_limits<double>::infinity(), slow_lps_ = 0;
    if (path.reached) last_gain_ = path.gap;
  }

  void path_step(double gap, size_t pairs) {
    HistoryRow &row = history_.moved(out_.packing, JAM_STEP_PATH, monitor_.seconds(), system_.factorisations);
    row[JAM_HISTORY_DUALITY_GAP] = gap;
    row[JAM_HISTORY_PAIRS] = static_cast<double>(pairs);
    if (history_.details()) show(JAM_PHASE_CRUNCH, gap, row[JAM_HISTORY_STEP_MAX]);
  }

  // Tells the callback at once, with the step just finished to look at or without. True: stop.
  bool show(jam_phase phase, double gain, double step, bool finished = true) {
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

  void build_lp() {
    Packing &p = out_.packing;
    unit_ = diameter_mean(p);
    reach_ = 2.2 * bound_ * unit_;
    if (o_.neighbour_radius > 0.0) reach_ = std::max(0.0, o_.neighbour_radius * unit_ - diameter_max(p));
    PairList pairs = find_pairs(p, reach_, 1.0);
    if (pairs.size() == 0) fail(JAM_E_ARGUMENT, "no pair within the neighbour radius %g", o_.neighbour_radius);
    pairs_ = std::move(pairs);
    lp_ = make_lp(p, pairs_, unit_);
    lp_.bound = bound_;
  }

  bool acceptable(const LpSolution &x, LpCheck &check) const {
    check = check_lp(lp_, x);
    // An LP that ends early leans on step bounds that it has not reached yet; any feasible answer of it is a safe step.
    const double tight = early_ > 0.0 ? std::numeric_limits<double>::infinity() : x.g > 1e-9 ? 1e-3 : 1e-5;  // the rest is left to polish
    return x.solved && check.infeasibility < 1e-9 && check.gamma < 1e-6 && check.balance < tight && std::isfinite(x.g);
  }

  bool interrupted() const { return monitor_.cancelled() || monitor_.seconds() > o_.wall_time; }

  // One solver's answer; true when it is kept or nothing more is to be done.
  bool ask(jam_lp_solver solver, const IpmControl &control) {
    answer_ = solver == JAM_LP_IPM ? ipm_.solve(lp_, control, &monitor_) : solve_lp_clp(lp_, 1e-9, o_.wall_time - monitor_.seconds(), &monitor_);
    if (seams_.answer) seams_.answer(answer_, solver);
    LpCheck check;
    const bool good = acceptable(answer_, check);
    // An interior point that was interrupted says so by an answer that does not check out; one that did is not thrown away.
    if (good && !monitor_.cancelled()) return keep(check, solver), true;
    if (interrupted()) return true;
    monitor_.log(JAM_LOG_WARNING, "%s: infeasibility %.1e balance %.1e |sum y - 1| %.1e", solver == JAM_LP_IPM ? "interior point" : "Clp", check.infeasibility,
                 check.balance, check.gamma);
    return false;
  }

  // The chosen solver first; then a cold interior point with small steps, then Clp.
  void solve() {
    kept_ = false;
    IpmControl control;
    control.tolerance = o_.lp_tolerance;
    control.early_fraction = early_;
    control.threads = o_.threads;
    control.wall_time = o_.wall_time;
    if (o_.lp_solver == JAM_LP_IPM) {
      if (ask(JAM_LP_IPM, control)) return;
      control.correctors = 0;
      control.early_fraction = 0;
      control.max_iterations = 200;
      if (ask(JAM_LP_IPM, control)) return;
      monitor_.log(JAM_LOG_WARNING, "the interior point failed twice; Clp takes over");
    }
    if (!ask(JAM_LP_CLP, control)) fail(JAM_E_SOLVER, "no LP solver gave an answer that checks out; the log has the residuals");
  }

  void keep(const LpCheck &check, jam_lp_solver solver) {
    out_.report.lp_solver = solver;
    out_.report.gamma_residual = check.gamma;
    out_.report.duality_gap = std::fabs(check.gap);
    ++out_.report.lp_solves;
    kept_ = true;
  }

  void one_lp() {
    network_ = Network();  // belongs to the list that build_lp replaces: an interrupted LP leaves no contacts
    build_lp();
    early_ = last_gain_ > 1e-7 && o_.lp_solver == JAM_LP_IPM && !o_.steps ? 0.02 : 0.0;
    solve();
    if (monitor_.cancelled()) return stop(JAM_STOP_CANCELLED, JAM_CANCELLED);
    if (!kept_) return stop(JAM_STOP_WALL_TIME, JAM_LIMIT);
    network_ = find_network(lp_, answer_);
    if (history_.details()) history_.take_network(out_.packing, lp_, answer_);
    const double alpha = take_step(out_.packing, pairs_, reach_, answer_, unit_);
    const double gain = std::sqrt(1.0 + std::max(answer_.g, 0.0)) - 1.0, step = largest_step(answer_, network_, lp_.dim);
    out_.report.gain = gain;
    out_.report.max_step = step;
    monitor_.log(JAM_LOG_INFO, "LP %lld: gain %.3e step %.3e alpha %.3f pairs %zu iterations %d contacts %zu stable %lld bound %.3g phi %.12f",
                 static_cast<long long>(out_.report.lp_solves), gain, step, alpha, pairs_.size(), answer_.iterations, network_.active.size(),
                 static_cast<long long>(network_.stable_count), bound_, packing_fraction(out_.packing));
    lp_step(alpha);
    if (show(JAM_PHASE_CRUNCH, gain, step)) return stop(JAM_STOP_CANCELLED, JAM_CANCELLED);
    judge(gain, step, alpha);
  }

  void lp_step(double alpha) {
    std::vector<double> moved = answer_.s;
    for (double &s : moved) s *= alpha * unit_;
    HistoryRow &row = history_.moved(out_.packing, JAM_STEP_LP, monitor_.seconds(), system_.factorisations, moved.data());
    held_ = 0;
    for (const double s : answer_.s) held_ += std::fabs(s) > 0.999 * lp_.bound;
    const double contacts = static_cast<double>(network_.active.size()), stable = static_cast<double>(network_.stable_count);
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

  void judge(double gain, double step, double alpha) {
    if (gain <= o_.gain_tolerance && step <= o_.step_tolerance && early_ == 0.0) {
      const bool rigid = network_.stable_count > 0 && static_cast<int64_t>(network_.active.size()) > lp_.dim * (network_.stable_count - 1);
      return rigid ? stop(JAM_STOP_CONVERGED, JAM_OK) : stop(JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
    }
    if (alpha == 0.0) return stop(JAM_STOP_STALLED, JAM_NOT_CONVERGED);
    if (out_.report.lp_solves >= o_.max_lps) return stop(JAM_STOP_LP_LIMIT, JAM_LIMIT);
    if (monitor_.seconds() > o_.wall_time) return stop(JAM_STOP_WALL_TIME, JAM_LIMIT);
    // Rounding floor: the gain is below tolerance and the steps do not get there.
    if (gain <= o_.gain_tolerance) ++idle_;
    if (idle_ >= 12) return stop(JAM_STOP_STALLED, JAM_NOT_CONVERGED);
    // An LP that ended early leaves gaps of a part of its gain. Where only the bound ends a gain that does not fall, or a floppy mode
    // that has yet to close a contact, it is too tight.
    const bool floppy = network_.stable_count > 0 && static_cast<int64_t>(network_.active.size()) <= lp_.dim * (network_.stable_count - 1);
    const double wider = held_ > 0 && (floppy || gain > 0.2 * last_gain_) ? 5.0 * lp_.bound : 0.0;
    if (o_.step_bound == 0.0) bound_ = std::min(std::max({5.0 * step, gain, narrowest, wider}), alpha < 1.0 ? 0.7 * bound_ : 0.5);
    last_gain_ = gain;
  }

  void stop(jam_stop_reason reason, jam_status status) { out_.report.stop_reason = reason, out_.status = status; }

  // Contacts of the last LP and their last digits. Where polish refuses, an LP that lists fewer pairs that nearly touch decides
  // once more which of them carry force; after that its answer stays.
  bool wants_another_lp() {
    if (answer_.y.empty() || network_.stable.empty()) return false;
    out_.contacts = make_contacts(out_.packing, pairs_, answer_, network_);
    if (out_.report.stop_reason != JAM_STOP_CONVERGED || !o_.polish || last_digits() || retried_) return false;
    if (out_.report.lp_solves >= o_.max_lps || out_.report.stop_reason != JAM_STOP_CONVERGED) return false;
    retried_ = true;
    bound_ = std::max(0.03 * lp_.bound, 1e-9), last_gain_ = 0.0;
    pairs_.clear();  // polish left another graph in system_
    stop(JAM_STOP_NONE, JAM_OK);
    return true;
  }

  void finish() {
    jam_report &r = out_.report;
    r.method = walked_ ? JAM_CRUNCH_RELINEARISE : JAM_CRUNCH_CHAIN;
    certify(out_.packing, out_.contacts, r);
    r.jammed = r.stop_reason == JAM_STOP_CONVERGED && r.excess_contacts >= 0 && r.force_residual < (o_.polish ? 1e-6 : 1e-5) && r.min_force > 0.0;
    if (r.stop_reason == JAM_STOP_CONVERGED && !r.jammed) stop(JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
    r.factorisations = system_.factorisations;
    r.seconds = monitor_.seconds();
    r.seconds_factor = system_.seconds_factor;
    r.seconds_assemble = system_.seconds_assemble;
    r.seconds_solve = system_.seconds_solve;
  }

  // Out of memory, or no LP solved: the state is the last good one, without contacts. Allocates nothing that it cannot do without.
  void finish_failed() {
    for (double &x : out_.packing.position) x = wrap(x, out_.packing.box);
    ContactNetwork &c = out_.contacts;
    c.pairs.clear(), c.vector.clear(), c.gap.clear(), c.force.clear();
    std::fill(c.coordination.begin(), c.coordination.end(), 0);
    try {
      certify(out_.packing, c, out_.report);
    } catch (const std::bad_alloc &) {
      out_.report.packing_fraction = packing_fraction(out_.packing);
    }
    out_.report.method = walked_ ? JAM_CRUNCH_RELINEARISE : JAM_CRUNCH_CHAIN;
    out_.report.factorisations = system_.factorisations;
    out_.report.seconds = monitor_.seconds();
  }

  // False when polish refused.
  bool last_digits() {
    if (seams_.before_polish) seams_.before_polish(out_.packing, out_.contacts);
    if (show(JAM_PHASE_POLISH, out_.report.gain, out_.report.max_step, false)) return stop(JAM_STOP_CANCELLED, JAM_CANCELLED), true;
    const PolishEnd end = polish(out_.packing, out_.contacts, system_, o_.threads, &monitor_);
    if (end == PolishEnd::done) {
      HistoryRow &row = history_.moved(out_.packing, JAM_STEP_POLISH, monitor_.seconds(), system_.factorisations);
      for (const auto column : {JAM_HISTORY_CONTACTS, JAM_HISTORY_EXCESS, JAM_HISTORY_RATTLERS}) row[column] = history_.rows().end()[-2][column];
      if (history_.details()) show(JAM_PHASE_POLISH, row[JAM_HISTORY_GAIN], row[JAM_HISTORY_STEP_MAX]);
    }
    const char *why = end == PolishEnd::open_contact ? "a contact does not close" : end == PolishEnd::negative_force ? "a force turns negative"
                      : end == PolishEnd::overlap ? "another pair would overlap" : nullptr;
    if (why) monitor_.log(JAM_LOG_WARNING, "polish refused: %s; %s", why, retried_ ? "the LP's answer stays" : "one more LP");
    if (monitor_.cancelled()) stop(JAM_STOP_CANCELLED, JAM_CANCELLED);
    return !why;
  }

  const jam_crunch_options o_;
  Monitor &monitor_;
  History &history_;
  const CrunchSeams &seams_;
  CrunchResult out_;
  NewtonSystem system_;
  InteriorPoint ipm_;
  PairList pairs_;
  PackingLp lp_;
  LpSolution answer_;
  Network network_;
  double unit_ = 1.0, reach_ = 0.0, bound_ = 0.1, early_ = 0.0;
  double last_gain_ = 1.0, lowest_gain_ = std::numeric_limits<double>::infinity();
  int64_t held_ = 0;  // displacements that the last LP's bound ended
  int slow_lps_ = 0, returns_ = 0;
  int idle_ = 0;
  bool retried_ = false;  // an LP more because polish refused
  bool walked_ = false;   // the barrier path was followed: another quench than LPs alone
  bool kept_ = false;  // the last LP gave an answer that passed the checks
};

}  // namespace

double free_spacing(const Packing &p) {
  const double jammed = p.dim == 2 ? 0.84 : 0.64 * std::pow(0.7, p.dim - 3);
  return std::max(0.0, std::pow(packing_fraction(p), -1.0 / p.dim) - std::pow(jammed, -1.0 / p.dim));
}

CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history, const CrunchSeams *seams) {
  check_options(start, o);
  if (monitor.log_fn && monitor.log_level >= JAM_LOG_INFO) {
    const jam_estimate e = estimate(start, o);
    monitor.log(JAM_LOG_INFO, "estimate: %.3g MB, %lld pairs, %.3g flops a factorisation, about %.3g s for %.0f of them", e.bytes / 1e6,
                static_cast<long long>(e.pairs), e.flops, e.seconds, e.factorisations);
  }
  History own;
  History &steps = history ? *history : own;
  const CrunchSeams none;
  CrunchResult result = Chain(start, o, monitor, steps, seams ? *seams : none).run();
  if (seams && seams->attempt) seams->attempt(result);
  const bool gave_up = result.status == JAM_NOT_CONVERGED || result.status == JAM_NOT_JAMMED;
  if (!gave_up || o.method != JAM_CRUNCH_RELINEARISE || monitor.cancelled() || monitor.seconds() > o.wall_time) return result;
  // The path led to a point where a contact's force is too weak for the LPs to decide whether it closes. The chain takes
  // another way from the same start; its answer counts if it is a jammed packing.
  monitor.log(JAM_LOG_WARNING, "the barrier path ended at an undecided contact; the chain of LPs starts again");
  jam_crunch_options chain = o;
  chain.method = JAM_CRUNCH_CHAIN;
  History again;
  std::swap(again, steps);  // callbacks look at `steps`
  CrunchResult second = Chain(start, chain, monitor, steps, seams ? *seams : none).run();
  second.report.lp_solves += result.report.lp_solves;
  second.report.factorisations += result.report.factorisations;
  if (second.report.jammed) return second;
  std::swap(again, steps);
  return result;
}

}  // namespace jam
