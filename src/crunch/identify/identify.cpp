#include "crunch/identify/identify.hpp"

#include "crunch/approach/free_cell.hpp"
#include "crunch/control.hpp"
#include "crunch/identify/narrow_lps.hpp"
#include "crunch/identify/verdict.hpp"

namespace jam {

Phase identify(CrunchState &s) {
  if (frees_cell(s)) return free_cell(s);
  if (s.last.active.rows.empty()) {
    if (s.out.report.stop_reason == JAM_STOP_NONE && narrow_lps_left(s) && s.o.polish) return Phase::narrow_lps;
    if (s.out.report.stop_reason == JAM_STOP_NONE) stop(s, JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
    return Phase::done;
  }
  s.out.contacts = make_contacts(s.out.packing, s.last.pairs, s.last.answer, s.last.active);
  if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;
  if (s.o.polish && !polish_contacts(s)) return Phase::done;
  if (s.o.polish && !s.found.polished && !converged(s)) {
    s.next.gain_tolerance = default_crunch_options().gain_tolerance;
    return Phase::approach;
  }
  if (s.o.polish && !s.found.polished && s.found.narrow == Verdicts::Narrow::none) return Phase::narrow_lps;
  return decide_jamming(s);
}

}  // namespace jam
