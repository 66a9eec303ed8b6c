#include "network/contact_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/double_double.hpp"
#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "network/constraint_rows.hpp"
#include "network/resolution.hpp"
#include "network/tuning.hpp"

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

double add_contact(const Packing &p, const PairList &pairs, size_t k, ContactNetwork &net) {
  const int d = p.dim;
  double r[JAM_MAX_DIM];
  const double length = std::sqrt(pair_vector(p, pairs, k, r));
  net.pairs.append(pairs, k);
  for (int c = 0; c < d; ++c) net.vector.push_back(r[c] / length);
  net.gap.push_back(length / contact_distance(p, pairs.i[k], pairs.j[k]) - 1.0);
  return length;
}

void measure_contacts(const Packing &p, ContactNetwork &net) {
  const int d = p.dim;
  DoubleDouble r[JAM_MAX_DIM];
  net.vector.resize(net.size() * d), net.gap.resize(net.size());
  for (size_t k = 0; k < net.size(); ++k) {
    const int32_t i = net.pairs.i[k], j = net.pairs.j[k];
    if (net.pairs.wall(k)) {
      const double *x = &p.position[static_cast<size_t>(i) * d];
      p.container[wall_partner(j)].normal(x, &net.vector[k * d]);
      const DoubleDouble radius = contact_distance<DoubleDouble>(p, i, j);
      net.gap[k] = static_cast<double>((p.container[wall_partner(j)].distance<DoubleDouble>(x) - radius) / radius);
      continue;
    }
    const double *a = &p.position[static_cast<size_t>(i) * d], *b = &p.position[static_cast<size_t>(j) * d];
    DoubleDouble r2;
    for (int c = 0; c < d; ++c) {
      r[c] = two_sum(a[c], -b[c]) + net.pairs.offset[k * d + c];
      r2 = r2 + r[c] * r[c];
    }
    const DoubleDouble length = square_root(r2), sigma = contact_distance<DoubleDouble>(p, i, j);
    for (int c = 0; c < d; ++c) net.vector[k * d + c] = static_cast<double>(r[c] / length);
    net.gap[k] = static_cast<double>((length - sigma) / sigma);
  }
}

ContactNetwork unforced_pairs(const Packing &p, double reach, double slope) {
  return unforced_network(p, find_pairs(p, reach, slope));
}

ContactNetwork unforced_network(const Packing &p, PairList pairs) {
  ContactNetwork out;
  out.pairs = std::move(pairs);
  measure_contacts(p, out);
  out.coordination.assign(p.n(), 0);
  out.force.assign(out.size(), 0.0);
  return out;
}

void set_force_scale(const Packing &p, ContactNetwork &net) {
  double sum = 0.0;
  for (size_t k = 0; k < net.size(); ++k)  // sigma^2 / r = sigma / (1 + h)
    sum += net.force[k] * contact_distance(p, net.pairs.i[k], net.pairs.j[k]) / (1.0 + net.gap[k]);
  net.force_scale = sum > 0.0 ? 1.0 / sum : 0.0;
}

std::vector<double> wall_stress(const Packing &p, const ContactNetwork &net) {
  std::vector<double> out(static_cast<size_t>(p.container.count()), 0.0);
  double virial = 0.0;
  for (size_t k = 0; k < net.force.size(); ++k) {
    virial += net.force[k] * contact_distance(p, net.pairs.i[k], net.pairs.j[k]) * (1.0 + net.gap[k]);
    if (net.pairs.wall(k)) out[static_cast<size_t>(wall_partner(net.pairs.j[k]))] += net.force[k];
  }
  for (size_t w = 0; w < out.size(); ++w)
    out[w] = virial > 0.0 ? out[w] / p.container[static_cast<int>(w)].area() * p.dim * p.container.volume() / virial
                          : std::nan("");
  return out;
}

std::vector<double> stress_tensor(const Packing &p, const ContactNetwork &net) {
  const size_t d = static_cast<size_t>(p.dim);
  std::vector<double> sum(d * d, 0.0);
  double virial = 0.0, unit = std::nan("");
  for (size_t k = 0; k < net.size(); ++k) {
    const double r = contact_distance(p, net.pairs.i[k], net.pairs.j[k]) * (1.0 + net.gap[k]), w = net.force[k] * r;
    virial += w;
    if (std::isnan(unit) && !net.prestress.empty() && !net.pairs.wall(k) && net.force[k] > 0.0)
      unit = net.prestress[k] * r / net.force[k];
    for (size_t a = 0; a < d; ++a)
      for (size_t b = 0; b < d; ++b) sum[d * a + b] += w * (net.vector[d * k + a] * net.vector[d * k + b]);
  }
  const double factor = net.prestress.empty() ? static_cast<double>(d) / virial : unit / scene_volume(p);
  for (double &x : sum) x *= factor;
  return sum;
}

