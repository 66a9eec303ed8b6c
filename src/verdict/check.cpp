// See check.hpp.
#include "verdict/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair_rule.hpp"
#include "network/constraint_rows.hpp"
#include "network/tuning.hpp"
#include "verdict/text.hpp"

namespace jam::inside {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Closed pairs, and the smallest gap between stable spheres of one that is not closed.
void scan_pairs(const Packing &p, const std::vector<int32_t> &coordination, jam_check_report &r) {
  double v[JAM_MAX_DIM];
  r.min_gap = nan;
  for (const double slope : gap_searches) {
    const PairList pairs = find_pairs(p, 0.0, slope);
    r.closed_pairs = 0;
    for (size_t k = 0; k < pairs.size(); ++k) {
      const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
      const double gap = std::sqrt(pair_vector(p, pairs, k, v)) / sigma - 1.0;
      if (gap < contact_gap_limit)
        ++r.closed_pairs;
      else if (coordination[pairs.i[k]] > 0 && (pairs.wall(k) || coordination[pairs.j[k]] > 0) && !(gap >= r.min_gap))
        r.min_gap = gap;
    }
    if (std::isfinite(r.min_gap)) return;
  }
}

void report_network(const Packing &p, const PackingVerdict &v, const ContactNetwork &net, jam_check_report &r) {
  r.contacts = static_cast<int64_t>(net.size());
  r.rattlers = static_cast<int64_t>(p.n()) - stable_spheres(net.coordination);
  r.excess_contacts = excess_contacts(net, p);
  if (net.size()) r.strict_excess_contacts = r.excess_contacts - traceless_strains(p.dim, ~p.container.closed());
  report_counts(v, r);
  r.self_stresses = v.result.self_stresses;
  r.stationary = verdict_code(v.result.stressed);
  r.force_residual = net.size() ? v.result.force_residual : nan;
  if (net.size() == 0) r.rigidity_margin = nan;
  r.curvature_margin = v.result.curvature;
  r.max_contact_gap = net.size() ? 0.0 : nan;
  for (const double h : net.gap) r.max_contact_gap = std::max(r.max_contact_gap, std::fabs(h));
  scan_pairs(p, net.coordination, r);
}

}  // namespace

jam_check_report blank_report() {
  jam_check_report r{};
  r.jammed = r.strictly_jammed = r.stationary = r.crunch_jammed = JAM_VERDICT_UNTESTED;
  r.reason = JAM_CHECK_MARGIN;
  r.crunch_contacts = -1;
  r.packing_fraction = r.nearest_gap = r.min_gap = r.max_contact_gap = r.force_residual = r.rigidity_margin = nan;
  r.resolution = r.diameter_factor = nan;
  r.crunch_packing_fraction = r.crunch_displacement_max = r.crunch_displacement_rms = nan;
  return r;
}

CheckResult check_as_it_is(const Packing &p, const ContactNetwork *known) {
  CheckResult out;
  jam_check_report &r = out.report;
  r = blank_report();
  r.dim = p.dim, r.n = static_cast<int64_t>(p.n());
  r.packing_fraction = packing_fraction(p);
  out.tested = without_overlaps(p);
  const Packing &q = out.tested.packing;
  const GapResolution &resolution = out.tested.resolution;
  r.nearest_gap = out.tested.nearest_gap, r.diameter_factor = out.tested.diameter_factor;
  r.digits = resolution.digits(p), r.coordinate_step = resolution.step, r.resolution = resolution.relative(p);
  JammingTest test(out.tested, known);
  const PackingVerdict &verdict = test.verdict(Jamming::collective);
  out.carrying = verdict.carrying(q.dim);
  report_network(q, verdict, out.carrying, r);
  r.strictly_jammed = JAM_VERDICT_NO;
  // Where no forces balance on the spheres none do on the cell. Own images alone may hold both.
  if (verdict.jammed != Verdict::no || verdict.result.stressed != Verdict::no || may_touch_own_image(q, resolution)) {
    const PackingVerdict &strict = test.verdict(Jamming::strict);
    r.strictly_jammed = verdict_code(strict.jammed);
    r.strict_flexes = strict.result.flexes;
    if (strict.jammed == Verdict::yes)  // own images among them, which a fixed cell does not count
      r.strict_excess_contacts = strict.result.contacts - strict.result.contacts_needed;
  }
  r.jammed = verdict_code(verdict.jammed);
  r.reason = numbers_of(verdict, out.tested, Jamming::collective).reason;
  return out;
}

}  // namespace jam::inside
