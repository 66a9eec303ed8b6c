#include <algorithm>
#include <cmath>

#include "proof/expansion.hpp"
#include "proof/newton.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

// Of the force f: bounds that both theorems share.
struct ForceBounds {
  double length, smallest, largest;  // |f|_2, least and largest entry
  double residual;                   // at or above |R^T f|_2 of the exact R
  double weight;                     // S = |sigma^2|_2
};

// |R^T f - b|, b the target of balance. A computed R^T f is off by gamma_(z + 3) |R|^T |f|, and by half_ulp more for
// rows that were rounded.
double balance_error(const ProofScene &s, const ProofEquations &e) {
  std::vector<double> y(s.unknowns()), absolute(s.unknowns());
  const std::vector<double> target = balance_target(s);
  multiply_columns(s, e, s.force.data(), y.data());
  multiply_columns(s, e, s.force.data(), absolute.data(), true);
  std::vector<int32_t> z(s.ends(), 0);
  for (size_t c = 0; c < s.contacts(); ++c) s.each_end(c, [&](size_t node, double) { ++z[node]; });
  for (size_t k = 0; k < y.size(); ++k) {
    const double error = mul_up(gamma_of(z[k / s.dim] + 7.0), absolute[k]);
    y[k] = add_up(add_up(std::fabs(y[k] - target[k]), mul_up(4.0 * half_ulp, target[k])), error);
  }
  return norm_up(y);
}

ForceBounds bound_forces(const ProofScene &s, const ProofEquations &e) {
  return {norm_up(s.force), *std::min_element(s.force.begin(), s.force.end()),
          *std::max_element(s.force.begin(), s.force.end()), balance_error(s, e),
          mul_up(norm_up(e.sigma2), add_up(1.0, gamma_of(s.rooted() ? 12.0 : 4.0)))};
}

// Least edge of the cell along its axes: what volumes and their gradient divide by.
double least_edge(const ProofScene &s) {
  double least = s.cell.row(0)[0];
  for (int q = 1; q < s.dim; ++q) least = std::min(least, s.cell.row(q)[q]);
  return least * (1.0 - 8.0 * half_ulp);
}

// At or above |sum f sigma^2 - 1|, for forces of any sign.
double scale_error(const ProofScene &s, const ProofEquations &e) {
  double sum = 0.0, size = 0.0;
  for (size_t c = 0; c < s.contacts(); ++c)
    sum += s.force[c] * e.sigma2[c], size += std::fabs(s.force[c]) * e.sigma2[c];
  const double rounding = mul_up(gamma_of(2.0 * static_cast<double>(s.contacts()) + 8.0), add_up(size, 1.0));
  return add_up(std::fabs(sum - 1.0), rounding);
}

// |f - f0| for the exact state f0 of self-stress with sum f0 sigma^2 = 1. The part q of f with R^T q = 0 is within
// residual / s_min, and q = c f0 with |c - sum f sigma^2| <= S residual / s_min.
double force_error(const ProofScene &s, const ProofEquations &e, const ForceBounds &f, double singular) {
  const double apart = div_up(f.residual, singular);
  const double off = add_up(scale_error(s, e), mul_up(f.weight, apart));
  if (!(off < 0.5)) return std::numeric_limits<double>::infinity();
  const double exact = div_up(add_up(f.length, apart), sub_down(1.0, off));
  return add_up(apart, mul_up(off, exact));
}

// |J^-1 F| <= |step| + B |F - J step|: a step that solves the equations to ten digits leaves that part of B.
double distance_bound(const ProofScene &s, const ProofEquations &e, const NewtonStep &step, double inverse,
                      double &growth) {
  std::vector<double> left(s.contacts()), size(s.contacts());
  multiply_rows(s, e, step.v.data(), left.data());
  const double error = gamma_of(s.dim * (s.dim + 5.0) + (s.rooted() ? 24.0 : 12.0));
  const double per = s.gamma_per_growth(), grown = step.gamma / per;
  std::vector<double> all(step.v);
  all.push_back(grown);
  const double largest_step = norm_up(all);
  for (size_t c = 0; c < s.contacts(); ++c) {
    const double column = e.sigma2[c] * per;
    double row = column;
    s.each_end(c, [&](size_t, double weight) {
      for (int k = 0; k < s.dim; ++k) row += std::fabs(weight * e.row[c * s.dim + k]);
    });
    left[c] = std::fabs(e.f[c] + (left[c] - column * grown)) + error * (std::fabs(e.f[c]) + row * largest_step);
    size[c] = mul_up(left[c], 1.0 + 4.0 * half_ulp);
  }
  const double rest = mul_up(inverse, norm_up(size));
  growth = add_up(std::fabs(grown), rest);
  return add_up(largest_step, rest);
}

