#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "crunch/phases.hpp"
#include "verdict/text.hpp"

namespace jam::inside {
namespace {

// In the order of PolishEnd.
constexpr const char *why_refused[] = {"",
                                       "there are no contacts",
                                       "",
                                       "a contact does not close",
                                       "the contacts are too few to balance",
                                       "a force turns negative",
                                       "another pair would overlap"};

void log_verdict(const CrunchState &s, const PackingVerdict &v) {
  const RigidityResult &r = v.result;
  const auto wide = [](int64_t x) { return static_cast<long long>(x); };
  s.monitor.log(JAM_LOG_INFO,
                "test: jammed %d, rule %d, stressed %d, contacts %lld of %zu, needed %lld, self-stresses %lld, flexes "
                "%lld, margin %.1e, undecided contacts %lld, residual %.1e",
                static_cast<int>(v.jammed), static_cast<int>(v.rule), static_cast<int>(r.stressed), wide(r.contacts),
                s.out.contacts.size(), wide(r.contacts_needed), wide(r.self_stresses), wide(r.flexes), r.margin,
                wide(v.undecided_contacts), r.force_residual);
}

// Forces of the test, which are positive and balance as far as any do.
void take_forces_of(CrunchState &s, const PackingVerdict &verdict) {
  const double scale = s.out.contacts.size() ? s.out.contacts.force_scale : verdict.contacts.force_scale;
  s.out.contacts = verdict.carrying(s.out.packing.dim);
  s.out.contacts.force_scale = scale;
}

// A packing that is not jammed has no negative forces either: polish projects those of its last network. Where polish
// refused, only the test has forces that balance. A vertex of the LP may leave contacts without force, as simplex has
// it for spheres that only their own images hold: the test has the forces in the middle of all, and all that carry one.
void take_positive_forces(CrunchState &s, const PackingVerdict &verdict) {
  const std::vector<double> &f = s.out.contacts.force;
  const bool refused = s.o.polish && !s.found.polished && verdict.result.contacts > 0;
  const bool all = verdict.result.contacts == static_cast<int64_t>(f.size()),
             idle = std::count(f.begin(), f.end(), 0.0) > 0 && (all || (s.o.polish && verdict.result.contacts > 0));
  if (refused || idle || std::any_of(f.begin(), f.end(), [](double x) { return x < 0.0; })) take_forces_of(s, verdict);
}

// The packing as it is. False when the call was interrupted: then its contacts stay untested.
template <class Test>
bool tested(CrunchState &s, PackingVerdict &verdict, Test &&test) {
  try {
    verdict = test();
  } catch (const Cancelled &) {
    stop_if_interrupted(s);
    return false;
  }
  log_verdict(s, verdict);
  return true;
}

// The contacts that were found, as closed as they are. What this leaves undecided goes to narrow LPs and
// decompressions.
PackingVerdict test_contacts(const CrunchState &s, Jamming kind) {
  return test_packing(s.out.packing, &s.out.contacts, kind, Rule::weak_forces);
}

// The verdict in the report is the one that jam_rigidity would return. A yes on closed contacts is that already.
PackingVerdict final_verdict(const CrunchState &s, const PackingVerdict &tested, Jamming kind) {
  const std::vector<double> &gap = s.out.contacts.gap;
  const bool closed = std::all_of(gap.begin(), gap.end(), [](double h) { return h < contact_gap_limit; });
  return tested.jammed == Verdict::yes && closed ? tested
                                                 : verdict_of(without_overlaps(s.out.packing), &s.out.contacts, kind);
}

// In a free cell the strict test says whether its strains are at rest, and its one stress balances on the cell too.
// Lattices whose cell is a saddle of the density by symmetry are no maximum of it: a decompression leads away.
Phase decide_strict_jamming(CrunchState &s) {
  PackingVerdict strict;
  if (!tested(s, strict, [&] { return test_contacts(s, Jamming::strict); })) return Phase::done;
  if (!tested(s, strict, [&] { return final_verdict(s, strict, Jamming::strict); })) return Phase::done;
  if (strict.jammed != Verdict::yes && s.o.strain == JAM_STRAIN_FREE && s.o.polish && recompress(s))
    return stop(s, JAM_STOP_NONE, JAM_OK), Phase::approach;
  s.found.strictly_jammed = verdict_code(strict.jammed);
  if (strict.jammed == Verdict::yes) {
    take_forces_of(s, strict);
  } else if (s.o.strain == JAM_STRAIN_FREE) {
    s.out.text = "collectively jammed; strictly: " + why_not_jammed(strict, s.out.packing, Jamming::strict);
    stop(s, strict.jammed == Verdict::no ? JAM_STOP_SADDLE : JAM_STOP_PRECISION, JAM_NOT_CONVERGED);
  }
  return Phase::done;
}

Phase end_jammed(CrunchState &s, const PackingVerdict &verdict) {
  // Forces of several states of self-stress are not unique: those of the test lie in the middle of all. It also
  // balances forces that polish refused.
  if (s.o.polish && (!s.found.polished || excess_contacts(s.out.contacts, s.out.packing) > 0))
    take_forces_of(s, verdict);
  if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;  // jammed, though tolerances are not met
  stop(s, JAM_STOP_CONVERGED, JAM_OK);
  return s.next.strain.count() > 0 ? decide_strict_jamming(s) : Phase::done;
}

// Whether decompressions led back to the density of the start, to contacts that are not shown to be jammed: the first
// one of a large packing, all of a small one. True the first time.
bool is_back_at_start(CrunchState &s) {
  const double grown = packing_fraction(s.out.packing) / packing_fraction(s.start) - 1.0;
  const size_t wanted = s.start.n() > s.tuning.most_retried ? 1 : s.tuning.decompression.size();
  const bool decompressed = s.history.stage.decompressions >= wanted;
  if (!decompressed || s.found.start_tested || s.next.strain.count() > 0 || grown > lp_rounding) return false;
  return s.found.start_tested = true;
}

// Diameters of the start cannot grow, and yet its spheres can move, as in a crystal with vacancies side by side.
Phase end_at_start(CrunchState &s, const PackingVerdict &of_start) {
  s.monitor.log(JAM_LOG_INFO, "back at the density of the start, a saddle with %lld flexes: ends there",
                static_cast<long long>(of_start.result.flexes));
  s.out.packing = s.start;
  s.out.contacts = of_start.carrying(s.start.dim);
  s.found.polished = false;
  record_opening(s);
  return give_verdict(s, of_start);
}

}  // namespace

bool polish_contacts(CrunchState &s) {
  if (report_step(s, JAM_PHASE_POLISH, s.out.report.gain, s.out.report.max_step, false))
    return stop(s, JAM_STOP_CANCELLED, JAM_CANCELLED), false;
  if (s.hooks.before_polish) s.hooks.before_polish(s.out.packing, s.out.contacts);
  Tuning tuning = s.tuning;
  if (s.next.strain.count() > 0) tuning.max_excess = 0;  // a strain may close what motions leave open
  PolishEnd end = PolishEnd::interrupted;
  try {
    end = polish(s.out.packing, s.out.contacts, s.system, s.o.threads, tuning, &s.monitor);
  } catch (const Cancelled &) {  // it works on copies: the contacts of the last LP stay
  }
  s.last.pairs.clear(), s.last.active = ActiveSet();  // polish left another graph in the system
  if (end == PolishEnd::interrupted) return stop_if_interrupted(s), false;
  s.found.polished = end == PolishEnd::done;
  if (s.found.polished) {
    HistoryRow &row = record_step(s, JAM_STEP_POLISH);
    record_contacts(s, row, s.out.contacts.size(), s.out.contacts.coordination);
    if (s.history.details()) report_step(s, JAM_PHASE_POLISH, row[JAM_HISTORY_GAIN], row[JAM_HISTORY_STEP_MAX]);
  } else {
    s.monitor.log(JAM_LOG_WARNING, "polish refused: %s", why_refused[static_cast<int>(end)]);
  }
  return true;
}

bool converged(const CrunchState &s) { return s.out.report.gain <= default_crunch_options().gain_tolerance; }

Phase decide_jamming(CrunchState &s) {
  s.system.release();  // the test has a factor of its own
  PackingVerdict verdict;
  if (!tested(s, verdict, [&] { return test_contacts(s, Jamming::collective); })) return Phase::done;
  if (verdict.jammed == Verdict::yes) return give_verdict(s, verdict);
  if (is_back_at_start(s)) {
    PackingVerdict of_start;
    if (!tested(s, of_start, [&] { return verdict_of(without_overlaps(s.start), nullptr, Jamming::collective); }))
      return Phase::done;
    if (of_start.jammed == Verdict::no && of_start.result.flexes > 0) return end_at_start(s, of_start);
  }
  // No slide opens a contact. In a periodic cell it may lead to other spheres, or a strain further.
  const bool open = s.o.polish && !(verdict.result.slides > 0 && s.out.packing.container);
  if (open && !s.found.narrow) return Phase::narrow_lps;
  return open && converged(s) && recompress(s) ? Phase::approach : give_verdict(s, verdict);
}

Phase give_verdict(CrunchState &s, const PackingVerdict &of_contacts) {
  s.system.release();
  PackingVerdict verdict;
  if (of_contacts.jammed != Verdict::yes && of_contacts.contacts.size() > 0) take_positive_forces(s, of_contacts);
  if (!tested(s, verdict, [&] { return final_verdict(s, of_contacts, Jamming::collective); })) return Phase::done;
  s.found.verdict = verdict;
  report_verdict(verdict, s.out.report);
  if (verdict.jammed == Verdict::yes) return end_jammed(s, verdict);
  if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;
  s.out.text = why_not_jammed(verdict, s.out.packing);
  if (verdict.jammed != Verdict::no)
    stop(s, verdict.unresolved > 0.0 ? JAM_STOP_SADDLE : JAM_STOP_PRECISION, JAM_NOT_CONVERGED);
  else if (verdict.result.flexes > 0)
    stop(s, JAM_STOP_SADDLE, JAM_NOT_CONVERGED);
  else if (verdict.result.stressed == Verdict::yes)
    stop(s, JAM_STOP_STALLED, JAM_NOT_CONVERGED);
  else
    stop(s, JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
  return Phase::done;
}

}  // namespace jam::inside
