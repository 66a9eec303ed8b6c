// See certificate.hpp.
#include "network/certificate.hpp"
#include "core/pair_rule.hpp"
#include "network/constraint_rows.hpp"
#include "network/tuning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jam::inside {
namespace {

// Smallest gap of two stable spheres that are no contact: the pairs of `net` are skipped image by image.
void scan_gaps(const Packing &p, const ContactNetwork &net, bool own_images, jam_crunch_report &report) {
  double r[JAM_MAX_DIM];
  report.min_gap = std::numeric_limits<double>::infinity();
  report.max_overlap = 0.0;
  const bool stable = std::any_of(net.coordination.begin(), net.coordination.end(), [](int32_t z) { return z > 0; });
  const std::vector<double> slopes = stable ? std::vector<double>(std::begin(gap_searches), std::end(gap_searches))
                                            : std::vector<double>{1.0};  // overlaps
  for (const double slope : slopes) {
    const PairList pairs = find_pairs(p, 0.0, slope);
    ContactLookup contacts(p, net);
    for (size_t k = 0; k < pairs.size(); ++k) {
      const int32_t i = pairs.i[k], j = pairs.j[k];
      const double gap = std::sqrt(pair_vector(p, pairs, k, r)) / contact_distance(p, i, j) - 1.0;
      report.max_overlap = std::max(report.max_overlap, -gap);
      if (!contacts.holds(pairs, k) && (own_images || !pairs.own_image(k)) && net.coordination[i] > 0 &&
          (j < 0 || net.coordination[j] > 0))
        report.min_gap = std::min(report.min_gap, gap);
    }
    if (std::isfinite(report.min_gap)) return;
  }
}

}  // namespace

static int64_t strict_contacts_needed(int64_t stable, const Packing &p) {
  return isostatic_contacts(stable, p.dim, p.container) +
         (stable > 0 ? traceless_strains(p.dim, ~p.container.closed()) : 0);
}

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
  report.isostatic_contacts = isostatic_contacts(report.stable, d, p.container);
  report.excess_contacts = report.contacts - report.isostatic_contacts;
  report.force_residual = balance_residual(p.dim, p.n(), net);
  report.min_force = net.size() ? *std::min_element(net.force.begin(), net.force.end()) : 0.0;
  report.max_contact_gap = 0.0;
  for (const double h : net.gap) report.max_contact_gap = std::max(report.max_contact_gap, std::fabs(h));
  report.force_scale = net.force_scale;
  scan_gaps(p, net, free_cell, report);
  report.strictly_jammed = JAM_VERDICT_UNTESTED;
  report.strict_contacts_needed = strict_contacts_needed(report.stable, p);
  report.packing_fraction_start = report.displacement_max = report.displacement_rms = report.displacement_max_stable =
      report.displacement_rms_stable = std::numeric_limits<double>::quiet_NaN();
  report.contacts_start = report.contacts_kept = -1;
  report.theorem = JAM_THEOREM_NONE, report.proof_cause = JAM_CAUSE_NONE;
  report.proof_radius = std::numeric_limits<double>::infinity();
  report.proof_value = report.proof_bound = 0.0;
}

}  // namespace jam::inside
