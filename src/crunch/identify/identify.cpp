#include "crunch/identify/identify.hpp"

#include "crunch/approach/free_cell.hpp"
#include "crunch/control.hpp"
#include "crunch/identify/end.hpp"
#include "crunch/identify/recompress.hpp"

namespace jam::inside {
namespace {

// Along a flex that only the curvature of a round wall ends, a step reaches a small part of the growth of its LP.
// Newton's steps on contacts and forces may get there.
bool curved_and_slow(const CrunchState &s) {
  const int32_t reason = s.out.report.stop_reason;
  return s.out.packing.container.curved() != 0 && (reason == JAM_STOP_STALLED || reason == JAM_STOP_LP_LIMIT);
}

// Spheres that come no nearer may be jammed. A limit of the call says nothing about them.
Phase end_early(CrunchState &s) {
  return s.out.report.stop_reason == JAM_STOP_STALLED ? give_verdict(s, {}) : Phase::done;
}

}  // namespace

Phase identify(CrunchState &s) {
  if (frees_cell(s)) return free_cell(s);
  if (s.last.active.rows.empty()) {
    if (s.out.report.stop_reason == JAM_STOP_NONE && !s.found.narrow && s.o.polish) return Phase::narrow_lps;
    if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;
    return s.o.polish && recompress(s) ? Phase::approach : give_verdict(s, {});
  }
  s.out.contacts = make_contacts(s.out.packing, s.last.pairs, s.last.answer, s.last.active);
  const bool slow = curved_and_slow(s);
  if (s.out.report.stop_reason != JAM_STOP_NONE && !(slow && s.o.polish)) return end_early(s);
  if (s.o.polish && !polish_contacts(s)) return Phase::done;
  if (slow && !s.found.polished) return end_early(s);
  if (slow) stop(s, JAM_STOP_NONE, JAM_OK);
  if (s.o.polish && !s.found.polished && !converged(s)) {
    s.next.gain_tolerance = default_crunch_options().gain_tolerance;
    forget_contacts(s);
    return Phase::approach;
  }
  if (s.o.polish && !s.found.polished && !s.found.narrow) return Phase::narrow_lps;
  return decide_jamming(s);
}

}  // namespace jam::inside