double growth_above(const ProofScene &s) { return add_up(s.growth, std::fabs(s.growth_low)); }

// All F_c are 0. The part of f with R^T f = 0 exactly is within g / s_min of f, and R has full rank: jammed, whatever
// the number of contacts.
void prove_closed(const ProofScene &s, const ForceBounds &f, Proof &out) {
  double mean = 0.0;
  for (const double x : s.force) mean += x / static_cast<double>(s.contacts());
  const double error = div_up(f.residual, out.bound.singular);
  const OpenGaps gaps = open_gaps(s, 0.0, growth_above(s));
  out.least_force = f.smallest / mean, out.force_radius = div_up(error, mean), out.least_gap = gaps.least;
  out.exact = out.closed = gaps.open && f.smallest > error;
}

// The equations that are as many as the unknowns: of all contacts that are not implied. |Q(v)| <= load |v|^2, and
// inverse >= |J^-1|. With a round wall Q has q_c h^2 in addition, h the change of g.
struct Square {
  double singular;  // of R
  double load, inverse;
  double eta, growth_eta;  // bounds of the step to the zero, and of its part in Gamma or g
};
Square bound_square(const ProofScene &s, const ProofEquations &e, NormalMatrix &normal, double singular) {
  Square out{singular, std::max(largest_load(s), growth_load(s)), 0.0, 0.0, 0.0};
  if (s.strict) {  // J is R itself
    out.inverse = div_up(1.0, singular);
    out.eta = distance_bound(s, e, newton_step(s, e, normal), out.inverse, out.growth_eta);
    out.growth_eta = 0.0;
    return out;
  }
  const ForceBounds f = bound_forces(s, e);
  const double total = add_up(f.length, force_error(s, e, f, singular));
  const double slope = div_up(add_up(1.0, mul_up(f.weight, total)), singular);
  // f0 with the scale sum f0_c dF_c / dg = -1 is 2 g times smaller.
  const double own = s.rooted() ? div_up(total, s.gamma_per_growth() * (1.0 - 8.0 * half_ulp)) : total;
  out.inverse = sqrt_up(add_up(mul_up(own, own), mul_up(slope, slope)));
  out.eta = distance_bound(s, e, newton_step(s, e, normal), out.inverse, out.growth_eta);
  return out;
}
Square bound_square(const ProofScene &s, const ProofEquations &e, NormalMatrix &normal, NormalMatrix::Bound &bound) {
  if (s.implied.empty()) return bound_square(s, e, normal, bound.singular);
  ProofScene kept = without_implied(s);
  const ProofEquations there = evaluate(kept);
  NormalMatrix own(kept, there);
  bound = own.factorise() ? own.bound() : NormalMatrix::Bound();
  if (!(bound.singular > 0.0)) return {};
  refine_forces(kept, there, own);
  return bound_square(kept, there, own, bound.singular);
}

// |J(v) - J| <= turn_bound |v|. With a round wall the column of g turns by 2 q_c h.
double turn_bound(const ProofScene &s) {
  const double turn = mul_up(2.0, sqrt_up(mul_up(largest_weight(s), largest_load(s))));
  return std::max(turn, mul_up(2.0, growth_load(s)));
}

// Of rho <= ... + a2 rho^2: what second orders of the contacts add, and strict those of log V <= 0, which lets b.v be
// rho^2 / h^2 while rho <= h / 2.
double second_order(const ProofScene &s, double smallest, double largest, double singular, double edge) {
  const double a2 = div_up(mul_up(largest_load(s), add_up(div_up(largest, smallest), 1.0)), singular);
  if (!s.strict) return a2;
  return add_up(a2, div_up(1.0, mul_down(mul_down(edge, edge), mul_down(smallest, singular))));
}

