#include "crunch/approach/active_set.hpp"

#include <algorithm>
#include <cmath>

#include "core/pair_rule.hpp"
#include "network/rattlers.hpp"

namespace jam::inside {

// At a strictly complementary optimum a row has either force or slack. Both are compared in their own units: y times
// d n, about the number of carrying rows, is a force over the mean force; w is twice a relative gap. A solver that
// ends at a vertex may leave a closed row without force: no slack counts as well.
std::vector<char> force_carrying(const PackingLp &lp, const LpSolution &x, double closed) {
  std::vector<char> on(lp.rows());
  const double carrying = static_cast<double>(lp.dim) * static_cast<double>(lp.n);
  for (size_t k = 0; k < on.size(); ++k) on[k] = x.y[k] * carrying > x.w[k] || x.w[k] < closed;
  return on;
}

ActiveSet find_active_set(const PackingLp &lp, const LpSolution &x, double closed) {
  const PairList &pairs = *lp.pairs;
  std::vector<char> on = force_carrying(lp, x, closed);
  std::vector<double> normal(lp.a);
  for (size_t k = 0; k < on.size(); ++k) {
    on[k] = on[k] && (lp.strains > 0 || !pairs.own_image(k));
    double a2 = 0.0;
    for (int c = 0; c < lp.dim; ++c) a2 += normal[k * lp.dim + c] * normal[k * lp.dim + c];
    for (int c = 0; c < lp.dim && a2 > 0.0; ++c) normal[k * lp.dim + c] /= std::sqrt(a2);
  }
  drop_unbalanced(lp.dim, static_cast<size_t>(lp.n), pairs.i, pairs.j, normal, on);
  ActiveSet active;
  active.coordination.assign(lp.n, 0);
  for (size_t k = 0; k < on.size(); ++k)
    if (on[k]) {
      active.rows.push_back(k);
      for_spheres(pairs.i[k], pairs.j[k], [&](int32_t i) { ++active.coordination[i]; });
    }
  active.stable = stable_spheres(active.coordination);
  return active;
}

double largest_step(const LpSolution &x, const ActiveSet &active, int dim, uint32_t closed_axes) {
  std::vector<double> mean(dim, 0.0);
  const bool any = active.stable > 0;
  const size_t n = active.coordination.size();
  for (size_t i = 0; i < n && any; ++i)
    for (int c = 0; c < dim && active.coordination[i] > 0; ++c)
      if (!(closed_axes >> c & 1)) mean[c] += x.s[i * dim + c] / static_cast<double>(active.stable);
  double largest = 0.0;
  for (size_t i = 0; i < n; ++i) {
    if (any && active.coordination[i] == 0) continue;
    double s2 = 0.0;
    for (int c = 0; c < dim; ++c) s2 += (x.s[i * dim + c] - mean[c]) * (x.s[i * dim + c] - mean[c]);
    largest = std::max(largest, s2);
  }
  return std::sqrt(largest);
}

ContactNetwork make_contacts(const Packing &p, const PairList &pairs, const LpSolution &x, const ActiveSet &active) {
  ContactNetwork out;
  out.coordination = active.coordination;
  double sum = 0.0;
  for (const size_t k : active.rows) {
    const double length = add_contact(p, pairs, k, out), sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
    out.force.push_back(x.y[k] / (sigma * sigma) * length);
    sum += out.force.back();
  }
  out.force_scale = out.size() ? sum / static_cast<double>(out.size()) : 0.0;
  for (double &f : out.force) f /= out.force_scale;
  return out;
}

bool hyperstatic(const std::vector<double> &y, double isostatic, const Tuning &t) {
  const auto strong = std::count_if(y.begin(), y.end(), [&](double v) { return v * isostatic > t.crystal_force; });
  return static_cast<double>(strong) > WorkingSetTuning::carrying_rows * isostatic;
}

}  // namespace jam::inside
