#include <algorithm>
#include <cmath>

#include "core/cell_change.hpp"
#include "core/error.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "crunch/phases.hpp"
#include "linalg/dot.hpp"

namespace jam::inside {
namespace {

Packing moved(const Packing &p, PairList &pairs, const LpSolution &x, double alpha, double unit,
              const StrainBasis &basis) {
  Packing q = p;
  const std::vector<double> strain = x.strain.empty() ? x.strain : strain_matrix(basis, x.strain, alpha);
  move_packing(q, pairs, x.s.data(), alpha * unit, std::sqrt(1.0 + alpha * x.g), strain);
  return q;
}

// Upper bound of how much nearer any two spheres come at fixed cell: the two longest displacements.
double closest_approach(const LpSolution &x, int dim, double unit) {
  double first = 0.0, second = 0.0;
  for (size_t k = 0; k < x.s.size(); k += dim) {
    double s = std::sqrt(squared(&x.s[k], dim)) * unit;
    if (s > first) std::swap(s, first);
    second = std::max(second, s);
  }
  return first + second;
}

// Makes the diameters of q as small as a curved wall wants. False where they grow by less than a part of `growth`.
bool fit_curved_wall(Packing &q, const Packing &p, double growth) {
  if (p.container.curved() == 0) return true;
  const ClosestWall closest = closest_to_wall(q, p.container.count() - 1);
  if (closest.gap < 0.0)
    for (double &s : q.diameter) s *= 1.0 + closest.gap;
  return q.diameter[0] >= p.diameter[0] * (1.0 + Tuning::least_growth * growth);
}

double gain_of(const LpSolution &x) { return std::sqrt(1.0 + std::max(x.g, 0.0)) - 1.0; }

}  // namespace

// Listed pairs: the linearised rows are tighter than the true ones (|r + s|^2 = |r|^2 + 2 r.s + |s|^2), and the set of
// (s, e, g) that obeys them is convex and contains 0, so alpha (s, e, g) is safe for every alpha in [0, 1].
// Unlisted pairs: |r| >= reach + sigma_ij. They stay apart if |r'| - sigma'_ij >= reach - (s_1 + s_2) - growth >= 0,
// with the two longest displacements and the growth of the largest diameter. A strain shortens |r| by at most its norm
// times |r|. If that does not settle it, alpha is halved until no pair or image overlaps.
// A round wall curves inward from the tangent in its row: a sphere that moves along it by s overlaps by s^2 / 2 |r|, at
// any alpha. There the diameters grow by what the true distances leave, and alpha is halved until they do grow: the LP
// promises a growth of alpha g / 2, and the curvature takes off less than a constant times alpha^2.
double take_step(Packing &p, PairList &pairs, double reach, const LpSolution &x, double unit,
                 const StrainBasis &basis) {
  const std::vector<double> strain = x.strain.empty() ? x.strain : strain_matrix(basis, x.strain, 1.0);
  const double widest = contact_distance_max(p), shorter = norm(strain) * (reach + widest),
               growth = gain_of(x) * widest;
  PairList shifted = pairs;
  double alpha = strain.empty() ? 1.0 : strain_part(p.dim, strain);
  Packing q = moved(p, shifted, x, alpha, unit, basis);
  const auto shorten = [&] {
    alpha *= 0.5;
    shifted = pairs;
    q = moved(p, shifted, x, alpha, unit, basis);
    return alpha < lp_rounding;
  };
  const auto fits = [&] { return fit_curved_wall(q, p, 0.5 * alpha * x.g) || !(x.g > 0.0); };
  const double allowed = Tuning().step_overlap(p);
  const bool may_meet = closest_approach(x, p.dim, unit) + growth + shorter > reach;
  while (!fits() || (may_meet && closest_contact(q).gap < -allowed))
    if (shorten()) return 0.0;
  p.position.swap(q.position);
  p.diameter.swap(q.diameter);
  p.cell = q.cell, p.given = q.given;
  pairs.offset.swap(shifted.offset);
  return alpha;
}

double build_lp(CrunchState &s, double reach) {
  s.last.active = ActiveSet();  // it belongs to the list that is replaced: an interrupted LP leaves no contacts
  if (s.next.strain.count() > 0)
    if (const auto entered = shorten_cell(s.out.packing, s.out.notes)) s.history.turn(s.out.packing, *entered);
  PairList pairs = find_pairs(s.out.packing, reach, 1.0);
  // A few spheres, or very unequal ones, may be farther apart than their bound lets them move. Something must bound
  // their growth: the nearest pair, at last a sphere and its own image.
  for (; pairs.size() == 0 && s.o.neighbour_radius == 0.0; reach *= 2.0)
    pairs = find_pairs(s.out.packing, 2.0 * reach, 1.0);
  if (pairs.size() == 0)
    fail(JAM_E_ARGUMENT,
         "no pair within the neighbour radius %g: it leaves gaps below %.3g beside the largest diameter",
         s.o.neighbour_radius, s.o.neighbour_radius - widest_contact(s.out.packing));
  s.last.pairs = std::move(pairs);
  s.last.lp = make_lp(s.out.packing, s.last.pairs, diameter_mean(s.out.packing), s.next.strain);
  s.last.lp.bound = s.next.bound;
  return reach;
}

double widest_contact(const Packing &p) { return contact_distance_max(p) / diameter_mean(p); }

double first_bound(const Packing &p, const jam_crunch_options &o, const Tuning &t) {
  if (o.step_bound > 0.0) return o.step_bound;
  return t.first_bound + t.bound_per_spacing * free_spacing(p);
}

double lp_reach(const Packing &p, const jam_crunch_options &o, const Tuning &t, double bound) {
  const double unit = diameter_mean(p);
  if (o.neighbour_radius > 0.0) return std::max(0.0, o.neighbour_radius * unit - contact_distance_max(p));
  return t.reach_per_bound * bound * unit;
}

LpStep make_step(CrunchState &s, double reach) {
  const double unit = diameter_mean(s.out.packing);
  // What a simplex solver leaves of a closed row, and rounding.
  s.last.active =
      find_active_set(s.last.lp, s.last.answer, std::max(2.0 * lp_rounding * s.next.bound, s.tuning.closed_gap));
  const double most = LineSearchTuning::of_feasible * s.last.lp.bound;
  s.last.at_bound =
      std::count_if(s.last.answer.s.begin(), s.last.answer.s.end(), [&](double x) { return std::fabs(x) > most; });
  if (s.history.details()) s.history.take_network(s.out.packing, s.last.lp, s.last.answer);
  const double alpha = take_step(s.out.packing, s.last.pairs, reach, s.last.answer, unit, s.next.strain);
  const double gain = gain_of(s.last.answer),
               step = largest_step(s.last.answer, s.last.active, s.last.lp.dim, s.out.packing.container.closed());
  s.monitor.log(
      JAM_LOG_INFO,
      "LP %lld: gain %.3e step %.3e alpha %.3f pairs %zu iterations %d contacts %zu stable %lld bound %.3g phi %.12f",
      static_cast<long long>(s.out.report.lp_solves), gain, step, alpha, s.last.pairs.size(), s.last.answer.iterations,
      s.last.active.rows.size(), static_cast<long long>(s.last.active.stable), s.last.lp.bound,
      packing_fraction(s.out.packing));
  std::vector<double> displacement = s.last.answer.s;
  for (double &x : displacement) x *= alpha * unit;
  HistoryRow &row = record_step(s, JAM_STEP_LP, displacement.data());
  const bool round = s.out.packing.container.curved() != 0;
  const double promised = math::expm1(0.5 * math::log1p(alpha * s.last.answer.g));
  row[JAM_HISTORY_GAIN] = round ? diameter_mean(s.out.packing) / unit - 1.0 : promised;
  row[JAM_HISTORY_ITERATIONS] = s.last.answer.iterations;
  row[JAM_HISTORY_DUALITY_GAP] = s.out.report.duality_gap;
  row[JAM_HISTORY_PAIRS] = static_cast<double>(s.last.pairs.size());
  row[JAM_HISTORY_HELD] = static_cast<double>(s.last.at_bound);
  row[JAM_HISTORY_PART] = alpha;
  row[JAM_HISTORY_BOUND] = s.last.lp.bound;
  record_contacts(s, row, s.last.active.rows.size(), s.last.active.coordination);
  return {gain, step, alpha};
}

}  // namespace jam::inside