// How far the forces at the exact packing are from f. Those on implied contacts are free and kept; the others solve
// J^T f = the rest, of which f leaves its residual alone: both have the scale sum f sigma^2 of the written f. The way r
// changes R by at most 2 sqrt(weight load) r in the norm of Frobenius, strict the target 1 / h by r / (h (h - r)) an
// edge.
double moved_forces(const ProofScene &s, const ForceBounds &f, const Square &square, double r, double contraction) {
  const double turned = mul_up(mul_up(turn_bound(s), r), f.length), edge = least_edge(s);
  const double target = div_up(mul_up(static_cast<double>(s.dim), r), mul_down(edge, sub_down(edge, r)));
  const double left = add_up(add_up(f.residual, s.strict ? target : 0.0), turned);
  return div_up(mul_up(square.inverse, left), sub_down(1.0, contraction));
}

// The exact packing has e = g = 0: no motion leads out of it, and no other as dense is within 1 / a2.
void prove_isolation(const ProofScene &s, const ForceBounds &f, double error, double r, double singular, Proof &out) {
  const double left = sub_down(singular, mul_up(turn_bound(s), r)), edge = sub_down(least_edge(s), r);
  if (!(left > 0.0) || !(edge > 0.0)) return;
  const double a2 = second_order(s, sub_down(f.smallest, error), add_up(f.largest, error), left, edge);
  const double outer = sub_down(std::min(div_down(1.0, a2), s.strict ? 0.5 * edge : HUGE_VAL), r);
  if (outer > r) out.inner = r, out.outer = outer, out.trapped = true;
}

// Existence and uniqueness by Newton and Kantorovich in the 2-norm, for one state of self-stress on all contacts that
// are not implied.
void prove_existence(const ProofScene &s, const ProofEquations &e, const ForceBounds &f, NormalMatrix &normal,
                     Proof &out) {
  const auto fails = [&](ProofCause cause, double value, double bound) {
    out.cause = cause, out.cause_value = value, out.cause_bound = bound;
  };
  const double all_singular = out.bound.singular;
  const Square square = bound_square(s, e, normal, out.bound);
  if (!(square.singular > 0.0)) return fails(ProofCause::singular, out.bound.eigenvalue, out.bound.rounding);
  const double beta = mul_up(square.load, square.inverse), eta = square.eta;
  // eta + beta r^2 <= r has the root r <= 2 eta where 4 beta eta < 1.
  if (!(mul_up(4.0, mul_up(beta, eta)) < 1.0))
    return fails(ProofCause::singular, square.singular, mul_up(4.0, mul_up(beta, eta)));
  const double r = add_up(eta, mul_up(4.0, mul_up(beta, mul_up(eta, eta))));
  const double contraction = mul_up(2.0, mul_up(beta, r));
  if (!(contraction < 0.5)) return fails(ProofCause::singular, square.singular, contraction);
  const double least = std::sqrt(s.gamma()) * *std::min_element(s.ratio.begin(), s.ratio.end());
  if (!s.implied.empty() && !(r < 1e-3 * proof_tuning::far_above * least))  // tiles must stay convex
    return fails(ProofCause::singular, square.singular, contraction);
  out.radius = r;
  const double grown = add_up(square.growth_eta, mul_up(beta, mul_up(r, r))), growth = add_up(growth_above(s), grown);
  out.gamma_radius = s.rooted() ? mul_up(mul_up(2.0, growth), grown) : grown;
  const double error = moved_forces(s, f, square, r, contraction);
  double mean = 0.0;
  for (const double x : s.force) mean += x / static_cast<double>(s.contacts());
  out.least_force = f.smallest / mean;
  out.force_radius = div_up(error, mean);
  if (!(sub_down(f.smallest, error) > 0.0)) return fails(ProofCause::force, out.least_force, out.force_radius);
  const OpenGaps gaps = open_gaps(s, r, growth);
  out.least_gap = gaps.least;
  if (!gaps.open) return fails(gaps.of_rattler ? ProofCause::rattler : ProofCause::gap, gaps.least, r);
  out.exact = true;
  prove_isolation(s, f, error, r, all_singular, out);
}

