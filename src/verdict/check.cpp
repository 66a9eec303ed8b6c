#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "core/pairs.hpp"
#include "network/flex.hpp"
#include "network/tuning.hpp"
#include "verdict/text.hpp"
#include "verdict/tuning.hpp"

namespace jam::inside {
namespace {

double length_needed(const Packing &p, const ContactNetwork &carrying) {
  double open = std::numeric_limits<double>::epsilon();
  for (const double gap : carrying.gap) open = std::max(open, std::fabs(gap));
  return std::sqrt(open) * diameter_mean(p);
}

// Displacements of all spheres by the flex of v.
std::vector<double> displacements(const Packing &p, const PackingVerdict &v) {
  const auto d = static_cast<std::ptrdiff_t>(p.dim);
  std::vector<double> x(p.position.size(), 0.0);
  for (size_t i = 0; i < v.sphere.size(); ++i)
    std::copy_n(v.result.flex.begin() + static_cast<std::ptrdiff_t>(i) * d, d, x.begin() + v.sphere[i] * d);
  return x;
}

// Whether the flex closes a pair within this length.
bool closes(const Packing &p, const ContactNetwork &near, double length, const PackingVerdict &v) {
  const size_t d = static_cast<size_t>(p.dim);
  const std::vector<double> &strain = v.result.strain, x = displacements(p, v);
  for (size_t k = 0; k < near.size(); ++k) {
    const int32_t i = near.pairs.i[k], j = near.pairs.j[k];
    const double sigma = contact_distance(p, i, j), distance = (1.0 + near.gap[k]) * sigma, *n = &near.vector[k * d];
    double closing = 0.0;
    for (size_t c = 0; c < d; ++c) {
      double w = x[i * d + c] - (near.pairs.wall(k) ? 0.0 : x[j * d + c]);
      for (size_t q = 0; q < d && !strain.empty(); ++q) w += strain[c * d + q] * distance * n[q];
      closing -= n[c] * w;
    }
    if (near.gap[k] * sigma < closing * length) return true;
  }
  return false;
}

void refuse_soft(const Packing &p, const ClosestPair &closest) {
  if (!(closest.gap < -0.5)) return;
  if (closest.j < 0)
    fail(JAM_E_OVERLAP, "sphere %d overlaps %s by %.3g of its radius: this is no packing of hard spheres", closest.i,
         p.container[wall_partner(closest.j)].name().c_str(), -closest.gap);
  if (closest.gap == -1.0)
    fail(JAM_E_OVERLAP, "spheres %d and %d have the same centre: this is no packing of hard spheres", closest.i,
         closest.j);
  fail(JAM_E_OVERLAP, "spheres %d and %d overlap by %.3g of their contact distance: this is no packing of hard spheres",
       closest.i, closest.j, -closest.gap);
}

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

// That the worst pair overlaps says that gaps are known no better.
TestedPacking without_overlaps(const Packing &p) {
  TestedPacking out{p, gap_resolution(p)};
  const ClosestPair closest = closest_contact(p);
  out.nearest_gap = closest.gap;
  out.packing.overlap_allowed = false;
  if (!(closest.gap < -contact_gap_limit)) return out;
  refuse_soft(p, closest);
  const double overlap = -closest.gap * contact_distance(p, closest.i, closest.j);
  out.overlapping =
      -closest.gap > undecided_gap_limit && overlap > out.resolution.reach(contact_distance(p, closest.i, closest.j));
  out.resolution.error = std::max(out.resolution.error, overlap);
  out.resolution.shrunk = -closest.gap;
  out.diameter_factor = 1.0 + closest.gap;
  for (double &sigma : out.packing.diameter) sigma *= out.diameter_factor;
  return out;
}

ContactNetwork blocking_pairs(const Packing &p, const ContactNetwork &carrying, const ContactNetwork &taken,
                              bool strain, bool own_images) {
  const double strained = strain ? VerdictTuning::strained * diameter_max(p) / diameter_mean(p) : 0.0;
  const ContactNetwork near = unforced_pairs(p, (2.0 + strained) * length_needed(p, carrying), 1.0);
  ContactLookup known(p, taken);
  std::vector<char> on(near.size());
  for (size_t k = 0; k < near.size(); ++k)
    on[k] = !known.holds(near.pairs, k) && (own_images || !near.pairs.own_image(k));
  return subset(near, on, p.dim);
}

bool find_unblocked_flex(const Packing &p, const std::vector<char> &taken, Jamming kind, PackingVerdict &v) {
  ContactNetwork carrying = v.carrying(p.dim), all = subset(v.contacts, taken, p.dim);
  const ContactNetwork near = blocking_pairs(p, carrying, all, kind == Jamming::strict, kind == Jamming::strict);
  if (!closes(p, near, length_needed(p, carrying), v)) return true;
  for (size_t k = 0; k < near.size(); ++k) add_contact(p, near.pairs, k, all);
  all.force.clear();
  const RigidityMatrix g = make_rigidity_matrix(p, all);
  RigidityResult other = test_rigidity(g, kind);
  if (other.rigid != Verdict::no || other.flex.empty()) return false;
  v.result.flex = std::move(other.flex), v.result.strain = std::move(other.strain);
  v.sphere = g.sphere;
  return true;
}

bool leads_free(const Packing &p, const StraightMotion &motion, double length) {
  if (motion.flex.empty() || p.container.curved() != 0) return false;
  const size_t d = static_cast<size_t>(p.dim);
  const double unit = length * diameter_mean(p);
  std::vector<double> x(p.position.size(), 0.0);
  for (size_t k = 0; k < motion.flex.size(); ++k)
    x[static_cast<size_t>(motion.sphere[k / d]) * d + k % d] = unit * motion.flex[k];
  const double strained = motion.strain.empty() ? 0.0 : VerdictTuning::strained * diameter_max(p) / diameter_mean(p);
  const ContactNetwork near = unforced_pairs(p, (2.0 + strained) * unit, 1.0);
  for (size_t k = 0; k < near.size(); ++k) {
    const int32_t i = near.pairs.i[k], j = near.pairs.j[k];
    const bool wall = near.pairs.wall(k);
    const double sigma = contact_distance(p, i, j), distance = (1.0 + near.gap[k]) * sigma;
    double along = 0.0, all = 0.0;
    for (size_t c = 0; c < d; ++c) {
      double w = x[static_cast<size_t>(i) * d + c] - (wall ? 0.0 : x[static_cast<size_t>(j) * d + c]);
      for (size_t q = 0; q < d && !motion.strain.empty(); ++q)
        w += unit * motion.strain[c * d + q] * distance * near.vector[k * d + q];
      along += w * near.vector[k * d + c], all += w * w;
    }
    if (wall) all = along * along;
    // |r + t w|^2 is least at this t of 0 to 1.
    const double t = all > 0.0 ? std::min(1.0, std::max(0.0, -distance * along / all)) : 0.0;
    const double least = distance * distance + t * (2.0 * distance * along + t * all);
    const double allowed = sigma * (1.0 + std::min(0.0, near.gap[k]) - VerdictTuning::rounding_of_a_motion);
    if (least < allowed * allowed) return false;
  }
  return true;
}

double unblocked_fraction(const Packing &p, const PackingVerdict &v) {
  std::vector<char> touches;
  for (const double gap : v.contacts.gap) touches.push_back(gap < contact_gap_limit);
  const ContactNetwork net = subset(v.contacts, touches, p.dim);
  const RigidityMatrix g = make_rigidity_matrix(p, net);
  const auto d = static_cast<std::ptrdiff_t>(p.dim);
  const std::vector<double> all = displacements(p, v);
  std::vector<double> flex, strain = v.result.strain;
  for (const int32_t i : g.sphere) flex.insert(flex.end(), all.begin() + i * d, all.begin() + (i + 1) * d);
  const double least = length_needed(p, v.carrying(p.dim)) / diameter_mean(p);
  for (double part = 1.0; part > least; part *= VerdictTuning::shorter_flex) {
    if (keeps_contacts(g, net.gap, flex, strain)) return part;
    for (double &x : flex) x *= VerdictTuning::shorter_flex;
    for (double &x : strain) x *= VerdictTuning::shorter_flex;
  }
  return 0.0;
}

}  // namespace jam::inside
