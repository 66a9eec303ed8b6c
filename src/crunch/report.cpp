#include "crunch/report.hpp"

#include <cmath>
#include <exception>

#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "crunch/control.hpp"
#include "network/certificate.hpp"
#include "network/resolution.hpp"
#include "verdict/text.hpp"

namespace jam::inside {

// Closed pairs as in the test of jamming, and those that digits cannot distinguish from them.
Touching find_touching(const Packing &start) {
  const GapResolution resolution = gap_resolution(start);
  const PairList pairs = find_pairs(start, resolution.reach(), 1.0 + contact_gap_limit);
  double r[JAM_MAX_DIM];
  Touching found;
  found.total = 0;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double sigma = contact_distance(start, pairs.i[k], pairs.j[k]);
    const double gap = std::sqrt(pair_vector(start, pairs, k, r)) / sigma - 1.0;
    if (!(gap < contact_gap_limit || gap * sigma < resolution.reach())) continue;
    ++found.images[{pairs.i[k], pairs.j[k]}], ++found.total;
  }
  return found;
}

void report_changes(Touching start, double packing_fraction_start, CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  r.packing_fraction_start = packing_fraction_start;
  r.contacts_start = start.total;
  r.contacts_kept = -1;
  r.displacement_max = r.displacement_rms = r.displacement_max_stable = r.displacement_rms_stable = std::nan("");
  try {
    const std::vector<int32_t> &coordination = s.out.contacts.coordination;
    s.history.displaced(s.out.packing, nullptr, r.displacement_max, r.displacement_rms);
    if (stable_spheres(coordination) > 0)
      s.history.displaced(s.out.packing, &coordination, r.displacement_max_stable, r.displacement_rms_stable);
  } catch (const std::exception &) {  // out of memory: the rest of the report is kept
  }
  if (r.rattlers < 0 || start.total < 0) return;
  r.contacts_kept = 0;
  const PairList &contacts = s.out.contacts.pairs;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const auto at = start.images.find({contacts.i[k], contacts.j[k]});
    if (at != start.images.end() && at->second > 0) --at->second, ++r.contacts_kept;
  }
}

// The cause of a status above 0. A sphere that fills a round container stands in its middle, where the wall has no
// normal, so that it has no contact; LPs get within 1e-12 to 1e-8.
static void explain(CrunchState &s) {
  const Packing &p = s.out.packing;
  const auto largest = std::max_element(p.diameter.begin(), p.diameter.end());
  const bool round = p.container.curved() != 0;
  if (s.out.status <= 0 || (p.container && !round) || s.o.strain != JAM_STRAIN_NONE ||
      *largest <
          (round ? p.container.widest() * (1.0 - undecided_gap_limit) : p.cell.shortest() * (1.0 - contact_gap_limit)))
    return;
  s.out.text = "sphere " + std::to_string(largest - p.diameter.begin()) +
               (round ? " fills the width of the container, nothing can grow here; spheres are free along its axis"
                      : " touches its own image, nothing can grow here; a free cell (strain) gives way");
  s.monitor.log(JAM_LOG_WARNING, "%s", s.out.text.c_str());
}

// The work that was done. A crunch that was stopped before an LP ended has no contacts, so rattlers are unknown.
static void report_work(CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  r.method = s.history.stage.path_taken ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP;
  r.decompressions = s.history.stage.decompressions;
  r.factorisations = s.system.factorisations;
  r.seconds = s.monitor.seconds();
  const bool unknown =
      r.stop_reason == JAM_STOP_CANCELLED || r.stop_reason == JAM_STOP_WALL_TIME || r.stop_reason == JAM_STOP_SOLVER;
  if (!unknown || s.out.contacts.size() > 0) return;
  r.rattlers = r.contacts = r.bucklers = -1, r.stable = 0;
  r.force_residual = r.min_force = r.max_contact_gap = std::numeric_limits<double>::quiet_NaN();
}

void report_end(CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  certify(s.out.packing, s.out.contacts, r, s.next.strain.count() > 0);
  r.strictly_jammed = s.found.strictly_jammed;
  const bool balanced =
      r.force_residual < (s.o.polish ? RigidityTuning::useless_residual : InteriorPointTuning::balance);
  if (s.found.verdict.jammed == Verdict::yes && !(balanced && r.min_force >= 0.0)) {
    s.found.verdict.hear(Rule::unbalanced, Verdict::undecided);
    report_verdict(s.found.verdict, r);
    stop(s, JAM_STOP_SOLVER, JAM_NOT_CONVERGED);
  }
  report_work(s);
  r.seconds_factor = s.system.seconds_factor;
  r.seconds_assemble = s.system.seconds_assemble;
  r.seconds_solve = s.system.seconds_solve;
  explain(s);
}

void report_failure(CrunchState &s) {
  wrap_positions(s.out.packing);
  ContactNetwork &c = s.out.contacts;
  c.pairs.clear(), c.vector.clear(), c.gap.clear(), c.force.clear();
  std::fill(c.coordination.begin(), c.coordination.end(), 0);
  try {
    certify(s.out.packing, c, s.out.report);
  } catch (const std::exception &) {  // out of memory, or over its limit
    s.out.report.packing_fraction = packing_fraction(s.out.packing);
  }
  report_work(s);
}

}  // namespace jam::inside
