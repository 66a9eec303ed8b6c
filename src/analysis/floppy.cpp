#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/modes.hpp"
#include "analysis/structure.hpp"
#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "linalg/dot.hpp"

namespace jam::inside {

void FloppyModes::resize(size_t m) {
  for (auto *x : {&median, &weight, &s_plus, &s_star, &stability, &s_return}) x->resize(m);
}

// The mean of the two middle values of an even number. The order of x is lost.
static double median_of(std::vector<double> &x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return x.size() % 2 ? *middle : 0.5 * (*middle + *std::max_element(x.begin(), middle));
}

FloppySolver::FloppySolver(const Packing &p, const ContactNetwork &network, const RigidityMatrix &g)
    : g_(g), space_(g) {
  const StressStates s = find_stress(g, space_, false);
  if (s.dimension != 1 || s.zero_modes != g.symmetries())
    fail(JAM_E_STATE,
         "opening one contact needs exactly one state of self-stress and %d zero modes; there are %lld and %lld",
         g.symmetries(), static_cast<long long>(s.dimension), static_cast<long long>(s.zero_modes));
  force_ = s.force;
  const size_t n = g.unknowns();
  for (size_t k = 0; k < g.contacts(); ++k) force_sigma_ += force_[k] * g.sigma[k];
  uniform_.assign(n, 0.0);
  apply_equilibrium(g, g.sigma.data(), uniform_.data());
  space_.solver().solve(uniform_.data(), 1);
  const PairList all = pairs_without_contacts(p, &network, 1.0, true);
  std::vector<double> r(p.dim);
  for (size_t k = 0; k < all.size(); ++k) {
    const int32_t a = g.node[all.i[k]], b = all.wall(k) ? all.j[k] : g.node[all.j[k]];
    if (a == b) continue;
    const double length = std::sqrt(pair_vector(p, all, k, r.data())), sigma = contact_distance(p, all.i[k], all.j[k]);
    i_.push_back(a);
    j_.push_back(b);
    for (double x : r) normal_.push_back(x / length);
    open_.push_back(std::max(0.0, length - sigma));
    sigma_.push_back(sigma);
  }
}

void FloppySolver::fields(size_t first, int count, std::vector<double> &dr) const {
  const size_t n = g_.unknowns(), d = static_cast<size_t>(g_.dim);
  dr.assign(n * count, 0.0);
  for (int q = 0; q < count; ++q)
    for (size_t c = 0; c < d; ++c) {
      const size_t k = first + q;
      dr[q * n + static_cast<size_t>(g_.a[k]) * d + c] += g_.normal[k * d + c];
      if (g_.b[k] >= 0) dr[q * n + static_cast<size_t>(g_.b[k]) * d + c] -= g_.normal[k * d + c];
    }
  space_.solver().solve(dr.data(), count);
  for (int q = 0; q < count; ++q)
    for (size_t x = 0; x < n; ++x) dr[q * n + x] += inflation(first + q) * uniform_[x];
}

void FloppySolver::measure(size_t l, const double *dr, FloppyModes &out, size_t at) const {
  const size_t d = static_cast<size_t>(g_.dim);
  std::vector<double> size(g_.nodes);
  double all = 0.0;
  for (size_t i = 0; i < size.size(); ++i) {
    const double s = squared(dr + i * d, g_.dim);
    all += s;
    size[i] = std::sqrt(s);
  }
  const double middle = median_of(size);
  out.median[at] = middle / std::sqrt(all);
  out.weight[at] = force_[l] / middle;
  const double gamma = inflation(l);
  double s_plus = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < i_.size(); ++k) {
    const double *u = dr + static_cast<size_t>(i_[k]) * d, *n = &normal_[k * d];
    double closing = gamma * sigma_[k];
    for (size_t c = 0; c < d; ++c) closing -= n[c] * (j_[k] < 0 ? u[c] : u[c] - dr[static_cast<size_t>(j_[k]) * d + c]);
    if (closing * s_plus > open_[k]) s_plus = open_[k] / closing;
  }
  double bend = 0.0;
  for (size_t k = 0; k < g_.contacts(); ++k) {
    const double across = force_[k] * g_.stretch(k, dr).across;
    bend += g_.b[k] < 0 ? across * g_.bending[k] : across / g_.distance[k];
  }
  out.s_plus[at] = s_plus;
  out.s_star[at] = bend > 0.0 ? force_[l] / bend : std::numeric_limits<double>::infinity();
  out.stability[at] = out.s_star[at] / s_plus;
  out.s_return[at] = 2.0 * out.s_star[at];  // d(s) = f s - B s^2 / 2 is a parabola
}

FloppyModes floppy_modes(const Packing &p, const ContactNetwork &network, const RigidityMatrix &g,
                         const std::vector<size_t> &contacts, std::vector<double> *vector) {
  const FloppySolver solver(p, network, g);
  const size_t m = contacts.size(), n = g.unknowns(), block = 64;
  FloppyModes out;
  out.resize(m);
  if (vector) vector->clear(), vector->reserve(m * n);
  std::vector<double> dr;
  for (size_t first = 0, count = 0; first < m; first += count) {
    CallScope::report_share(static_cast<int64_t>(first), static_cast<double>(first) / static_cast<double>(m));
    for (count = 1; count < block && first + count < m && contacts[first + count] == contacts[first] + count;) ++count;
    solver.fields(contacts[first], static_cast<int>(count), dr);
    for (size_t q = 0; q < count; ++q) solver.measure(contacts[first] + q, &dr[q * n], out, first + q);
    if (vector) vector->insert(vector->end(), dr.begin(), dr.begin() + static_cast<std::ptrdiff_t>(count * n));
  }
  return out;
}

}  // namespace jam::inside
