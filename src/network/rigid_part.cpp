#include <algorithm>
#include <cmath>

#include "network/flex.hpp"

namespace jam::inside {
namespace {

// Contacts that do not lie within B, with all spheres of B as node 0.
RigidityMatrix merge(const RigidityMatrix &g, const std::vector<char> &inside, const std::vector<char> &body) {
  std::vector<char> rest(inside);
  for (char &on : rest) on = !on;
  RigidityMatrix out = subset(g, rest);
  std::vector<int32_t> node(out.nodes);
  std::vector<int32_t> sphere{-1};
  for (int32_t i = 0; i < out.nodes; ++i) {
    node[i] = body[out.sphere[i]] ? 0 : static_cast<int32_t>(sphere.size());
    if (node[i] > 0) sphere.push_back(out.sphere[i]);
  }
  for (size_t k = 0; k < out.contacts(); ++k) out.a[k] = node[out.a[k]], out.b[k] = node[out.b[k]];
  out.nodes = static_cast<int32_t>(sphere.size());
  out.sphere = std::move(sphere);
  return out;
}

// The forces of the path on contacts within B, those of K corrected until all balance. Mean 1.
std::vector<double> balanced_forces(const RigidityMatrix &within, const std::vector<char> &in_k,
                                    const NormalSolver &solver_k, std::vector<double> f) {
  std::vector<double> rest(within.unknowns()), change;
  const RigidityMatrix k_part = subset(within, in_k);
  change.resize(k_part.contacts());
  for (int round = 0; round < 4; ++round) {
    apply_equilibrium(within, f.data(), rest.data());
    solver_k.solve(rest.data());
    apply_compatibility(k_part, rest.data(), change.data());
    for (size_t k = 0, at = 0; k < f.size(); ++k)
      if (in_k[k]) f[k] -= change[at++];
  }
  double mean = 0.0;
  for (const double v : f) mean += v / static_cast<double>(f.size());
  for (double &v : f) v = std::max(0.0, v / mean);
  return f;
}

}  // namespace

bool test_from_rigid_part(const RigidityMatrix &sub, const StressCone &cone, Jamming kind, RigidityResult &out) {
  // With walls B is fixed itself, up to symmetries, and is no body that moves as one.
  if (cone.positive.empty() || sub.open_axes != ~0u) return false;
  const size_t m = sub.contacts();
  std::vector<char> body(sub.nodes, 0), inside(m);
  for (size_t k = 0; k < m; ++k)
    if (cone.positive[k]) body[sub.a[k]] = body[sub.b[k]] = 1;
  std::vector<char> in_k;
  std::vector<double> force;
  for (size_t k = 0; k < m; ++k)
    if ((inside[k] = body[sub.a[k]] && body[sub.b[k]]))
      in_k.push_back(cone.positive[k]), force.push_back(cone.path_force[k]);
  const RigidityMatrix within = subset(sub, inside), k_part = subset(within, in_k);
  const ConstraintRows rows(k_part, kind == Jamming::strict);
  NormalSolver solver(rows);
  solver.factorise(std::vector<double>(rows.rows(), 1.0), flex_eigenvalue);
  const SoftestModes modes = softest_modes(rows, solver, flex_eigenvalue, 1);
  if (modes.count() > 0 || modes.margin < undecided_eigenvalue) return false;
  out.rigid = out.stressed = Verdict::yes;
  out.margin = modes.margin;
  out.carrying = inside;
  out.force.assign(m, 0.0);
  if (kind == Jamming::collective)
    force = balanced_forces(within, in_k, solver, std::move(force));
  else
    for (size_t k = 0; k < force.size(); ++k) force[k] *= in_k[k];
  for (size_t k = 0, at = 0; k < m; ++k)
    if (inside[k]) out.force[k] = force[at++];
  out.force_residual = balance_residual(sub, out.force.data());
  const RigidityMatrix rest = merge(sub, inside, body);
  if (rest.contacts() > 0) {
    const RigidityResult r = test_rigidity(rest, Jamming::collective);
    if (r.stressed != Verdict::no) {
      out.rigid = r.rigid, out.stressed = r.stressed;
      out.flexes = r.flexes, out.margin = std::min(out.margin, r.margin), out.curvature = r.curvature;
      bool held = false;  // by B
      for (size_t k = 0, at = 0; k < m; ++k)
        if (!inside[k] && (out.carrying[k] = r.carrying[at++])) held = held || body[sub.a[k]] || body[sub.b[k]];
      if (!held) out.rigid = Verdict::undecided;
      if (!r.flex.empty()) {
        out.flex.assign(sub.unknowns(), 0.0);
        const size_t d = static_cast<size_t>(sub.dim);
        std::vector<int32_t> node(sub.nodes, 0);
        for (int32_t q = 1; q < rest.nodes; ++q) node[rest.sphere[q]] = q;
        for (int32_t i = 0; i < sub.nodes; ++i)
          for (size_t c = 0; c < d; ++c) out.flex[i * d + c] = r.flex[node[i] * d + c] - r.flex[c];
      }
    }
  }
  return true;
}

}  // namespace jam::inside
