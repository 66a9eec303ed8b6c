#include "proof/theorem.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/blas.hpp"
#include "proof/newton.hpp"
#include "proof/open_gaps.hpp"
#include "proof/outward.hpp"

namespace jam {
namespace {

// Of the force f: bounds that both theorems share.
struct ForceBounds {
  double length, smallest, largest;  // |f|_2, least and largest entry
  double residual;                   // at or above |R^T f|_2 of the exact R
  double weight;                     // S = |sigma^2|_2
};

// A computed R^T f is off by gamma_(z + 2) |R|^T |f|, and by half_ulp more for rows that were rounded.
double balance_error(const ProofScene &s, const ProofEquations &e) {
  std::vector<double> y(s.unknowns()), absolute(s.unknowns());
  multiply_columns(s, e, s.force.data(), y.data());
  multiply_columns(s, e, s.force.data(), absolute.data(), true);
  const double error = gamma_of(static_cast<double>(s.contacts()) + 6.0);
  // No sum is longer than the largest coordination; `contacts` is a bound that needs no count, where it is harmless.
  std::vector<int32_t> z(s.nodes(), 0);
  for (size_t c = 0; c < s.contacts(); ++c) ++z[s.a[c]], ++z[s.b[c]];
  for (size_t k = 0; k < y.size(); ++k) {
    const double sharp = gamma_of(z[k / s.dim] + 6.0);
    y[k] = add_up(std::fabs(y[k]), mul_up(std::min(error, sharp), absolute[k]));
  }
  return norm_up(y);
}

ForceBounds bound_forces(const ProofScene &s, const ProofEquations &e) {
  return {norm_up(s.force), *std::min_element(s.force.begin(), s.force.end()),
          *std::max_element(s.force.begin(), s.force.end()), balance_error(s, e),
          mul_up(norm_up(e.sigma2), add_up(1.0, gamma_of(4.0)))};
}

double largest_coordination(const ProofScene &s) {
  std::vector<int32_t> z(s.nodes(), 0);
  for (size_t c = 0; c < s.contacts(); ++c) ++z[s.a[c]], ++z[s.b[c]];
  return *std::max_element(z.begin(), z.end());
}

// |f - f0| for the exact state f0 of self-stress with sum f0 sigma^2 = 1. The part q of f with R^T q = 0 is within
// residual / s_min, and q = c f0 with |c - sum f sigma^2| <= S residual / s_min.
double force_error(const ProofScene &s, const ProofEquations &e, const ForceBounds &f, double singular) {
  double sum = 0.0;
  for (size_t c = 0; c < s.contacts(); ++c) sum += s.force[c] * e.sigma2[c];
  const double rounding = mul_up(gamma_of(static_cast<double>(s.contacts()) + 4.0), add_up(std::fabs(sum), 1.0));
  const double apart = div_up(f.residual, singular);
  const double off = add_up(add_up(std::fabs(sum - 1.0), rounding), mul_up(f.weight, apart));
  if (!(off < 0.5)) return std::numeric_limits<double>::infinity();
  const double exact = div_up(add_up(f.length, apart), sub_down(1.0, off));
  return add_up(apart, mul_up(off, exact));
}

// |J^-1 F| <= |step| + B |F - J step|: a step that solves the equations to ten digits leaves that part of B.
double distance_bound(const ProofScene &s, const ProofEquations &e, const NewtonStep &step, double inverse,
                      double &gamma) {
  std::vector<double> left(s.contacts()), size(s.contacts());
  multiply_rows(s, e, step.v.data(), left.data());
  const double error = gamma_of(3.0 * s.dim + 12.0);
  std::vector<double> all(step.v);
  all.push_back(step.gamma);
  const double largest_step = norm_up(all);
  for (size_t c = 0; c < s.contacts(); ++c) {
    double row = e.sigma2[c];
    for (int k = 0; k < s.dim; ++k) row += 2.0 * std::fabs(e.row[c * s.dim + k]);
    left[c] =
        std::fabs(e.f[c] + (left[c] - e.sigma2[c] * step.gamma)) + error * (std::fabs(e.f[c]) + row * largest_step);
    size[c] = mul_up(left[c], 1.0 + 4.0 * half_ulp);
  }
  const double rest = mul_up(inverse, norm_up(size));
  gamma = add_up(std::fabs(step.gamma), rest);
  return add_up(largest_step, rest);
}

// All F_c are 0. The part of f with R^T f = 0 exactly is within g / s_min of f, and R has full rank: jammed, whatever
// the number of contacts.
void prove_closed(const ProofScene &s, const ForceBounds &f, Proof &out) {
  double mean = 0.0;
  for (const double x : s.force) mean += x / static_cast<double>(s.contacts());
  const double error = div_up(f.residual, out.bound.singular);
  const OpenGaps gaps = open_gaps(s, 0.0, add_up(s.gamma, std::fabs(s.gamma_low)));
  out.least_force = f.smallest / mean, out.force_radius = div_up(error, mean), out.least_gap = gaps.least;
  out.exact = out.closed = gaps.open && f.smallest > error;
}

// Existence and uniqueness by Newton and Kantorovich in the 2-norm, for one state of self-stress.
void prove_existence(const ProofScene &s, const ProofEquations &e, const ForceBounds &f, NormalMatrix &normal,
                     Proof &out) {
  const auto fails = [&](ProofCause cause, double value, double bound) {
    out.cause = cause, out.cause_value = value, out.cause_bound = bound;
  };
  const double singular = out.bound.singular, error = force_error(s, e, f, singular);
  const double total = add_up(f.length, error);
  const double slope = div_up(add_up(1.0, mul_up(f.weight, total)), singular);
  const double inverse = sqrt_up(add_up(mul_up(total, total), mul_up(slope, slope)));  // |J^-1|
  const double z = largest_coordination(s), beta = mul_up(2.0 * z, inverse);
  const double eta = distance_bound(s, e, newton_step(s, e, normal), inverse, out.gamma_radius);
  // eta + beta r^2 <= r has the root r <= 2 eta where 4 beta eta < 1.
  if (!(mul_up(4.0, mul_up(beta, eta)) < 1.0))
    return fails(ProofCause::singular, singular, mul_up(4.0, mul_up(beta, eta)));
  const double r = add_up(eta, mul_up(4.0, mul_up(beta, mul_up(eta, eta))));
  const double contraction = mul_up(2.0, mul_up(beta, r));
  if (!(contraction < 0.5)) return fails(ProofCause::singular, singular, contraction);
  out.radius = r;
  out.gamma_radius = add_up(out.gamma_radius, mul_up(beta, mul_up(r, r)));
  const double moved = div_up(mul_up(mul_up(4.0 * z, r), mul_up(total, inverse)), sub_down(1.0, contraction));
  double mean = 0.0;
  for (const double x : s.force) mean += x;
  mean /= static_cast<double>(s.contacts());
  out.least_force = f.smallest / mean;
  out.force_radius = div_up(add_up(error, moved), mean);
  if (!(sub_down(f.smallest, add_up(error, moved)) > 0.0))
    return fails(ProofCause::force, out.least_force, out.force_radius);
  const OpenGaps gaps = open_gaps(s, r, add_up(add_up(s.gamma, std::fabs(s.gamma_low)), out.gamma_radius));
  out.least_gap = gaps.least;
  if (!gaps.open) return fails(gaps.of_rattler ? ProofCause::rattler : ProofCause::gap, gaps.least, r);
  out.exact = true;
}

// Trapping, for any positive state f: rho (1 - g / (f_min s_min)) <= a0 + a2 rho^2 for every motion rho without
// overlap.
void prove_trapping(const ProofScene &s, const ProofEquations &e, const ForceBounds &f, Proof &out) {
  double drop = 0.0;  // Gamma less this is that of a packing: no contact overlaps
  for (size_t c = 0; c < s.contacts(); ++c)
    drop = std::max(drop, div_up(-e.f[c], e.sigma2[c]) * (1.0 + 8.0 * half_ulp));
  std::vector<double> open, weighted;
  for (size_t c = 0; c < s.contacts(); ++c) {
    const double x = std::max(
        0.0, add_up(e.f[c] + 4.0 * half_ulp * std::fabs(e.f[c]), mul_up(drop, e.sigma2[c] * (1.0 + 8.0 * half_ulp))));
    open.push_back(x), weighted.push_back(mul_up(x, s.force[c]));
  }
  const double singular = out.bound.singular, z = largest_coordination(s);
  const double a0 = div_up(add_up(div_up(sum_up(weighted), f.smallest), sum_up(open)), singular);
  const double a2 = div_up(mul_up(2.0 * z, add_up(div_up(f.largest, f.smallest), 1.0)), singular);
  const double left = sub_down(1.0, div_up(f.residual, mul_down(f.smallest, singular)));
  if (!(left > 0.0)) return;
  const double square = mul_down(left, left), product = mul_up(4.0, mul_up(a0, a2));
  if (!(product < square)) return;
  const double root = sqrt_down(sub_down(square, product));
  out.inner = div_up(mul_up(2.0, a0), add_up(left, 0.0) + root);
  out.inner = mul_up(out.inner, 1.0 + 8.0 * half_ulp);
  out.outer = down(down((left + root) / mul_up(2.0, a2)));
  const OpenGaps gaps = open_gaps(s, 0.0, add_up(s.gamma, std::fabs(s.gamma_low)));
  out.least_gap = gaps.least;
  out.trapped = gaps.open && out.inner < out.outer;
}

}  // namespace

Proof prove(const ProofScene &s, const ProofEquations &e) {
  const BlasSingleThread single;
  Proof out;
  const auto fails = [&](ProofCause cause, double value, double bound) {
    out.cause = cause, out.cause_value = value, out.cause_bound = bound;
    return out;
  };
  if (s.contacts() == 0) return fails(ProofCause::excess, 0.0, 1.0);
  if (s.own_images) return fails(ProofCause::images, 1.0, 0.0);
  const double needed = static_cast<double>(s.dim * (s.nodes() - 1) + 1);
  const auto contacts = static_cast<double>(s.contacts());
  if (contacts < needed) return fails(ProofCause::excess, contacts, needed);
  const ForceBounds f = bound_forces(s, e);
  if (!(f.smallest > 0.0)) return fails(ProofCause::force, f.smallest, 0.0);
  NormalMatrix normal(s, e);
  if (!normal.factorise()) return fails(ProofCause::singular, 0.0, 0.0);
  out.bound = normal.bound();
  if (!(out.bound.singular > 0.0)) return fails(ProofCause::singular, out.bound.eigenvalue, out.bound.rounding);
  prove_trapping(s, e, f, out);
  if (std::all_of(e.f.begin(), e.f.end(), [](double x) { return x == 0.0; })) prove_closed(s, f, out);
  if (out.exact) return out;
  if (contacts > needed) return fails(ProofCause::excess, contacts, needed);
  prove_existence(s, e, f, normal, out);
  return out;
}

}  // namespace jam
