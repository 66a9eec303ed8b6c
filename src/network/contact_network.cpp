#include "network/contact_network.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/double_double.hpp"
#include "core/pair_rule.hpp"

namespace jam::inside {

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
  ContactNetwork out;
  out.pairs = find_pairs(p, reach, slope);
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

}  // namespace jam::inside
