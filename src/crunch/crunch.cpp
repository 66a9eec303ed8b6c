#include "crunch/crunch.hpp"

#include <cmath>
#include <limits>
#include <new>

#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/limits.hpp"
#include "crunch/phases.hpp"

namespace jam::inside {

CrunchState::CrunchState(const Packing &p, const jam_crunch_options &options, Monitor &m, History &h,
                         const CrunchHooks &for_tests)
    : start(p), o(options), hooks(for_tests), monitor(m), history(h) {
  out.packing = start;
  out.contacts.coordination.assign(start.n(), 0);
  out.report.struct_size = sizeof out.report;
  next.gain_tolerance = o.gain_tolerance;
  history.begin(start, o.steps != 0, o.keep_steps);
}

// The phase at which a stopped crunch continues. With options of another method it begins again.
static Phase first_phase(CrunchState &s) {
  CrunchStage &stage = s.history.stage;
  const bool path = s.o.method == JAM_CRUNCH_BARRIER_PATH;
  const uint8_t decompressions = stage.decompressions;
  if (!path || (stage.cell_free && s.o.strain == JAM_STRAIN_NONE)) stage = CrunchStage();
  stage.decompressions = decompressions;  // slices of a crunch make as many as one call
  const CrunchStage from = stage;
  if (from.cell_free) free_cell(s);
  stage.path_taken = from.path_taken;
  return from.path.mu > 0.0 ? Phase::barrier_path : Phase::approach;
}

// True if the only contacts are spheres with their own images. In a fixed cell no diameter can then grow.
static bool fills_cell(CrunchState &s) {
  const Packing &p = s.out.packing;
  if (p.container || s.o.strain != JAM_STRAIN_NONE || diameter_max(p) < p.cell.shortest() * (1.0 - contact_gap_limit))
    return false;
  const PairList touching = find_pairs(p, 0.0, 1.0 + contact_gap_limit);
  for (size_t k = 0; k < touching.size(); ++k)
    if (!touching.own_image(k)) return false;
  stop(s, JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
  give_verdict(s, {});
  if (s.found.verdict.jammed == Verdict::yes) stop(s, JAM_STOP_CONVERGED, JAM_OK);  // their images hold them
  return true;
}

// Searches for pairs and factorisations may throw Cancelled here.
static void run_phases(CrunchState &s) {
  jam_progress begun = progress_of(JAM_PHASE_CRUNCH);
  begun.packing_fraction = packing_fraction(s.out.packing);
  s.monitor.expect(begun);
  const CancellableScope scope(CallScope::memory_limit(), &s.monitor);
  s.touching = find_touching(s.start);
  if (fills_cell(s)) return;
  s.next.bound = first_bound(s.out.packing, s.o, s.tuning);
  for (Phase phase = first_phase(s); phase != Phase::done;)
    phase = phase == Phase::approach       ? approach(s)
            : phase == Phase::barrier_path ? follow_path(s)
            : phase == Phase::identify     ? identify(s)
                                           : narrow_lps(s);
}

// Logs the estimate, and refuses what surely exceeds the memory of the call. Small systems fit at any density.
static void check_estimate(const Packing &start, const jam_crunch_options &o, Monitor &monitor) {
  const bool logs = monitor.log_fn && monitor.log_level >= JAM_LOG_INFO;
  const double unknowns = static_cast<double>(start.position.size()), full_matrix = 8.0 * unknowns * unknowns;
  if (!logs && full_matrix < CallScope::memory_limit()) return;
  const jam_estimate_report e = estimate(start, o);
  if (logs)
    monitor.log(JAM_LOG_INFO, "estimate: %s, %lld pairs, %.3g flops a factorisation, about %.3g s for %.0f of them",
                bytes_text(e.bytes).c_str(), static_cast<long long>(e.pairs), e.flops, e.seconds, e.factorisations);
  // An estimate may be too high: between this and the limit each matrix decides before it is factorised.
  if (e.bytes > EstimateTuning::too_high * CallScope::memory_limit())
    CallScope::need_memory(e.bytes, "the linear programs of this packing, as jam_estimate_crunch gives it,");
}

CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history,
                    const CrunchHooks *hooks) {
  check_options(start, o);
  const TimeLimit limit(monitor, o.wall_time);
  History own_history;
  const CrunchHooks none;
  jam_crunch_options usable = o;
  usable.lp_tolerance = std::min(o.lp_tolerance, lp_rounding);
  if (usable.lp_tolerance < o.lp_tolerance)
    monitor.log(JAM_LOG_WARNING, "lp_tolerance is %g: LPs are solved to %g, the loosest that a crunch can use",
                o.lp_tolerance, usable.lp_tolerance);
  CrunchState s(start, usable, monitor, history ? *history : own_history, hooks ? *hooks : none);
  try {
    const CancellableScope scope(CallScope::memory_limit(), &monitor);
    check_estimate(start, o, monitor);
  } catch (const Cancelled &) {
    stop_if_interrupted(s);
    report_failure(s);
    return std::move(s.out);
  }
  try {
    run_phases(s);
    report_end(s);
  } catch (const Cancelled &) {  // in a search for pairs, or a factorisation
    stop_if_interrupted(s);
    report_failure(s);
  } catch (const Error &e) {
    stop(s, JAM_STOP_SOLVER, e.code());
    s.out.text = e.what();
    report_failure(s);
  } catch (const std::bad_alloc &) {
    s.out.text.clear();
    stop(s, JAM_STOP_SOLVER, JAM_E_MEMORY);
    report_failure(s);
  }
  report_changes(s);
  return std::move(s.out);
}

jam_crunch_options default_crunch_options() {
  jam_crunch_options o{};
  o.struct_size = sizeof o;
  o.lp_solver = JAM_LP_IPM;
  o.method = JAM_CRUNCH_BARRIER_PATH;
  o.polish = 1;
  o.max_lps = 1000;
  o.threads = 1;
  o.gain_tolerance = 1e-12;
  o.step_tolerance = 1e-9;
  o.lp_tolerance = 1e-15;
  o.wall_time = std::numeric_limits<double>::infinity();
  return o;
}

void check_options(const Packing &p, const jam_crunch_options &o) {
  check_enum(o.lp_solver, JAM_LP_IPM, JAM_LP_CLP, "lp_solver", "jam_lp_solver");
  if (o.lp_solver == JAM_LP_CLP && !clp_is_built())
    fail(JAM_E_UNSUPPORTED, "lp_solver is JAM_LP_CLP, and this build of libjam has no Clp (JAM_CLP=OFF)");
  check_enum(o.method, JAM_CRUNCH_BARRIER_PATH, JAM_CRUNCH_SEQUENTIAL_LP, "method", "jam_crunch_method");
  check_at_least(o.max_lps, 1, "max_lps");
  check_threads(o.threads);
  check_positive(o.gain_tolerance, "gain_tolerance");
  check_positive(o.step_tolerance, "step_tolerance");
  check_positive(o.lp_tolerance, "lp_tolerance");
  check_positive(o.wall_time, "wall_time");
  check_range("neighbour_radius", o.neighbour_radius, 0.0, limits::radius_max);
  if (o.neighbour_radius > 0.0 && o.neighbour_radius < widest_contact(p))
    fail(JAM_E_ARGUMENT, "the neighbour radius %g is below the largest diameter, %.3g (both in mean diameters)",
         o.neighbour_radius, widest_contact(p));
  // Smaller steps are lost in the rounding of positions; larger ones leave the numbers that the LP solvers take.
  if (o.step_bound != 0.0) check_range("step_bound", o.step_bound, 1e-15, limits::radius_max);
  if (o.step_bound > 0.0 && o.step_bound < o.gain_tolerance)
    fail(JAM_E_ARGUMENT, "step_bound is %g, below the gain_tolerance of %g: no step gains as much", o.step_bound,
         o.gain_tolerance);
  check_flag(o.polish, "polish");
  check_flag(o.full_lps, "full_lps");
  check_flag(o.steps, "steps");
  check_flag(o.prove, "prove");
  if (o.keep_steps < 0 || o.keep_steps > limits::keep_steps_max)
    fail(JAM_E_ARGUMENT, "keep_steps is %d, it must be 0 .. %d", o.keep_steps, limits::keep_steps_max);
  check_strain(o.strain, "a crunch");
  if (o.duality_gap != 0.0) {
    check_range("duality_gap", o.duality_gap, limits::duality_gap_min, limits::duality_gap_max);
    if (o.method != JAM_CRUNCH_BARRIER_PATH || o.strain != JAM_STRAIN_NONE)
      fail(JAM_E_ARGUMENT, "duality_gap %g needs the barrier path and a fixed cell", o.duality_gap);
  }
  if (p.n() < 2 && o.strain == JAM_STRAIN_NONE)
    fail(JAM_E_TOO_FEW, "%zu sphere: crunch needs at least 2, or a free cell (strain)", p.n());
  refuse_overlaps(p, 1e-9);
}

}  // namespace jam::inside