std::vector<std::pair<size_t, size_t>> common_contacts(const ContactNetwork &a, const ContactNetwork &b) {
  std::multimap<std::pair<int32_t, int32_t>, size_t> left;
  for (size_t k = 0; k < a.size(); ++k) left.emplace(std::make_pair(a.pairs.i[k], a.pairs.j[k]), k);
  std::vector<std::pair<size_t, size_t>> out;
  for (size_t q = 0; q < b.size(); ++q) {
    const auto at = left.find({b.pairs.i[q], b.pairs.j[q]});
    if (at == left.end()) continue;
    out.emplace_back(at->second, q);
    left.erase(at);
  }
  return out;
}

int64_t stable_spheres(const std::vector<int32_t> &coordination) {
  return std::count_if(coordination.begin(), coordination.end(), [](int32_t z) { return z > 0; });
}

int64_t excess_contacts(const ContactNetwork &net, const Packing &p) {
  return static_cast<int64_t>(net.size()) - isostatic_contacts(stable_spheres(net.coordination), p.dim, p.container);
}

ContactNetwork subset(const ContactNetwork &net, const std::vector<char> &on, int dim) {
  ContactNetwork out;
  out.force_scale = net.force_scale;
  out.coordination.assign(net.coordination.size(), 0);
  for (size_t k = 0; k < on.size(); ++k) {
    if (!on[k]) continue;
    for_spheres(net.pairs.i[k], net.pairs.j[k], [&](int32_t i) { ++out.coordination[i]; });
    out.pairs.append(net.pairs, k);
    out.vector.insert(out.vector.end(), &net.vector[k * dim], &net.vector[k * dim] + dim);
    out.gap.push_back(net.gap[k]), out.force.push_back(net.force[k]);
    if (!net.stiffness.empty()) out.stiffness.push_back(net.stiffness[k]), out.prestress.push_back(net.prestress[k]);
  }
  return out;
}

// A lattice vector has a component of its length / sqrt(d) at least.
ContactLookup::ContactLookup(const Packing &p, const ContactNetwork &net)
    : net_(net), dim_(p.dim), apart_(0.5 * p.cell.shortest() / std::sqrt(static_cast<double>(p.dim))) {}

bool ContactLookup::holds(const PairList &pairs, size_t k) {
  const auto pair = std::make_pair(pairs.i[k], pairs.j[k]);
  const auto key = [this](size_t q) { return std::make_pair(net_.pairs.i[q], net_.pairs.j[q]); };
  while (at_ < net_.size() && key(at_) < pair) ++at_;
  for (size_t q = at_; q < net_.size() && key(q) == pair; ++q) {
    const double *a = &net_.pairs.offset[q * dim_], *b = &pairs.offset[k * dim_];
    if (std::equal(a, a + dim_, b, [this](double x, double y) { return std::fabs(x - y) < apart_; })) return true;
  }
  return false;
}

ContactNetwork unlisted_own_images(const Packing &p, const ContactNetwork &net, double limit) {
  if (p.cell.shortest() > (1.0 + limit) * diameter_max(p)) return {};
  const ContactNetwork own = unforced_pairs(p, 0.0, 1.0 + limit);
  ContactLookup known(p, net);
  std::vector<char> on(own.size(), 0);
  for (size_t k = 0; k < own.size(); ++k)
    on[k] = !known.holds(own.pairs, k) && own.pairs.own_image(k) && own.gap[k] < limit;
  return subset(own, on, p.dim);
}

ContactNetwork unlisted_own_images(const Packing &p, const ContactNetwork &net) {
  if (!net.stiffness.empty()) return {};
  double widest = contact_gap_limit;
  for (const double h : net.gap) widest = std::max(widest, h);
  return unlisted_own_images(p, net, widest);
}

void refuse_own_images(const ContactNetwork &own, const char *quantity) {
  if (own.size() == 0) return;
  fail(
      JAM_E_UNSUPPORTED,
      "%s would be wrong: sphere %d touches its own image, and the network of a fixed cell omits this contact, as such "
      "a cell does not determine its force. Crunch with strain=free, which lists it, or use more spheres a cell: "
      "jam_tile, then jam_contacts_from_geometry",
      quantity, own.pairs.i[0]);
}

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
