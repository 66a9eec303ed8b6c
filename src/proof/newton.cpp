#include "proof/newton.hpp"

#include <cmath>

#include "core/call_scope.hpp"
#include "proof/exact_closure.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

double length(const std::vector<double> &x) {
  double s = 0.0;
  for (const double v : x) s += v * v;
  return std::sqrt(s);
}

}  // namespace

void refine_forces(ProofScene &s, const ProofEquations &e, const NormalMatrix &normal) {
  double sum = 0.0;
  if (s.strict) {  // r . R^T f = 2 sum f |r|^2 = d for homogeneous strains
    for (size_t c = 0; c < s.contacts(); ++c) sum += s.force[c] * e.sigma2[c];
    for (double &f : s.force) f *= 0.5 * s.dim / (sum * s.gamma());
    normal.project_on_balance(s.force);
    return;
  }
  normal.project_on_balance(s.force);
  for (size_t c = 0; c < s.contacts(); ++c) sum += s.force[c] * e.sigma2[c];
  for (double &f : s.force) f /= sum;
}

// f^T (R v - sigma^2 g) = -f^T F and f^T R = 0 give g; the rest is a system in R alone.
NewtonStep newton_step(const ProofScene &s, const ProofEquations &e, const NormalMatrix &normal) {
  NewtonStep step;
  double sum = 0.0;
  std::vector<double> y(e.f);
  for (double &x : y) x = -x;
  if (s.strict) {
    step.v = normal.nearest(y);
    return step;
  }
  for (size_t c = 0; c < s.contacts(); ++c) step.gamma += s.force[c] * e.f[c], sum += s.force[c] * e.sigma2[c];
  step.gamma /= sum;
  for (size_t c = 0; c < s.contacts(); ++c) y[c] = e.sigma2[c] * step.gamma - e.f[c];
  step.v = normal.nearest(y);
  return step;
}

void take_step(ProofScene &s, const NewtonStep &step) {
  const size_t d = static_cast<size_t>(s.dim);
  for (size_t i = 0; i < s.nodes(); ++i)
    for (size_t k = 0; k < d; ++k) {
      if (!s.moves(i, static_cast<int>(k))) continue;
      const size_t at = static_cast<size_t>(s.sphere[i]) * d + k;
      add_to(s.high[at], s.low[at], step.v[i * d + k]);
    }
  s.grow(step.gamma);
  if (!s.strict) return;
  std::vector<double> rows = s.cell.rows();
  for (size_t q = 0; q < d; ++q)
    for (size_t k = 0; k <= q; ++k) add_to(rows[q * d + k], s.cell_low[q * d + k], step.v[(s.nodes() + q) * d + k]);
  s.cell = Cell::from_triangle(s.dim, rows.data());  // of a cell without walls
}

bool approach_closure(ProofScene &s, ProofEquations &e) {
  NormalMatrix normal(s, e);
  if (!normal.factorise()) return false;
  refine_forces(s, e, normal);
  for (int k = 0; k < proof_tuning::newton_steps; ++k) {
    CallScope::look();
    const NewtonStep step = newton_step(s, e, normal);
    if (!(length(step.v) < s.cell.side())) break;  // of a singular matrix: infinite, or not a number
    ProofScene next = s;
    take_step(next, step);
    ProofEquations there = evaluate(next);
    if (!(length(there.f) < length(e.f))) break;
    s = std::move(next), e = std::move(there);
  }
  return true;
}

bool refine(ProofScene &s, ProofEquations &e) {
  if (s.contacts() == 0) return false;
  const bool closed = close_exactly(s);  // nothing to refine, and no step may spoil it
  if (!closed && !s.implied.empty()) {   // what is not implied has as many equations as unknowns
    ProofScene kept = without_implied(s);
    ProofEquations there = evaluate(kept);
    if (!approach_closure(kept, there)) return false;
    NormalMatrix normal(kept, there);
    if (!normal.factorise()) return false;
    refine_forces(kept, there, normal);
    s.high = kept.high, s.low = kept.low, s.row = kept.force;
    s.growth = kept.growth, s.growth_low = kept.growth_low;
  }
  e = evaluate(s);
  if (!closed && s.implied.empty() && !approach_closure(s, e)) return false;
  NormalMatrix normal(s, e);
  if (!normal.factorise()) return false;
  if (!closed || s.strict) refine_forces(s, e, normal);
  if (closed) equal_forces(s);
  return true;
}

}  // namespace jam::inside
