// See certificate.hpp.
#include "network/certificate.hpp"
#include "core/pair_rule.hpp"
#include "network/constraint_rows.hpp"
#include "network/tuning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <utility>

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

int32_t verdict_code(Verdict verdict) {
  return verdict == Verdict::yes ? JAM_VERDICT_YES : verdict == Verdict::no ? JAM_VERDICT_NO : JAM_VERDICT_UNDECIDED;
}

void report_verdict(const PackingVerdict &v, const Packing &p, jam_crunch_report &report) {
  report.jammed = v.result.jammed == Verdict::yes;
  report.stationary = v.result.stressed == Verdict::yes;
  report.strictly_jammed = JAM_VERDICT_UNTESTED;
  report.flexes = v.result.flexes;
  report.zero_force_contacts = v.result.zero_force_contacts;
  report.undecided_contacts = v.undecided_contacts;
  report.undercoordinated = v.result.undercoordinated;
  report.strict_contacts_needed = strict_contacts_needed(v.result.spheres, p);
  report.rigidity_margin = v.result.margin;
}

namespace {

std::string why_undecided(const PackingVerdict &v) {
  char line[320];
  double widest = 0.0;
  for (const double h : v.contacts.gap) widest = std::max(widest, h);
  const auto pairs = static_cast<long long>(v.undecided_contacts);
  if (v.undecided_contacts > 0 && v.when_closed != v.result.jammed)
    std::snprintf(line, sizeof line,
                  "undecided: %lld pairs, open by 1e-10 to %.1e, may be contacts or not; with them closed the packing "
                  "would%s be jammed",
                  pairs, widest,
                  v.when_closed == Verdict::yes  ? ""
                  : v.when_closed == Verdict::no ? " not"
                                                 : " perhaps");
  else if (v.result.contacts == 0)
    std::snprintf(
        line, sizeof line,
        "undecided: doubles do not resolve which of the %zu closed pairs carry force, as some forces are too weak; "
        "the network is left empty",
        v.contacts.size());
  else if (v.result.flexes > 0)
    std::snprintf(line, sizeof line,
                  "undecided: %lld motions keep the contacts closed; whether other pairs or the curvature of a round "
                  "wall stop them is left open",
                  static_cast<long long>(v.result.flexes));
  else if (v.unresolved > 0.0)
    std::snprintf(
        line, sizeof line,
        "undecided, a saddle: contacts with forces of %.1e do not close together with all others, and without "
        "them spheres can move",
        v.unresolved);
  else if (v.result.spheres == 1)
    std::snprintf(line, sizeof line, "undecided: only own images fix sphere and cell, and not in every strain");
  else
    std::snprintf(line, sizeof line,
                  "undecided: doubles do not resolve a flex from a soft mode here, or a weak force from none (smallest "
                  "eigenvalue %.1e, force residual %.1e)",
                  v.result.margin, v.result.force_residual);
  return line + v.unresolved_because;
}

}  // namespace

std::string why_not_jammed(const PackingVerdict &v, Jamming kind) {
  char line[320];
  const bool strict = kind == Jamming::strict;
  const auto number = [](int64_t x) { return static_cast<long long>(x); };
  if (v.result.jammed == Verdict::yes) return "";
  if (v.result.jammed == Verdict::undecided) return why_undecided(v);
  if (v.result.slides > 0)
    std::snprintf(
        line, sizeof line,
        "forces balance on %lld contacts, so the diameters cannot grow, but parts of the network slide past each "
        "other in %lld way%s that keep%s all distances",
        number(v.result.contacts), number(v.result.slides), v.result.slides == 1 ? "" : "s",
        v.result.slides == 1 ? "s" : "");
  else if (v.result.flexes > 0)
    std::snprintf(line, sizeof line,
                  "a saddle: forces balance on %lld contacts%s, and yet %lld motions%s keep them closed",
                  number(v.result.contacts), strict ? " with an isotropic stress" : "", number(v.result.flexes),
                  strict ? " of spheres and cell" : "");
  else
    std::snprintf(line, sizeof line,
                  "no non-negative forces on the %zu closed pairs balance%s, so a motion%s opens them",
                  v.contacts.size(), strict ? " with an isotropic stress" : "", strict ? " of spheres and cell" : "");
  return line;
}

}  // namespace jam::inside
