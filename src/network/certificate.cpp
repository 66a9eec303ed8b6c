// See certificate.hpp.
#include "network/certificate.hpp"
#include "core/pair_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace jam {
namespace {

// Smallest gap of two stable spheres that are no contact: the pairs of `net` are skipped image by image.
void scan_gaps(const Packing &p, const ContactNetwork &net, bool own_images, jam_crunch_report &report) {
  double r[JAM_MAX_DIM];
  report.min_gap = std::numeric_limits<double>::infinity();
  report.max_overlap = 0.0;
  for (const double slope : {1.2, 2.0}) {
    const PairList pairs = find_pairs(p, 0.0, slope);
    ContactLookup contacts(p, net);
    for (size_t k = 0; k < pairs.size(); ++k) {
      const int32_t i = pairs.i[k], j = pairs.j[k];
      const double gap = std::sqrt(pair_vector(p, pairs, k, r)) / contact_distance(p, i, j) - 1.0;
      report.max_overlap = std::max(report.max_overlap, -gap);
      if (!contacts.holds(pairs, k) && (own_images || !pairs.own_image(k)) && net.coordination[i] > 0 &&
          net.coordination[j] > 0)
        report.min_gap = std::min(report.min_gap, gap);
    }
    if (std::isfinite(report.min_gap)) return;
  }
}

}  // namespace

void certify(const Packing &p, const ContactNetwork &net, jam_crunch_report &report, bool free_cell) {
  const int d = p.dim;
  report.packing_fraction = packing_fraction(p);
  report.diameter_mean = diameter_mean(p);
  report.contacts = static_cast<int64_t>(net.size());
  report.rattlers = report.bucklers = 0;
  for (const int32_t z : net.coordination) {
    report.rattlers += z == 0;
    report.bucklers += z == d + 1;
  }
  report.stable = static_cast<int64_t>(p.n()) - report.rattlers;
  report.isostatic_contacts = report.stable > 0 ? d * (report.stable - 1) + 1 : 0;
  report.excess_contacts = report.contacts - report.isostatic_contacts;
  report.force_residual = balance_residual(p.dim, p.n(), net);
  report.min_force = net.size() ? *std::min_element(net.force.begin(), net.force.end()) : 0.0;
  report.max_contact_gap = 0.0;
  for (const double h : net.gap) report.max_contact_gap = std::max(report.max_contact_gap, std::fabs(h));
  report.force_scale = net.force_scale;
  scan_gaps(p, net, free_cell, report);
  report.strictly_jammed = JAM_VERDICT_UNTESTED;
  report.strict_contacts_needed = report.stable > 0 ? d * (report.stable - 1) + d * (d + 1) / 2 : 0;
}

int32_t verdict_code(Verdict verdict) {
  return verdict == Verdict::yes ? JAM_VERDICT_YES : verdict == Verdict::no ? JAM_VERDICT_NO : JAM_VERDICT_UNDECIDED;
}

void report_verdict(const PackingVerdict &v, int d, jam_crunch_report &report) {
  report.jammed = v.result.jammed == Verdict::yes;
  report.stationary = v.result.stressed == Verdict::yes;
  report.strictly_jammed = JAM_VERDICT_UNTESTED;
  report.flexes = v.result.flexes;
  report.idle_contacts = v.result.idle_contacts;
  report.undecided_contacts = v.undecided_contacts;
  report.bridges = v.result.bridges;
  report.strict_contacts_needed = v.result.spheres > 0 ? d * (v.result.spheres - 1) + d * (d + 1) / 2 : 0;
  report.rigidity_margin = v.result.margin;
}

void certify_jamming(const Packing &p, const ContactNetwork &contacts, jam_crunch_report &report,
                     const CancellationPoint &cancel_point) {
  report_verdict(test_packing(p, &contacts, Jamming::collective, cancel_point), p.dim, report);
}

}  // namespace jam
