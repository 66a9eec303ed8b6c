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

#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "crunch/polish.hpp"
#include "crunch/state.hpp"
#include "network/rigidity_test.hpp"

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
  if (s.history.details()) s.show(JAM_PHASE_POLISH, row[JAM_HISTORY_GAIN], row[JAM_HISTORY_STEP_MAX]);
}

// Closes the contacts and balances the forces. False: refused, one more LP decides anew.
bool last_digits(CrunchState &s) {
  if (s.show(JAM_PHASE_POLISH, s.out.report.gain, s.out.report.max_step, false))
    return s.stop(JAM_STOP_CANCELLED, JAM_CANCELLED), true;
  if (s.hooks.before_polish) s.hooks.before_polish(s.out.packing, s.out.contacts);
  PolishEnd end = polish(s.out.packing, s.out.contacts, s.system, s.o.threads, s.tuning, &s.monitor);
  if (end != PolishEnd::done && end != PolishEnd::interrupted) {
    // No LP in doubles tells a gap of 1e-8 from a force of 1e-8: all such pairs are closed together and tested.
    ContactNetwork all = with_near_pairs(s.out.packing, s.out.contacts, s.tuning.undecided_gap);
    if (all.size() > s.out.contacts.size()) {
      const PolishEnd wider = polish(s.out.packing, all, s.system, s.o.threads, s.tuning, &s.monitor);
      if (wider == PolishEnd::done) s.out.contacts = std::move(all);
      if (wider == PolishEnd::done || wider == PolishEnd::interrupted) end = wider;
    }
  }
  s.pairs.clear();  // polish left another graph in the system
  if (end == PolishEnd::interrupted) return s.interrupted(), true;
  s.polished = end == PolishEnd::done;
  if (s.polished) return add_history_row(s), true;
  const bool again = ++s.stalled < s.tuning.max_stalled_lps && s.out.report.lp_solves < s.o.max_lps;
  s.monitor.log(JAM_LOG_WARNING, "polish refused: %s; %s", text_of(end),
                again ? "one more LP" : "the LP's answer stays");
  return !again;
}

// The longest part of the motion v, at most `most`, that no pair blocks. v is zero for spheres that do not move.
double free_length(const Packing &p, const std::vector<double> &v, double most) {
  const PairList pairs = find_pairs(p, 2.2 * most, 1.0);
  const size_t d = p.dim;
  double length = most, r[JAM_MAX_DIM];
  for (size_t k = 0; k < pairs.size(); ++k) {
    const size_t i = static_cast<size_t>(pairs.i[k]) * d, j = static_cast<size_t>(pairs.j[k]) * d;
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]), r2 = pair_vector(p, pairs, k, r);
    double rv = 0.0, vv = 0.0;
    for (size_t c = 0; c < d; ++c)
      rv += r[c] * (v[i + c] - v[j + c]), vv += (v[i + c] - v[j + c]) * (v[i + c] - v[j + c]);
    const double gap = std::max(0.0, r2 - sigma * sigma), disc = rv * rv - vv * gap;
    if (rv < -1e-9 * sigma * std::sqrt(vv) && disc > 0.0) length = std::min(length, gap / (-rv + std::sqrt(disc)));
  }
  return length;
}

// Moves along the flex of a saddle. False where a pair blocks at once or the kicks are used up.
bool leave_saddle(CrunchState &s, const PackingVerdict &verdict) {
  Packing &p = s.out.packing;
  const double now = packing_fraction(p);
  if (verdict.result.flex.empty() || s.kicks >= s.tuning.max_kicks) return false;
  ++s.kicks;
  std::vector<double> v(p.position.size(), 0.0);
  const size_t d = p.dim;
  for (size_t q = 0; q < verdict.sphere.size(); ++q)
    for (size_t c = 0; c < d; ++c) v[verdict.sphere[q] * d + c] = verdict.result.flex[q * d + c];
  const double unit = diameter_mean(p), length = 0.9 * free_length(p, v, s.tuning.kick * unit);
  s.monitor.log(JAM_LOG_INFO, "saddle at phi %.12f with %lld flexes: moves %.1e diameters along one of them", now,
                static_cast<long long>(verdict.result.flexes), length / unit);
  if (length < 1e-6 * unit) return --s.kicks, false;
  for (size_t k = 0; k < v.size(); ++k) p.position[k] += length * v[k];
  wrap_positions(p);
  s.bound = first_bound(s);
  s.last_gain = s.moved = 1.0;
  s.stalled = 0;
  return true;
}

