#include "proof/newton.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "linalg/dot.hpp"
#include "network/resolution.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

bool shown(const Proof &proof) { return proof.exact || proof.trapped; }

// As find_proof, without the cause of a saddle.
bool search_proof(ProofScene &scene, ProofEquations &equations, Proof &proof) {
  ProofScene other = scene;
  const bool refined = refine(scene, equations);
  if (refined) free_rattlers(scene);  // an overlap of one would widen the trap of all
  proof = refined ? prove(scene, equations) : Proof{};
  if (!refined) proof.cause = ProofCause::singular;
  if (!refined && scene.contacts() < static_cast<size_t>(scene.needed())) {  // their rows are no square
    proof.cause = ProofCause::excess, proof.cause_value = static_cast<double>(scene.contacts());
    proof.cause_bound = static_cast<double>(scene.needed());
  }
  if (shown(proof) || scene.strict || scene.contacts() == 0) return refined;
  const Exchange exchanged = close_together(other);
  const ProofScene closed = other;
  const Settled end = finish_exchange(other, exchanged);
  if (end == Settled::unchanged) return refined;
  ProofScene settled = other;
  ProofEquations there;
  settled.implied = find_implied(settled);
  if (refine(settled, there)) {
    const Proof again = prove(settled, there);
    if (shown(again)) {
      proof = again, scene = std::move(settled), equations = std::move(there);
      return true;
    }
  }
  if (end != Settled::held) return refined;
  mix_in_forces_of_closed(other, closed);
  if (!balance(other, there)) return refined;
  proof = prove(other, there), scene = std::move(other), equations = std::move(there);
  return true;
}

// Contacts with weak forces that do not close together: the two numbers are the least force and the widest gap.
void name_saddle(const ProofScene &s, const ProofEquations &e, Proof &proof) {
  if (proof.cause != ProofCause::excess || !(proof.least_force < proof_tuning::weak)) return;
  double widest = 0.0;
  for (size_t c = 0; c < s.contacts(); ++c)
    widest = std::max(widest, 0.5 * std::fabs(e.f[c]) / (e.sigma2[c] * s.gamma()));
  if (!(widest > proof_tuning::nearly_closed)) return;
  proof.cause = ProofCause::saddle, proof.cause_value = proof.least_force, proof.cause_bound = widest;
}

// The cause where nothing is proved and spheres touch their own images, whether a network lists them or not.
void name_images(const ProofScene &s, Proof &proof) {
  const double widest = *std::max_element(s.ratio.begin(), s.ratio.end()), apart = s.shortest_period();
  if (!shown(proof) && s.gamma() * widest * widest > (1.0 - contact_gap_limit) * apart * apart)
    proof.cause = ProofCause::images, proof.cause_value = 1.0, proof.cause_bound = 0.0;
}

Expansion squared_distance(const ProofScene &s, size_t c) {
  Expansion sum;
  for (int k = 0; k < s.dim; ++k) {
    const Expansion r = s.component(c, k);
    sum.add_product(r, r);
  }
  return sum;
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
  for (;;) {
    CallScope::look();
    const NewtonStep step = newton_step(s, e, normal);
    // The step may be infinite or NaN: the matrix is singular, or no packing nearby closes these contacts.
    if (!(norm(step.v) < s.cell.side()) || !(std::fabs(step.gamma) < s.gamma())) break;
    ProofScene next = s;
    take_step(next, step);
    ProofEquations there = evaluate(next);
    if (!(norm(there.f) < 0.5 * norm(e.f))) break;
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

bool close_exactly(ProofScene &s) {
  if (s.contacts() == 0 || s.rooted()) return false;
  // Gamma = |r|^2 / sigma^2 of the first contact, where that is a sum of two doubles.
  const Expansion square = squared_distance(s, 0), sigma2 = s.sigma_squared(size_t{0});
  int exponent = 0;
  if (sigma2.count() != 1 || std::frexp(sigma2.part(0), &exponent) != 0.5 || square.count() > 2) return false;
  const double unit = std::ldexp(1.0, 1 - exponent);
  const double high = square.count() > 0 ? square.part(square.count() - 1) * unit : 0.0;
  const double low = square.count() == 2 ? square.part(0) * unit : 0.0;
  if (!(high > 0.0)) return false;
  Expansion gamma(high);
  gamma.add(low);
  for (size_t c = 0; c < s.contacts(); ++c) {
    Expansion f = squared_distance(s, c);
    f.add_product(gamma, s.sigma_squared(c), -1.0);
    if (f.count() != 0) return false;
  }
  s.growth = high, s.growth_low = low;
  return true;
}

void equal_forces(ProofScene &s) {
  const auto [least, most] = std::minmax_element(s.force.begin(), s.force.end());
  if (*most - *least < 1e-9 * *most) std::fill(s.force.begin(), s.force.end(), s.force[0]);
}

// Steps to the least gaps would spread those of pairs that are not quite closed over all.
bool balance(ProofScene &s, ProofEquations &e) {
  e = evaluate(s);
  NormalMatrix normal(s, e);
  if (!normal.factorise()) return false;
  refine_forces(s, e, normal);
  return *std::min_element(s.force.begin(), s.force.end()) > 0.0;
}

bool find_proof(ProofScene &scene, ProofEquations &equations, Proof &proof) {
  const bool refined = search_proof(scene, equations, proof);
  name_images(scene, proof);
  if (refined && !shown(proof) && !scene.strict) name_saddle(scene, equations, proof);
  return refined;
}

}  // namespace jam::inside
