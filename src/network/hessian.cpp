#include "network/rigidity_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include "core/limits.hpp"
#include "core/math.hpp"

namespace jam::inside {

jam_hessian_options default_hessian_options() {
  jam_hessian_options o{};
  o.struct_size = sizeof o;
  o.stiffness = JAM_STIFFNESS_HARMONIC;
  o.alpha = 2.0;
  o.prestress = 0.0;
  return o;
}

void check_hessian_options(const jam_hessian_options &o) {
  check_enum(o.stiffness, JAM_STIFFNESS_HARMONIC, JAM_STIFFNESS_SOFT, "stiffness", "jam_stiffness");
  if (o.stiffness == JAM_STIFFNESS_POWER && !(o.alpha > 1.0 && std::isfinite(o.alpha)))
    fail(JAM_E_ARGUMENT, "alpha is %g, it must be finite and above 1", o.alpha);
  if (o.stiffness == JAM_STIFFNESS_SOFT) {
    if (!(o.prestress >= 0.0 && o.prestress <= 1.0))
      fail(JAM_E_ARGUMENT, "prestress is %g, of soft spheres it must be in [0, 1]", o.prestress);
  } else if (!(o.prestress >= 0.0 && o.prestress < 1.0)) {
    fail(JAM_E_ARGUMENT, "prestress is %g, it must be in [0, 1)", o.prestress);
  }
}

bool needs_forces(const jam_hessian_options &o) {
  if (o.stiffness == JAM_STIFFNESS_SOFT) return false;  // it brings its own
  return o.prestress > 0.0 || o.stiffness == JAM_STIFFNESS_HARD ||
         (o.stiffness == JAM_STIFFNESS_POWER && o.alpha != 2.0);
}

ContactWeights contact_weights(const RigidityMatrix &g, double sigma_mean, const jam_hessian_options &o) {
  if (o.stiffness == JAM_STIFFNESS_SOFT) {
    if (g.stiffness.size() != g.contacts() || g.prestress.size() != g.contacts())
      fail(JAM_E_STATE,
           "the network is not that of a minimum of the energy: call jam_relax, or jam_decompress with crunch = 0, "
           "first");
    ContactWeights soft{g.stiffness, {}};
    if (o.prestress > 0.0)
      for (const double t : g.prestress) soft.transverse.push_back(o.prestress * t);
    return soft;
  }
  if (needs_forces(o) && g.force.size() != g.contacts())
    fail(JAM_E_STATE, "this stiffness needs contact forces and the network has none");
  const double alpha = o.stiffness == JAM_STIFFNESS_POWER ? o.alpha : 2.0;
  const double exponent = o.stiffness == JAM_STIFFNESS_HARD ? 2.0 : (alpha - 2.0) / (alpha - 1.0);
  ContactWeights w;
  w.stiffness.assign(g.contacts(), 1.0);
  if (exponent != 0.0)
    for (size_t k = 0; k < g.contacts(); ++k) {
      if (!(g.force[k] > 0.0) && exponent < 0.0)
        fail(JAM_E_STATE, "contact %zu has force %g: its stiffness f^%g is not finite", k, g.force[k], exponent);
      w.stiffness[k] = math::pow(std::max(g.force[k], 0.0), exponent);
      if (o.stiffness == JAM_STIFFNESS_POWER && g.force[k] > 0.0 &&
          !(w.stiffness[k] >= limits::stiffness_min && w.stiffness[k] <= limits::stiffness_max))
        fail(JAM_E_ARGUMENT, "alpha is %.17g: contact %zu of force %g has the stiffness %g, supported are %g..%g",
             o.alpha, k, g.force[k], w.stiffness[k], limits::stiffness_min, limits::stiffness_max);
    }
  if (o.prestress > 0.0) {
    w.transverse.resize(g.contacts());
    for (size_t k = 0; k < g.contacts(); ++k)
      w.transverse[k] = g.b[k] < 0 ? o.prestress / (alpha - 1.0) * g.force[k] * sigma_mean * g.bending[k]
                                   : o.prestress / (alpha - 1.0) * g.force[k] * sigma_mean / g.distance[k];
  }
  return w;
}

BlockMatrix make_hessian(const RigidityMatrix &g, const ContactWeights &w) {
  const int d = g.dim, dd = d * d;
  BlockMatrix m;
  m.dim = d;
  m.nodes = g.nodes;
  m.diag.assign(static_cast<size_t>(g.nodes) * dd, 0.0);
  std::vector<size_t> order(g.contacts());
  std::iota(order.begin(), order.end(), size_t{0});
  auto key = [&](size_t k) { return std::pair<int32_t, int32_t>(std::min(g.a[k], g.b[k]), std::max(g.a[k], g.b[k])); };
  std::stable_sort(order.begin(), order.end(), [&](size_t x, size_t y) { return key(x) < key(y); });
  std::vector<double> block(dd);
  for (size_t k : order) {
    if (g.a[k] == g.b[k]) continue;  // both ends move together: no stretch, no contribution
    contact_block(d, w.stiffness[k], w.transverse.empty() ? 0.0 : w.transverse[k], &g.normal[k * d], g.turning(k),
                  block.data());
    const auto [i, j] = key(k);
    if (i < 0) {
      for (int q = 0; q < dd; ++q) m.diag[static_cast<size_t>(j) * dd + q] += block[q];
      continue;
    }
    if (m.ei.empty() || m.ei.back() != i || m.ej.back() != j) {
      m.ei.push_back(i);
      m.ej.push_back(j);
      m.off.resize(m.off.size() + dd, 0.0);
    }
    double *off = &m.off[m.off.size() - dd];
    for (int q = 0; q < dd; ++q) {  // blocks are symmetric, so their orientation does not matter
      off[q] -= block[q];
      m.diag[static_cast<size_t>(i) * dd + q] += block[q];
      m.diag[static_cast<size_t>(j) * dd + q] += block[q];
    }
  }
  return m;
}

double curvature(const RigidityMatrix &g, const ContactWeights &w, const double *u) {
  double sum = 0.0;
  for (size_t k = 0; k < g.contacts(); ++k) {
    const RigidityMatrix::Stretch s = g.stretch(k, u);
    sum += w.stiffness[k] * s.along * s.along;
    if (!w.transverse.empty()) sum -= w.transverse[k] * s.across;
  }
  return sum;
}

}  // namespace jam::inside
