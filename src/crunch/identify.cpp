// Phase 3: which contacts carry force, their last digits, and the verdict.
//
//   active set of the LP -> closed contacts, balanced forces (polish) -> test of collective jamming -> jammed, or a
//   flex
//
// A flex is a motion that opens contacts: the packing is a saddle of the density. The spheres move along it until a
// pair blocks, and LPs go on.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "core/call_scope.hpp"
#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "crunch/polish.hpp"
#include "crunch/state.hpp"
#include "network/rattlers.hpp"
#include "proof/verdict.hpp"

namespace jam {
namespace {

const char *text_of(PolishEnd end) {
  switch (end) {
    case PolishEnd::open_contact:
      return "a contact does not close";
    case PolishEnd::too_few:
      return "the contacts are too few to balance";
    case PolishEnd::negative_force:
      return "a force turns negative";
    case PolishEnd::overlap:
      return "another pair would overlap";
    default:
      return "";
  }
}

void add_history_row(CrunchState &s) {
  HistoryRow &row = s.history.moved(s.out.packing, JAM_STEP_POLISH, s.monitor.seconds(), s.system.factorisations);
  const ContactNetwork &net = s.out.contacts;
  const auto stable = std::count_if(net.coordination.begin(), net.coordination.end(), [](int32_t z) { return z > 0; });
  row[JAM_HISTORY_CONTACTS] = static_cast<double>(net.size());
  row[JAM_HISTORY_EXCESS] = static_cast<double>(excess_contacts(net, s.out.packing.dim));
  row[JAM_HISTORY_RATTLERS] = static_cast<double>(static_cast<int64_t>(s.out.packing.n()) - stable);
  s.history.over_stable(net.coordination, s.out.packing.dim, diameter_mean(s.out.packing));
  if (s.history.details()) s.show(JAM_PHASE_POLISH, row[JAM_HISTORY_GAIN], row[JAM_HISTORY_STEP_MAX]);
}

// Closes the contacts and balances the forces, as far as they do. False when the call was interrupted.
bool last_digits(CrunchState &s) {
  if (s.show(JAM_PHASE_POLISH, s.out.report.gain, s.out.report.max_step, false))
    return s.stop(JAM_STOP_CANCELLED, JAM_CANCELLED), false;
  if (s.hooks.before_polish) s.hooks.before_polish(s.out.packing, s.out.contacts);
  Tuning tuning = s.tuning;
  if (s.strain.count() > 0) tuning.max_excess = 0;  // a strain may close what motions leave open
  PolishEnd end = PolishEnd::interrupted;
  try {
    end = polish(s.out.packing, s.out.contacts, s.system, s.o.threads, tuning, &s.monitor);
  } catch (const Cancelled &) {  // it works on copies: the contacts of the last LP stay
  }
  s.pairs.clear();  // polish left another graph in the system
  if (end == PolishEnd::interrupted) return s.interrupted(), false;
  s.polished = end == PolishEnd::done;
  if (s.polished)
    add_history_row(s);
  else
    s.monitor.log(JAM_LOG_WARNING, "polish refused: %s", text_of(end));
  return true;
}

// All closed pairs as contacts, of spheres that they hold; the forces are left to the test.
ContactNetwork closed_pairs(const Packing &p, bool own_images) {
  ContactNetwork net;
  net.pairs = find_pairs(p, 0.0, 1.0 + contact_gap_limit);
  measure_contacts(p, net);
  net.coordination.assign(p.n(), 0);
  net.force.assign(net.size(), 1.0);
  std::vector<char> on(net.size());
  for (size_t k = 0; k < net.size(); ++k) on[k] = own_images || !net.pairs.own_image(k);
  drop_unbalanced(p.dim, p.n(), net.pairs.i, net.pairs.j, net.vector, on);
  return subset(net, on, p.dim);
}

void log_verdict(const CrunchState &s, const PackingVerdict &v) {
  const RigidityResult &r = v.result;
  const auto wide = [](int64_t x) { return static_cast<long long>(x); };
  s.monitor.log(JAM_LOG_INFO,
                "test: jammed %d, stressed %d, contacts %lld of %zu, needed %lld, self-stresses %lld, flexes %lld, "
                "margin %.1e, undecided contacts %lld, residual %.1e",
                static_cast<int>(r.jammed), static_cast<int>(r.stressed), wide(r.contacts), s.out.contacts.size(),
                wide(r.contacts_needed), wide(r.self_stresses), wide(r.flexes), r.margin, wide(v.undecided_contacts),
                r.force_residual);
}

// Forces of the test, which are positive and balance as far as any do.
void take_forces_of(CrunchState &s, const PackingVerdict &verdict) {
  const double scale = s.out.contacts.force_scale;
  s.out.contacts = verdict.carrying(s.out.packing.dim);
  s.out.contacts.force_scale = scale;
}

// A packing that is not jammed has no negative forces either: polish projects those of its last network. Where polish
// refused, only the test has forces that balance.
void take_positive_forces(CrunchState &s, const PackingVerdict &verdict) {
  const std::vector<double> &f = s.out.contacts.force;
  const bool refused = s.o.polish && !s.polished && verdict.result.contacts > 0;
  if (refused || std::any_of(f.begin(), f.end(), [](double x) { return x < 0.0; })) take_forces_of(s, verdict);
}

// The test of the packing as it is. False when the call was interrupted: then its contacts stay untested.
bool tested(CrunchState &s, Jamming kind, PackingVerdict &verdict) {
  try {
    verdict = test_packing(s.out.packing, &s.out.contacts, kind);
    if (s.exact && kind == Jamming::collective) decide_by_proof(s.out.packing, verdict);
  } catch (const Cancelled &) {
    s.interrupted();
    return false;
  }
  log_verdict(s, verdict);
  return true;
}

// In a free cell the strict test says whether its strains are at rest, and its one stress balances on the cell too.
Phase judge_strictly(CrunchState &s) {
  PackingVerdict strict;
  if (!tested(s, Jamming::strict, strict)) return Phase::done;
  s.strictly_jammed = static_cast<int32_t>(strict.result.jammed);
  if (strict.result.jammed == Verdict::yes) {
    take_forces_of(s, strict);
  } else if (s.o.strain == JAM_STRAIN_FREE) {
    if (leave_strained_saddle(s, strict)) return s.stop(JAM_STOP_NONE, JAM_OK), Phase::approach;
    s.out.text = "collectively jammed; strictly: " + why_not_jammed(strict, Jamming::strict);
    s.stop(strict.result.jammed == Verdict::no ? JAM_STOP_SADDLE : JAM_STOP_PRECISION, JAM_NOT_CONVERGED);
  }
  return Phase::done;
}

Phase end_jammed(CrunchState &s, const PackingVerdict &verdict) {
  // Forces of several states of self-stress are not unique: those of the test lie in the middle of all. It also
  // balances forces that polish refused.
  if (s.o.polish && (!s.polished || excess_contacts(s.out.contacts, s.out.packing.dim) > 0)) take_forces_of(s, verdict);
  s.jammed = true;
  report_verdict(verdict, s.out.packing.dim, s.out.report);
  s.stop(JAM_STOP_CONVERGED, JAM_OK);
  return s.strain.count() > 0 ? judge_strictly(s) : Phase::done;
}

}  // namespace

// Narrow LPs and moves along flexes belong to the optimum of the wide LPs. A looser tolerance may end before it.
static bool converged(const CrunchState &s) { return s.out.report.gain <= default_crunch_options().gain_tolerance; }

// Collectively jammed or not, from positions alone. LPs go on from a saddle, narrow ones where contacts are in doubt.
Phase judge(CrunchState &s) {
  for (;;) {
    s.system.release();  // the test has a factor of its own
    PackingVerdict verdict;
    if (!tested(s, Jamming::collective, verdict)) return Phase::done;
    if (verdict.result.jammed == Verdict::yes) return end_jammed(s, verdict);
    const Kick kick = converged(s) ? leave_saddle(s, verdict) : Kick::none;
    if (kick == Kick::free) return Phase::approach;
    if (kick == Kick::blocked && s.o.polish) {
      s.out.contacts = closed_pairs(s.out.packing, s.strain.count() > 0);
      if (!last_digits(s)) return Phase::done;
      continue;
    }
    if (!s.exact && s.o.polish) return Phase::exact_vertex;
    report_verdict(verdict, s.out.packing.dim, s.out.report);
    s.out.text = why_not_jammed(verdict);
    take_positive_forces(s, verdict);
    if (verdict.result.jammed != Verdict::no)
      s.stop(JAM_STOP_PRECISION, JAM_NOT_CONVERGED);
    else if (verdict.result.flexes > 0)
      s.stop(JAM_STOP_SADDLE, JAM_NOT_CONVERGED);
    else if (verdict.result.stressed == Verdict::yes)
      s.stop(JAM_STOP_STALLED, JAM_NOT_CONVERGED);
    else
      s.stop(JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
    return Phase::done;
  }
}

Phase identify(CrunchState &s) {
  if (frees_cell(s)) return free_cell(s);
  if (s.active.rows.empty()) {
    if (s.out.report.stop_reason == JAM_STOP_NONE && !s.exact && s.o.polish) return Phase::exact_vertex;
    if (s.out.report.stop_reason == JAM_STOP_NONE) s.stop(JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
    return Phase::done;
  }
  s.out.contacts = make_contacts(s.out.packing, s.pairs, s.answer, s.active);
  if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;
  if (s.o.polish && !last_digits(s)) return Phase::done;
  if (s.o.polish && !s.polished && !converged(s)) {
    s.gain_tolerance = default_crunch_options().gain_tolerance;
    return Phase::approach;
  }
  if (s.o.polish && !s.polished && !s.exact) return Phase::exact_vertex;
  return judge(s);
}

// A crunch that was stopped before an LP ended knows no contacts, so it does not know which spheres are rattlers.
static void mark_unknown_rattlers(const CrunchState &s, jam_crunch_report &r) {
  const bool unknown =
      r.stop_reason == JAM_STOP_CANCELLED || r.stop_reason == JAM_STOP_WALL_TIME || r.stop_reason == JAM_STOP_SOLVER;
  if (!unknown || s.out.contacts.size() > 0) return;
  r.rattlers = r.contacts = r.bucklers = -1, r.stable = 0;
  r.force_residual = r.min_force = r.max_contact_gap = std::numeric_limits<double>::quiet_NaN();
}

void finish(CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  r.method = s.path_taken ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP;
  certify(s.out.packing, s.out.contacts, r, s.strain.count() > 0);
  r.jammed = s.jammed && r.force_residual < (s.o.polish ? 1e-6 : 1e-5) && r.min_force >= 0.0;
  r.strictly_jammed = s.strictly_jammed;
  if (s.jammed && !r.jammed) s.stop(JAM_STOP_SOLVER, JAM_NOT_CONVERGED);
  mark_unknown_rattlers(s, r);
  r.factorisations = s.system.factorisations;
  r.seconds = s.monitor.seconds();
  r.seconds_factor = s.system.seconds_factor;
  r.seconds_assemble = s.system.seconds_assemble;
  r.seconds_solve = s.system.seconds_solve;
}

// Out of memory, or no LP solved: the state is the last good one, without contacts. It allocates only what it must.
void finish_failed(CrunchState &s) {
  wrap_positions(s.out.packing);
  ContactNetwork &c = s.out.contacts;
  c.pairs.clear(), c.vector.clear(), c.gap.clear(), c.force.clear();
  std::fill(c.coordination.begin(), c.coordination.end(), 0);
  try {
    certify(s.out.packing, c, s.out.report);
  } catch (const std::exception &) {  // out of memory, or over its limit
    s.out.report.packing_fraction = packing_fraction(s.out.packing);
  }
  mark_unknown_rattlers(s, s.out.report);
  s.out.report.method = s.path_taken ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP;
  s.out.report.factorisations = s.system.factorisations;
  s.out.report.seconds = s.monitor.seconds();
}

}  // namespace jam
