// Distributions by class: which values of a quantity belong to localised and which to extended contacts, and their
// histograms.
#include <algorithm>
#include <cmath>
#include <numeric>
#include "analysis/structure.hpp"
#include "core/checks.hpp"
#include "core/error.hpp"
#include "jam/jam.h"

namespace jam::inside {
namespace {

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
    for (size_t i = 0; i < out.size(); ++i) {
      double c2 = 0.0;
      for (int c = 0; c < p.dim; ++c) c2 += t.c[i * p.dim + c] * t.c[i * p.dim + c];
      out[i] = std::sqrt(c2);
    }
  }
  return out;
}

}  // namespace

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