// A cold LP: a warm one leads to the same corner where multipliers are not unique.
Phase one_more_lp(CrunchState &s) {
  s.moved = 1.0;
  s.last_gain = 0.0;
  return Phase::approach;
}

// Collectively jammed or not, from positions alone; LPs go on from a saddle.
Phase judge(CrunchState &s) {
  const PackingVerdict verdict = test_packing(s.out.packing, &s.out.contacts, Jamming::collective);
  s.monitor.log(
      JAM_LOG_INFO,
      "test: jammed %d, stressed %d, contacts %lld of %zu, needed %lld, self-stresses %lld, flexes %lld, margin "
      "%.1e, undecided contacts %lld, residual %.1e",
      static_cast<int>(verdict.result.jammed), static_cast<int>(verdict.result.stressed),
      static_cast<long long>(verdict.result.contacts), s.out.contacts.size(),
      static_cast<long long>(verdict.result.contacts_needed), static_cast<long long>(verdict.result.self_stresses),
      static_cast<long long>(verdict.result.flexes), verdict.result.margin,
      static_cast<long long>(verdict.undecided_contacts), verdict.result.force_residual);
  double open = 0.0;
  for (size_t k = 0; k < verdict.contacts.size(); ++k)
    if (verdict.result.carrying[k]) open = std::max(open, std::fabs(verdict.contacts.gap[k]));
  // A contact that stays open is none: only closed ones make a packing jammed.
  if (verdict.result.jammed == Verdict::yes && open < contact_gap_limit) {
    // Forces of several states of self-stress are not unique: those of the test lie in the middle of all. It also
    // balances forces that polish refused.
    if (s.o.polish && (!s.polished || excess_contacts(s.out.contacts, s.out.packing.dim) > 0)) {
      const double scale = s.out.contacts.force_scale;
      s.out.contacts = verdict.carrying(s.out.packing.dim);
      s.out.contacts.force_scale = scale;
    }
    s.jammed = true;
    report_verdict(verdict, s.out.packing.dim, s.out.report);
    return s.stop(JAM_STOP_CONVERGED, JAM_OK), Phase::done;
  }
  if (leave_saddle(s, verdict)) return Phase::approach;
  if (++s.stalled < s.tuning.max_stalled_lps) return one_more_lp(s);
  report_verdict(verdict, s.out.packing.dim, s.out.report);
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

}  // namespace

Phase identify(CrunchState &s) {
  if (s.active.rows.empty()) {
    if (s.out.report.stop_reason == JAM_STOP_NONE) s.stop(JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
    return Phase::done;
  }
  s.out.contacts = make_contacts(s.out.packing, s.pairs, s.answer, s.active);
  if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;
  if (s.o.polish && !last_digits(s)) return one_more_lp(s);
  if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;
  return judge(s);
}

void finish(CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  r.method = s.paths ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP;
  certify(s.out.packing, s.out.contacts, r);
  r.jammed = s.jammed && r.force_residual < (s.o.polish ? 1e-6 : 1e-5) && r.min_force >= 0.0;
  if (s.jammed && !r.jammed) s.stop(JAM_STOP_SOLVER, JAM_NOT_CONVERGED);
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
  s.out.report.method = s.paths ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP;
  s.out.report.factorisations = s.system.factorisations;
  s.out.report.seconds = s.monitor.seconds();
}

}  // namespace jam
