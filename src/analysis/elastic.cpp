// Elastic tensor and moduli with the non-affine part.
#include <algorithm>
#include <limits>
#include <utility>
#include "analysis/modes.hpp"
#include "core/call_scope.hpp"

namespace jam::inside {
namespace {

// Quadratic form of the energy in changes du (contacts, d) of contact vectors, and the spheres that follow such
// changes.
struct Network {
  const RigidityMatrix &g;
  const ContactWeights &w;
  const GroundedSolver &solver;

  double transverse(size_t k) const { return w.transverse.empty() ? 0.0 : w.transverse[k]; }
  // Block k of the Hessian times x: stiffness k along n, -t across.
  void force(size_t k, const double *x, double *f) const {
    const double *n = &g.normal[k * g.dim], t = transverse(k);
    double along = 0.0;
    for (int c = 0; c < g.dim; ++c) along += n[c] * x[c];
    for (int c = 0; c < g.dim; ++c)
      f[c] = (w.stiffness[k] + t) * along * n[c] - (g.turning(k).along(c) ? t * x[c] : 0.0);
  }
  // sum over contacts of x . H_k . y
  double product(const std::vector<double> &x, const std::vector<double> &y) const {
    const size_t d = static_cast<size_t>(g.dim);
    double sum = 0.0;
    for (size_t k = 0; k < g.contacts(); ++k) {
      const double *n = &g.normal[k * d], *a = &x[k * d], *b = &y[k * d];
      double an = 0.0, bn = 0.0, ab = 0.0;
      for (size_t c = 0; c < d; ++c) {
        an += n[c] * a[c], bn += n[c] * b[c];
        if (g.turning(k).along(static_cast<int>(c))) ab += a[c] * b[c];
      }
      sum += w.stiffness[k] * an * bn - transverse(k) * (ab - an * bn);
    }
    return sum;
  }
  // What is left of du when the spheres have moved to where forces balance again.
  std::vector<double> relaxed(const std::vector<double> &du) const {
    const size_t d = static_cast<size_t>(g.dim);
    std::vector<double> u(g.unknowns(), 0.0), f(d), left(du);
    for (size_t k = 0; k < g.contacts(); ++k) {
      force(k, &du[k * d], f.data());
      for (size_t c = 0; c < d; ++c) {
        u[static_cast<size_t>(g.a[k]) * d + c] += f[c];
        if (g.b[k] >= 0) u[static_cast<size_t>(g.b[k]) * d + c] -= f[c];
      }
    }
    solver.solve(u.data(), 1);
    for (size_t k = 0; k < g.contacts(); ++k)
      for (size_t c = 0; c < d; ++c)
        left[k * d + c] -=
            u[static_cast<size_t>(g.a[k]) * d + c] - (g.b[k] < 0 ? 0.0 : u[static_cast<size_t>(g.b[k]) * d + c]);
    return left;
  }
};

}  // namespace

// The relaxed tensor is the form of what is left of two strains, not a difference of two energies: no digits cancel.
ElasticTensor elastic_tensor(const Packing &p, const RigidityMatrix &g, const ContactWeights &w) {
  const size_t d = static_cast<size_t>(p.dim), gradients = d * d;
  const double volume = scene_volume(p), nan = std::numeric_limits<double>::quiet_NaN();
  // A wall does not strain, and a displacement along it is no strain of the cell.
  const auto strains = [&](size_t e) {
    return p.cell.repeats(static_cast<int>(e / d)) && p.cell.repeats(static_cast<int>(e % d));
  };
  const GroundedSolver solver(g, w);
  if (!w.transverse.empty() && solver.shift() > 1e-9 * solver.scale())
    fail(JAM_E_STATE,
         "with this pre-stress the Hessian has negative eigenvalues: the network is unstable and has no moduli");
  const Network network{g, w, solver};
  std::vector<std::vector<double>> strained, left;
  for (size_t e = 0; e < gradients; ++e) {
    CallScope::report_share();
    if (!strains(e)) {
      strained.emplace_back(), left.emplace_back();
      continue;
    }
    std::vector<double> du(g.contacts() * d, 0.0);
    for (size_t k = 0; k < g.contacts(); ++k) du[k * d + e / d] = g.distance[k] * g.normal[k * d + e % d];
    left.push_back(network.relaxed(du));
    strained.push_back(std::move(du));
  }
  ElasticTensor c;
  c.affine.resize(gradients * gradients);
  c.relaxed.resize(gradients * gradients);
  for (size_t e = 0; e < gradients; ++e)
    for (size_t f = 0; f <= e; ++f) {
      if (!strains(e) || !strains(f)) {
        c.affine[e * gradients + f] = c.affine[f * gradients + e] = nan;
        c.relaxed[e * gradients + f] = c.relaxed[f * gradients + e] = nan;
        continue;
      }
      c.affine[e * gradients + f] = c.affine[f * gradients + e] = network.product(strained[e], strained[f]) / volume;
      c.relaxed[e * gradients + f] = c.relaxed[f * gradients + e] = network.product(left[e], left[f]) / volume;
    }
  return c;
}

// With pre-stress the strain measure matters. Shear: simple shear x_a += gamma x_b, both ways round. Bulk:
// K = V d^2 E / dV^2 = (E'' - (d - 1) E') / (d^2 V) for a stretch of all lengths, E' = -sum (force times length). With
// walls not all lengths stretch: there is no K, and shear is that of planes of two axes that repeat.
jam_moduli_report elastic_moduli(const Packing &p, const RigidityMatrix &g, const ContactWeights &w) {
  jam_moduli_report m{};
  const size_t d = static_cast<size_t>(p.dim);
  const double dim = p.dim;
  double directions = 0.0;  // of simple shears
  for (int a = 0; a < p.dim; ++a)
    for (int b = 0; b < p.dim; ++b) directions += a != b && p.cell.repeats(a) && p.cell.repeats(b);
  const ElasticTensor tensor = elastic_tensor(p, g, w);
  const auto at = [&](const std::vector<double> &c, size_t ab, size_t cd) { return c[ab * d * d + cd]; };
  for (size_t k = 0; k < g.contacts() && !w.transverse.empty(); ++k)
    m.bulk += w.transverse[k] * g.distance[k] * g.distance[k] * (dim - 1.0) / (dim * dim * scene_volume(p));
  if (p.container) m.bulk = std::numeric_limits<double>::quiet_NaN();
  m.bulk_affine = m.bulk;
  m.shear_min = std::numeric_limits<double>::infinity();
  m.shear_max = -m.shear_min;
  for (size_t a = 0; a < d; ++a)
    for (size_t b = 0; b < d; ++b) {
      m.bulk += at(tensor.relaxed, a * d + a, b * d + b) / (dim * dim);
      m.bulk_affine += at(tensor.affine, a * d + a, b * d + b) / (dim * dim);
      if (a == b || !p.cell.repeats(static_cast<int>(a)) || !p.cell.repeats(static_cast<int>(b))) continue;
      const size_t ab = a * d + b, ba = b * d + a;
      m.shear += at(tensor.relaxed, ab, ab) / directions;
      m.shear_affine += at(tensor.affine, ab, ab) / directions;
      const double plane = 0.5 * (at(tensor.relaxed, ab, ab) + at(tensor.relaxed, ba, ba));
      m.shear_min = std::min(m.shear_min, plane);
      m.shear_max = std::max(m.shear_max, plane);
    }
  return m;
}

}  // namespace jam::inside
