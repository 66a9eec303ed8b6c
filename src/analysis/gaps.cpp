// Gaps, classes of contacts, sums of contact vectors.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "analysis/structure.hpp"
#include "analysis/tuning.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/pair_levels.hpp"
#include "jam/jam.h"
#include "linalg/dot.hpp"

namespace jam::inside {
namespace {

// Distributions by class: which values of a quantity belong to localised and which to extended contacts, and their
// histograms.

void check_local(const ContactNetwork &net, int32_t quantity, int32_t which) {
  check_enum(quantity, JAM_LOCAL_FORCE, JAM_LOCAL_COORDINATION, "quantity", "jam_local_quantity");
  check_enum(which, JAM_POPULATION_ALL, JAM_POPULATION_MEDIAN, "population", "jam_population");
  if (quantity == JAM_LOCAL_FORCE && net.force.size() != net.size()) fail(JAM_E_STATE, "the network has no forces");
  if (quantity != JAM_LOCAL_FORCE && (which == JAM_POPULATION_SMALLEST || which == JAM_POPULATION_MEDIAN))
    fail(JAM_E_ARGUMENT, "population is %d: smallest and median are populations of forces only", which);
}

std::vector<size_t> contacts_in(const Packing &p, const ContactNetwork &net, int32_t which) {
  std::vector<size_t> in(net.size());
  std::iota(in.begin(), in.end(), size_t{0});
  if (which == JAM_POPULATION_ALL) return in;
  const int32_t flag = which == JAM_POPULATION_SMALLEST ? JAM_CONTACT_SMALLEST
                       : which == JAM_POPULATION_MEDIAN ? JAM_CONTACT_MEDIAN
                                                        : JAM_CONTACT_LOCALISED;
  const std::vector<int32_t> flags = classify_contacts(p, net);
  const auto out = [&](size_t k) { return ((flags[k] & flag) != 0) == (which == JAM_POPULATION_EXTENDED); };
  in.erase(std::remove_if(in.begin(), in.end(), out), in.end());
  return in;
}

bool sphere_in(const Packing &p, const ContactNetwork &net, int32_t which, size_t i) {
  const int32_t z = net.coordination[i];
  return z > 0 && (which == JAM_POPULATION_ALL || (z == p.dim + 1) == (which == JAM_POPULATION_LOCALISED));
}

bool is_dot(int32_t quantity) { return quantity == JAM_LOCAL_VECTOR_DOT || quantity == JAM_LOCAL_FORCE_DOT; }

// Forces of a class over their mean.
std::vector<double> class_forces(const Packing &p, const ContactNetwork &net, int32_t which) {
  std::vector<double> out;
  for (const size_t k : contacts_in(p, net, which)) out.push_back(net.force[k]);
  double mean = 0.0;
  for (double f : out) mean += f / static_cast<double>(out.size());
  if (mean > 0.0)
    for (double &f : out) f /= mean;
  return out;
}

// One value of every sphere.
std::vector<double> sphere_values(const Packing &p, const ContactNetwork &net, int32_t quantity) {
  const bool weighted = quantity == JAM_LOCAL_FORCE_PAIRS;
  std::vector<double> out(p.n(), 0.0);
  if (quantity == JAM_LOCAL_COORDINATION) {
    std::copy(net.coordination.begin(), net.coordination.end(), out.begin());
  } else if (quantity == JAM_LOCAL_FORCE_SUM) {
    if (net.force.size() != net.size()) fail(JAM_E_STATE, "the network has no forces");
    for (size_t k = 0; k < net.size(); ++k) {
      for_spheres(net.pairs.i[k], net.pairs.j[k], [&](int32_t i) { out[i] += net.force[k]; });
    }
  } else {
    const SphereStructure t = sphere_structure(p, net, weighted);
    if (quantity != JAM_LOCAL_VECTOR_SUM) return t.s;
    for (size_t i = 0; i < out.size(); ++i) out[i] = std::sqrt(squared(&t.c[i * p.dim], p.dim));
  }
  return out;
}

// JAM_E_MEMORY with the estimate when a list of all pairs within `reach` would be unreasonably long.
void check_pair_count(const Packing &p, double reach) {
  const double ball = unit_sphere_volume(p.dim) * math::pow(2.0 * reach / p.cell.side(), p.dim),
               n = static_cast<double>(p.n());
  const double pairs = 0.5 * n * n * ball, bytes = pairs * (8.0 * p.dim + GapsTuning::bytes_a_pair);
  if (bytes > CallScope::memory_limit())
    fail(JAM_E_MEMORY, "about %.3g pairs lie within %g: their list needs %s, more than %s", pairs, reach,
         bytes_text(bytes).c_str(), bytes_text(CallScope::memory_limit()).c_str());
}

}  // namespace

PairList pairs_without_contacts(const Packing &p, const ContactNetwork *net, double h_max, bool stable_only) {
  check_pair_count(p, (1.0 + h_max) * diameter_mean(p));
  const PairList all = find_pairs(p, 0.0, 1.0 + h_max);
  PairList out;
  std::optional<ContactLookup> contacts;
  if (net) contacts.emplace(p, *net);
  SparseLook sparse_look;
  for (size_t k = 0; k < all.size(); ++k) {
    sparse_look();
    const int32_t i = all.i[k], j = all.j[k];
    if (net && stable_only && (net->coordination[i] == 0 || (j >= 0 && net->coordination[j] == 0))) continue;
    if (contacts && contacts->holds(all, k)) continue;
    out.append(all, k);
  }
  return out;
}

namespace {
PairList pairs_of_gaps(const Packing &p, const ContactNetwork *net, double h_max, bool stable_only) {
  if (!(h_max > 0.0 && h_max <= limits::radius_max))
    fail(JAM_E_ARGUMENT, "h_max is %g, it must be in (0, %g]", h_max, limits::radius_max);
  return pairs_without_contacts(p, net, h_max, stable_only);
}
}  // namespace

size_t count_gaps(const Packing &p, const ContactNetwork *net, double h_max, bool stable_only) {
  return pairs_of_gaps(p, net, h_max, stable_only).size();
}

Gaps find_gaps(const Packing &p, const ContactNetwork *net, double h_max, bool stable_only) {
  const PairList all = pairs_of_gaps(p, net, h_max, stable_only);
  std::vector<double> r(p.dim);
  std::vector<std::pair<double, size_t>> found(all.size());
  SparseLook sparse_look;
  for (size_t k = 0; k < all.size(); ++k) {
    sparse_look();
    found[k] = {std::sqrt(pair_vector(p, all, k, r.data())) / contact_distance(p, all.i[k], all.j[k]) - 1.0, k};
  }
  std::sort(found.begin(), found.end(), [&](const auto &a, const auto &b) {
    sparse_look();
    return a < b;
  });
  Gaps out;
  for (const auto &[h, k] : found) {
    sparse_look();
    out.gap.push_back(h);
    out.pair.push_back(all.i[k]);
    out.pair.push_back(all.j[k]);
  }
  return out;
}

void check_near_coordination(double h_max) {
  if (!(h_max > 0.0 && h_max <= 1.0)) fail(JAM_E_ARGUMENT, "h_max is %g, it must be in (0, 1]", h_max);
}

std::vector<int32_t> near_coordination(const Packing &p, double h_max) {
  std::vector<int32_t> z(p.n(), 0);
  visit_pairs(p, 0.0, 1.0 + h_max, [&](const PairList &near) {
    for (size_t k = 0; k < near.size(); ++k) ++z[near.i[k]], ++z[near.j[k]];
  });
  return z;
}

namespace {
// A contact as one of its spheres sees it: sign times its vector points to that sphere. An own image has both signs.
struct Side {
  size_t contact;
  double sign;
};
std::vector<std::vector<Side>> contacts_of(const Packing &p, const ContactNetwork &net) {
  std::vector<std::vector<Side>> of(p.n());
  for (size_t k = 0; k < net.size(); ++k) {
    of[net.pairs.i[k]].push_back({k, 1.0});
    if (!net.pairs.wall(k)) of[net.pairs.j[k]].push_back({k, -1.0});
  }
  return of;
}
}  // namespace

std::vector<int32_t> classify_contacts(const Packing &p, const ContactNetwork &net) {
  std::vector<int32_t> flags(net.size(), 0);
  for (size_t k = 0; k < net.size(); ++k)
    for_spheres(net.pairs.i[k], net.pairs.j[k], [&](int32_t i) {
      if (net.coordination[i] == p.dim + 1) flags[k] |= JAM_CONTACT_LOCALISED;
    });
  for (auto &of : contacts_of(p, net)) {
    if (of.empty() || net.force.empty()) continue;
    std::sort(of.begin(), of.end(), [&](const Side &x, const Side &y) {
      const double a = net.force[x.contact], b = net.force[y.contact];
      return a != b ? a < b : x.contact < y.contact;
    });
    flags[of.front().contact] |= JAM_CONTACT_SMALLEST;
    flags[of[(of.size() - 1) / 2].contact] |= JAM_CONTACT_MEDIAN;
  }
  return flags;
}

namespace {
// The vector that points to the sphere, times the force when weighted.
void seen_from(const Packing &p, const ContactNetwork &net, const Side &side, bool weighted, double *v) {
  const double scale = weighted ? side.sign * net.force[side.contact] : side.sign;
  for (int c = 0; c < p.dim; ++c) v[c] = scale * net.vector[side.contact * p.dim + c];
}
void need_forces(const ContactNetwork &net, bool weighted) {
  if (weighted && net.force.size() != net.size()) fail(JAM_E_STATE, "the network has no forces");
}
}  // namespace

SphereStructure sphere_structure(const Packing &p, const ContactNetwork &net, bool weighted) {
  need_forces(net, weighted);
  const int d = p.dim;
  SphereStructure out;
  out.c.assign(p.position.size(), 0.0);
  out.s.assign(p.n(), 0.0);
  std::vector<double> self(p.n(), 0.0), v(d);
  for (size_t k = 0; k < net.size(); ++k)
    for (const Side &side : {Side{k, 1.0}, Side{k, -1.0}}) {
      if (side.sign < 0.0 && net.pairs.wall(k)) continue;
      const size_t i = static_cast<size_t>(side.sign > 0.0 ? net.pairs.i[k] : net.pairs.j[k]);
      seen_from(p, net, side, weighted, v.data());
      for (int c = 0; c < d; ++c) {
        out.c[i * d + c] += v[c];
        self[i] += v[c] * v[c];
      }
    }
  for (size_t i = 0; i < p.n(); ++i)  // sum_{j<k} = (|C|^2 - sum_j |v_j|^2) / 2
    out.s[i] = 0.5 * (squared(&out.c[i * d], d) - self[i]);
  return out;
}

std::vector<size_t> count_contact_dots(const Packing &p, const ContactNetwork &net, bool weighted) {
  need_forces(net, weighted);
  std::vector<size_t> sides(p.n(), 0);
  for (size_t k = 0; k < net.size(); ++k) for_spheres(net.pairs.i[k], net.pairs.j[k], [&](int32_t i) { ++sides[i]; });
  for (size_t &z : sides) z = z * (z > 0 ? z - 1 : 0) / 2;
  return sides;
}

ContactDots contact_dots(const Packing &p, const ContactNetwork &net, bool weighted) {
  need_forces(net, weighted);
  ContactDots out;
  std::vector<double> a(p.dim), b(p.dim);
  const auto all = contacts_of(p, net);
  for (size_t i = 0; i < p.n(); ++i)
    for (size_t x = 0; x < all[i].size(); ++x) {
      seen_from(p, net, all[i][x], weighted, a.data());
      for (size_t y = x + 1; y < all[i].size(); ++y) {
        seen_from(p, net, all[i][y], weighted, b.data());
        double dot = 0.0;
        for (int c = 0; c < p.dim; ++c) dot += a[c] * b[c];
        out.dot.push_back(dot);
        out.sphere.push_back(static_cast<int32_t>(i));
      }
    }
  return out;
}

std::vector<double> fabric_tensor(const ContactNetwork &network, int dim) {
  const size_t d = static_cast<size_t>(dim);
  std::vector<double> out(d * d, network.size() ? 0.0 : NAN);
  for (size_t k = 0; k < network.size(); ++k)
    for (size_t a = 0; a < d; ++a)
      for (size_t b = 0; b < d; ++b)
        out[d * a + b] += network.vector[d * k + a] * network.vector[d * k + b] / static_cast<double>(network.size());
  return out;
}

size_t count_local_values(const Packing &p, const ContactNetwork &net, int32_t quantity, int32_t which) {
  check_local(net, quantity, which);
  if (quantity == JAM_LOCAL_FORCE) return contacts_in(p, net, which).size();
  std::vector<size_t> of(p.n(), 1);
  if (is_dot(quantity)) of = count_contact_dots(p, net, quantity == JAM_LOCAL_FORCE_DOT);
  size_t count = 0;
  for (size_t i = 0; i < of.size(); ++i) count += sphere_in(p, net, which, i) ? of[i] : 0;
  return count;
}

std::vector<double> local_values(const Packing &p, const ContactNetwork &net, int32_t quantity, int32_t which) {
  check_local(net, quantity, which);
  if (quantity == JAM_LOCAL_FORCE) return class_forces(p, net, which);
  const auto in = [&](size_t i) { return sphere_in(p, net, which, i); };
  std::vector<double> out;
  if (is_dot(quantity)) {
    const ContactDots dots = contact_dots(p, net, quantity == JAM_LOCAL_FORCE_DOT);
    for (size_t k = 0; k < dots.dot.size(); ++k)
      if (in(static_cast<size_t>(dots.sphere[k]))) out.push_back(dots.dot[k]);
    return out;
  }
  const std::vector<double> all = sphere_values(p, net, quantity);
  for (size_t i = 0; i < all.size(); ++i)
    if (in(i)) out.push_back(all[i]);
  return out;
}

}  // namespace jam::inside
