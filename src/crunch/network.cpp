// Which pairs of an LP carry force, which spheres rattle.
#include <algorithm>
#include <cmath>

#include "core/pair_rule.hpp"
#include "crunch/crunch.hpp"

namespace jam {

// Far below the narrowest gap between spheres that do not touch, above what an LP leaves open of a contact.
constexpr double shut = 1e-11;

// At a strictly complementary optimum either the force or the gap is zero; compare them in their own units: y times
// the number of carrying pairs (about d n) is a force over the mean force, w a relative gap (times two). In a
// hyperstatic packing the multipliers are not unique and a solver at a vertex leaves some at zero: there a gap of
// nothing counts.
std::vector<char> force_carrying(const PackingLp &lp, const LpSolution &x) {
  std::vector<char> on(lp.rows());
  const double carrying = static_cast<double>(lp.dim) * static_cast<double>(lp.n);
  for (size_t k = 0; k < on.size(); ++k) on[k] = x.y[k] * carrying > std::max(x.w[k], 1e-9) || x.w[k] < shut;
  return on;
}

Network find_network(const PackingLp &lp, const LpSolution &x) {
  const PairList &pairs = *lp.pairs;
  const size_t n = lp.n, rows = lp.rows();
  Network net;
  net.stable.assign(n, 1);
  net.contacts.assign(n, 0);
  std::vector<char> on = force_carrying(lp, x);
  std::vector<std::vector<size_t>> of(n);
  for (size_t k = 0; k < rows; ++k) {
    if (!on[k] || pairs.i[k] == pairs.j[k]) continue;
    of[pairs.i[k]].push_back(k);
    of[pairs.j[k]].push_back(k);
  }
  std::vector<int32_t> queue;
  for (size_t i = 0; i < n; ++i) {
    net.contacts[i] = static_cast<int32_t>(of[i].size());
    if (net.contacts[i] < lp.dim + 1) queue.push_back(static_cast<int32_t>(i)), net.stable[i] = 0;
  }
  while (!queue.empty()) {
    const int32_t i = queue.back();
    queue.pop_back();
    net.contacts[i] = 0;
    for (const size_t k : of[i]) {
      if (!on[k]) continue;
      on[k] = 0;
      const int32_t j = pairs.i[k] == i ? pairs.j[k] : pairs.i[k];
      if (net.stable[j] && --net.contacts[j] < lp.dim + 1) queue.push_back(j), net.stable[j] = 0;
    }
  }
  for (size_t k = 0; k < rows; ++k)
    if (on[k] && net.stable[pairs.i[k]]) net.active.push_back(k);
  net.stable_count = std::count(net.stable.begin(), net.stable.end(), 1);
  return net;
}

double largest_step(const LpSolution &x, const Network &net, int dim) {
  std::vector<double> mean(dim, 0.0);
  const bool any = net.stable_count > 0;
  for (size_t i = 0; i < net.stable.size() && any; ++i)
    for (int c = 0; c < dim && net.stable[i]; ++c) mean[c] += x.s[i * dim + c] / static_cast<double>(net.stable_count);
  double largest = 0.0;
  for (size_t i = 0; i < net.stable.size(); ++i) {
    if (any && !net.stable[i]) continue;
    double s2 = 0.0;
    for (int c = 0; c < dim; ++c) s2 += (x.s[i * dim + c] - mean[c]) * (x.s[i * dim + c] - mean[c]);
    largest = std::max(largest, s2);
  }
  return std::sqrt(largest);
}

ContactNetwork make_contacts(const Packing &p, const PairList &pairs, const LpSolution &x, const Network &net) {
  ContactNetwork out;
  const int d = p.dim;
  out.coordination = net.contacts;
  double r[JAM_MAX_DIM], sum = 0.0;
  for (const size_t k : net.active) {
    const int32_t i = pairs.i[k], j = pairs.j[k];
    out.pairs.i.push_back(i);
    out.pairs.j.push_back(j);
    out.pairs.offset.insert(out.pairs.offset.end(), &pairs.offset[k * d], &pairs.offset[k * d] + d);
    const double r2 = pair_vector(p, pairs, k, r);
    const double length = std::sqrt(r2), sigma = contact_distance(p, i, j);
    for (int c = 0; c < d; ++c) out.vector.push_back(r[c] / length);
    out.gap.push_back(length / sigma - 1.0);
    out.force.push_back(x.y[k] / (sigma * sigma) * length);
    sum += out.force.back();
  }
  out.force_scale = out.size() ? sum / static_cast<double>(out.size()) : 0.0;
  for (double &f : out.force) f /= out.force_scale;
  return out;
}

}  // namespace jam