// Trapping, for any positive state f: rho (1 - g / (f_min s_min)) <= a0 + a2 rho^2 for every motion rho without
// overlap.
void prove_trapping(const ProofScene &s, const ProofEquations &e, const ForceBounds &f, Proof &out) {
  // Growth less this is that of a packing: no pair overlaps. Pairs that carry no force may be closed too.
  const OpenGaps gaps = open_gaps(s, 0.0, growth_above(s));
  out.least_gap = gaps.least;
  double drop = gaps.overlap;
  const double per = s.gamma_per_growth(), rounding = 1.0 + (s.rooted() ? 32.0 : 8.0) * half_ulp;
  for (size_t c = 0; c < s.contacts(); ++c) drop = std::max(drop, div_up(-e.f[c], e.sigma2[c] * per) * rounding);
  if (s.rooted()) {  // of a pair Gamma falls by 2 g drop - drop^2
    if (!(drop < 0.4 * s.growth)) return;
    drop = mul_up(drop, add_up(1.0, div_up(drop, s.growth * (1.0 - 8.0 * half_ulp))));
  }
  std::vector<double> open, weighted;
  for (size_t c = 0; c < s.contacts(); ++c) {
    double column = e.sigma2[c] * per * rounding;  // a round wall's F grows by (drop s)^2 in addition
    if (s.round(s.b[c])) column = add_up(column, mul_up(drop, up(up(s.sigma_squared(c).value()))));
    const double x = std::max(0.0, add_up(e.f[c] + 4.0 * half_ulp * std::fabs(e.f[c]), mul_up(drop, column)));
    open.push_back(x), weighted.push_back(mul_up(x, s.force[c]));
  }
  const double singular = out.bound.singular, edge = least_edge(s);
  const double a0 = div_up(add_up(div_up(sum_up(weighted), f.smallest), sum_up(open)), singular);
  const double a2 = second_order(s, f.smallest, f.largest, singular, edge);
  const double left = sub_down(1.0, div_up(f.residual, mul_down(f.smallest, singular)));
  if (!(left > 0.0)) return;
  const double square = mul_down(left, left), product = mul_up(4.0, mul_up(a0, a2));
  if (!(product < square)) return;
  const double root = sqrt_down(sub_down(square, product));
  out.inner = div_up(mul_up(2.0, a0), down(left + root));
  out.outer = down(down((left + root) / mul_up(2.0, a2)));
  if (s.strict) out.outer = std::min(out.outer, 0.5 * edge);
  out.trapped = gaps.all_seen && out.inner < out.outer;
}

}  // namespace

Proof prove(const ProofScene &s, const ProofEquations &e) {
  Proof out;
  const auto fails = [&](ProofCause cause, double value, double bound) {
    out.cause = cause, out.cause_value = value, out.cause_bound = bound;
    return out;
  };
  if (s.contacts() == 0) return fails(ProofCause::excess, 0.0, 1.0);
  if (s.own_images) return fails(ProofCause::images, 1.0, 0.0);
  const double needed = static_cast<double>(s.needed());
  const auto contacts = static_cast<double>(s.contacts());
  if (contacts < needed) return fails(ProofCause::excess, contacts, needed);
  const ForceBounds f = bound_forces(s, e);
  if (!(f.smallest > 0.0)) return fails(ProofCause::force, f.smallest, 0.0);
  out.least_force = f.smallest * contacts / (sum_up(s.force) * (1.0 + 4.0 * half_ulp));
  NormalMatrix normal(s, e);
  if (!normal.factorise()) return fails(ProofCause::singular, 0.0, 0.0);
  out.bound = normal.bound();
  if (!(out.bound.singular > 0.0)) return fails(ProofCause::singular, out.bound.eigenvalue, out.bound.rounding);
  prove_trapping(s, e, f, out);
  if (std::all_of(e.f.begin(), e.f.end(), [](double x) { return x == 0.0; })) prove_closed(s, f, out);
  if (out.exact) return out;
  if (contacts - static_cast<double>(s.implied.size()) > needed) return fails(ProofCause::excess, contacts, needed);
  prove_existence(s, e, f, normal, out);
  return out;
}

}  // namespace jam::inside
