#include "verdict/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair_rule.hpp"
#include "network/flex.hpp"
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

}  // namespace

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
