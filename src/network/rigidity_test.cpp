#include "network/rigidity_test.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "linalg/blas.hpp"
#include "network/rigid_part.hpp"
#include "network/softest_modes.hpp"
#include "network/stress_cone.hpp"

namespace jam {
namespace {

// Flexes are counted up to this many.
constexpr size_t most_flexes = 512;
// A flex may close a contact by no more than this, where the largest displacement is 1: a motion of length t closes it
// by 1e-8 t and opens it by t^2 / 2, so the overlap on the way stays below the rounding of a gap.
constexpr double flex_rounding = 1e-8;
// Forces that balance worse than this, over the mean force, prove nothing.
constexpr double most_residual = 1e-10;
// And worse than this they do not even name the contacts.
constexpr double useless_residual = 1e-6;

// Spheres of `sub` (a subset of g): displacements of its nodes put in the place of those of g.
void scatter(const RigidityMatrix &sub, const double *x, double factor, std::vector<double> &v) {
  for (int32_t i = 0; i < sub.nodes; ++i)
    for (int c = 0; c < sub.dim; ++c)
      v[static_cast<size_t>(sub.sphere[i]) * sub.dim + c] += factor * x[i * sub.dim + c];
}

// A motion of all nodes: `x` on those of `sub`, and each released sphere, the last one first, moves out of the way of
// its contacts. Empty where a contact closes by more than rounding.
void complete_flex(const RigidityMatrix &g, const RigidityMatrix &sub, const ConstraintRows &sub_rows,
                   const std::vector<double> &x, const std::vector<Release> &released, bool strain,
                   RigidityResult &out) {
  const int d = g.dim;
  const ConstraintRows rows(g, strain);
  std::vector<double> v(rows.columns(), 0.0), y(rows.rows());
  if (!x.empty()) {
    scatter(sub, x.data(), 1.0, v);
    for (int q = 0; q < rows.strains && q < sub_rows.strains; ++q)
      v[g.unknowns() + q] = x[sub.unknowns() + q] * rows.length / sub_rows.length;
  }
  for (auto r = released.rbegin(); r != released.rend(); ++r) {
    double t = x.empty() ? 1.0 : 0.0;
    for (const size_t k : r->contacts) {
      double value = 0.0, along = 0.0;
      const double *n = &g.normal[k * d], sign = g.a[k] == r->sphere ? 1.0 : -1.0;
      for (int c = 0; c < d; ++c) {
        value += n[c] * (v[static_cast<size_t>(g.a[k]) * d + c] - v[static_cast<size_t>(g.b[k]) * d + c]);
        along += sign * n[c] * r->direction[c];
      }
      for (int q = 0; q < rows.strains; ++q) value += rows.e[k * rows.strains + q] * v[g.unknowns() + q];
      t = std::max(t, -value / along);
    }
    for (int c = 0; c < d; ++c) v[static_cast<size_t>(r->sphere) * d + c] += t * r->direction[c];
  }
  double largest = 0.0;
  for (int32_t i = 0; i < g.nodes; ++i) {
    double s = 0.0;
    for (int c = 0; c < d; ++c) s += v[static_cast<size_t>(i) * d + c] * v[static_cast<size_t>(i) * d + c];
    largest = std::max(largest, std::sqrt(s));
  }
  for (int q = 0; q < rows.strains; ++q) largest = std::max(largest, std::fabs(v[g.unknowns() + q]));
  if (!(largest > 0.0)) return;
  for (double &value : v) value /= largest;
  rows.multiply(v.data(), y.data());
  for (const double opening : y)
    if (opening < -flex_rounding) return;
  if (strain) out.strain = rows.strain_of(v.data());
  v.resize(g.unknowns());
  out.flex = std::move(v);
}

// Counts of K+ with this many flexes.
void count_carrying(const RigidityMatrix &carrying, int strains, RigidityResult &out) {
  const int d = carrying.dim;
  out.spheres = carrying.nodes;
  out.contacts = static_cast<int64_t>(carrying.contacts());
  out.zero_force_contacts -= out.contacts;
  const int64_t motions = d * (out.spheres - 1) + strains;
  out.contacts_needed = motions + 1;
  out.self_stresses = out.contacts - (motions - out.flexes);
  std::vector<int32_t> z(carrying.nodes, 0);
  for (size_t k = 0; k < carrying.contacts(); ++k) ++z[carrying.a[k]], ++z[carrying.b[k]];
  out.undercoordinated = std::count_if(z.begin(), z.end(), [d](int32_t c) { return c <= d; });
}

// Flags and forces of the rows that are `on` into those of all.
void spread(const std::vector<char> &on, const std::vector<char> &carrying, const std::vector<double> &force,
            RigidityResult &out) {
  for (size_t k = 0, at = 0; k < on.size(); ++k)
    if (on[k]) out.carrying[k] = carrying[at], out.force[k] = force[at++];
}

// Where the forces of the other contacts stay open: a positive state and a flex of its spheres that closes none of the
// others make a no. False without such a flex.
bool find_flex_of_part(const RigidityMatrix &g, const RigidityMatrix &sub, const ConstraintRows &rows,
                       const StressCone &cone, const std::vector<char> &on, const std::vector<Release> &released,
                       RigidityResult &out) {
  if (cone.positive.empty() || rows.strains > 0) return false;
  const RigidityMatrix part = subset(sub, cone.positive);
  const ConstraintRows kept(part, false);
  NormalSolver solver(kept);
  solver.factorise(std::vector<double>(kept.rows(), 1.0), flex_eigenvalue);
  const SoftestModes modes = softest_modes(kept, solver, flex_eigenvalue, most_flexes);
  for (const std::vector<double> &flex : modes.flexes)
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> x(rows.columns(), 0.0);
      scatter(part, flex.data(), sign, x);
      complete_flex(g, sub, rows, x, released, false, out);
      if (out.flex.empty()) continue;
      std::vector<double> force(cone.path_force);
      for (size_t k = 0; k < force.size(); ++k) force[k] *= cone.positive[k];
      spread(on, cone.positive, force, out);
      out.jammed = Verdict::no, out.stressed = Verdict::yes;
      out.flexes = static_cast<int64_t>(modes.flexes.size()), out.margin = modes.margin;
      count_carrying(part, 0, out);
      out.force_residual = balance_residual(g, out.force.data());
      return true;
    }
  return false;
}

}  // namespace

static RigidityResult find_verdict(const RigidityMatrix &g, Jamming kind) {
  CallScope::report_share();
  const bool strain = kind == Jamming::strict;
  const size_t m = g.contacts();
  RigidityResult out;
  out.carrying.assign(m, 0), out.force.assign(m, 0.0);
  std::vector<char> on(m, 1);
  const std::vector<Release> released = release_unbalanced(g.dim, static_cast<size_t>(g.nodes), g.a, g.b, g.normal, on);
  const RigidityMatrix sub = subset(g, on);
  const ConstraintRows rows(sub, strain);
  out.zero_force_contacts = static_cast<int64_t>(m);
  if (sub.contacts() == 0) {
    complete_flex(g, sub, rows, {}, released, strain, out);
    return out;
  }
  NormalSolver solver(rows);
  solver.factorise(std::vector<double>(sub.contacts(), 1.0), flex_eigenvalue);
  SoftestModes modes = softest_modes(rows, solver, flex_eigenvalue, most_flexes);
  const int64_t rank = static_cast<int64_t>(rows.columns()) - g.dim - static_cast<int64_t>(modes.flexes.size());
  const int64_t states = modes.complete ? std::max<int64_t>(0, static_cast<int64_t>(sub.contacts()) - rank) : -1;
  const StressCone cone = find_stress_cone(rows, solver, states);
  if (!cone.decided) {
    RigidityResult part;
    out.jammed = out.stressed = Verdict::undecided;
    out.margin = modes.margin;
    if (!test_from_rigid_part(sub, cone, kind, part)) {
      if (find_flex_of_part(g, sub, rows, cone, on, released, out)) return out;
      if (!cone.path_motion.empty()) {
        out.attempt.assign(g.unknowns(), 0.0);
        scatter(sub, cone.path_motion.data(), 1.0, out.attempt);
      }
      return out;
    }
    out.jammed = part.jammed, out.stressed = part.stressed, out.margin = part.margin, out.flexes = part.flexes;
    out.force_residual = part.force_residual;
    spread(on, part.carrying, part.force, out);
    count_carrying(subset(sub, part.carrying), rows.strains, out);
    if (out.jammed == Verdict::yes && !(out.force_residual < most_residual)) out.jammed = Verdict::undecided;
    if (!part.flex.empty()) complete_flex(g, sub, rows, part.flex, released, false, out);
    return out;
  }
  spread(on, cone.carrying, cone.force, out);
  const auto count = static_cast<size_t>(std::count(cone.carrying.begin(), cone.carrying.end(), 1));
  if (count == 0) {
    complete_flex(g, sub, rows, cone.motion, released, strain, out);
    return out;
  }
  out.stressed = Verdict::yes;
  const RigidityMatrix carrying = subset(sub, cone.carrying);
  const ConstraintRows kept(carrying, strain);
  if (count < sub.contacts()) {
    NormalSolver inner(kept);
    inner.factorise(std::vector<double>(count, 1.0), flex_eigenvalue);
    modes = softest_modes(kept, inner, flex_eigenvalue, most_flexes);
  }
  out.flexes = static_cast<int64_t>(modes.flexes.size());
  out.margin = modes.margin;
  out.jammed = out.flexes > 0 ? Verdict::no : modes.margin < undecided_eigenvalue ? Verdict::undecided : Verdict::yes;
  count_carrying(carrying, rows.strains, out);
  std::vector<double> f;
  for (size_t k = 0; k < sub.contacts(); ++k)
    if (cone.carrying[k]) f.push_back(cone.force[k]);
  out.force_residual = balance_residual(carrying, f.data());
  if (out.jammed == Verdict::yes && !(out.force_residual < most_residual)) out.jammed = Verdict::undecided;
  if (out.flexes == 0) return out;
  // A flex of B or its opposite, and as much of the motion that opens all other contacts as keeps them open.
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> x(rows.columns(), 0.0), y0(rows.rows()), y1(rows.rows());
    scatter(carrying, modes.flexes[0].data(), sign, x);
    for (int q = 0; q < rows.strains; ++q)
      x[sub.unknowns() + q] = sign * modes.flexes[0][carrying.unknowns() + q] * rows.length / kept.length;
    if (!cone.motion.empty()) {
      rows.multiply(x.data(), y0.data());
      rows.multiply(cone.motion.data(), y1.data());
      double factor = 0.0;
      for (size_t k = 0; k < rows.rows(); ++k)
        if (!cone.carrying[k]) factor = std::max(factor, -y0[k] / y1[k]);
      for (size_t k = 0; k < x.size(); ++k) x[k] += factor * cone.motion[k];
    }
    complete_flex(g, sub, rows, x, released, strain, out);
    if (!out.flex.empty()) break;
  }
  return out;
}

// Spheres whose contact vectors nearly but not quite balance, as two that are opposite but for 1e-6, carry no force,
// and each can slip out. Vectors are known to rounding, so that none is too near to a balance. Without them the rest
// may be proved jammed. False where it is not.
static bool test_without_unbalanced(const RigidityMatrix &g, Jamming kind, RigidityResult &out) {
  std::vector<char> clear(g.contacts(), 1), on(g.contacts(), 1);
  const auto nodes = static_cast<size_t>(g.nodes);
  release_unbalanced(g.dim, nodes, g.a, g.b, g.normal, on, direction_errors(g));
  drop_unbalanced(g.dim, nodes, g.a, g.b, g.normal, clear);
  if (on == clear || std::count(on.begin(), on.end(), 1) == 0) return false;
  RigidityResult part = find_verdict(subset(g, on), kind);
  if (part.jammed != Verdict::yes) return false;
  out = part;
  out.carrying.assign(g.contacts(), 0), out.force.assign(g.contacts(), 0.0);
  spread(on, part.carrying, part.force, out);
  out.zero_force_contacts = static_cast<int64_t>(g.contacts()) - out.contacts;
  return true;
}

// A no is proved by its motion. Where none holds up, K+ was not what it seemed, and nothing is decided.
RigidityResult test_rigidity(const RigidityMatrix &g, Jamming kind) {
  const BlasSingleThread single;
  RigidityResult out = find_verdict(g, kind);
  if (out.jammed == Verdict::yes || g.contacts() == 0) return out;
  if (test_without_unbalanced(g, kind, out)) return out;
  if (out.jammed != Verdict::no || !out.flex.empty()) return out;
  const bool stressed = out.stressed == Verdict::yes, useless = !(out.force_residual < useless_residual);
  if (stressed && useless) {
    out = RigidityResult();
    out.carrying.assign(g.contacts(), 0), out.force.assign(g.contacts(), 0.0);
    out.zero_force_contacts = static_cast<int64_t>(g.contacts());
  }
  out.jammed = Verdict::undecided;
  if (!stressed || !(out.force_residual < most_residual) || useless) out.stressed = Verdict::undecided;
  return out;
}

ContactNetwork PackingVerdict::carrying(int dim) const { return subset(contacts, result.carrying, dim); }

namespace {

// Result on the rows that are `on`, with its arrays as long as those of the whole list.
RigidityResult test_part(const RigidityMatrix &g, const std::vector<char> &on, Jamming kind) {
  if (std::count(on.begin(), on.end(), 0) == 0) return test_rigidity(g, kind);
  const RigidityMatrix part = subset(g, on);
  RigidityResult r = test_rigidity(part, kind);
  std::vector<char> carrying(g.contacts(), 0);
  std::vector<double> force(g.contacts(), 0.0);
  for (size_t k = 0, at = 0; k < g.contacts(); ++k)
    if (on[k]) carrying[k] = r.carrying[at], force[k] = r.force[at++];
  r.carrying = std::move(carrying), r.force = std::move(force);
  for (std::vector<double> *motion : {&r.flex, &r.attempt}) {
    if (motion->empty()) continue;
    std::vector<double> v(g.unknowns(), 0.0);
    scatter(part, motion->data(), 1.0, v);
    *motion = std::move(v);
  }
  return r;
}

}  // namespace

namespace {

// With the closed contacts jammed, another contact between two of their force-carrying spheres changes nothing: its row
// is a combination of theirs. True when all contacts in doubt are of that kind or cannot carry force at all.
bool within_jammed(const RigidityMatrix &g, const std::vector<char> &closed, const std::vector<char> &carrying) {
  std::vector<char> stable(g.nodes, 0), on(g.contacts(), 1);
  for (size_t k = 0; k < g.contacts(); ++k)
    if (carrying[k]) stable[g.a[k]] = stable[g.b[k]] = 1;
  drop_unbalanced(g.dim, static_cast<size_t>(g.nodes), g.a, g.b, g.normal, on);
  for (size_t k = 0; k < g.contacts(); ++k)
    if (on[k] && !closed[k] && !(stable[g.a[k]] && stable[g.b[k]])) return false;
  return true;
}

// Spheres with d contacts or fewer can slip out of a balance of forces (they are no part of a jammed network), and
// others follow. Whether any sphere is left does not depend on directions.
bool may_hold_spheres(const RigidityMatrix &g) {
  std::vector<int32_t> degree(g.nodes, 0);
  std::vector<char> on(g.contacts(), 1);
  for (size_t k = 0; k < g.contacts(); ++k) ++degree[g.a[k]], ++degree[g.b[k]];
  for (bool again = true; again;) {
    again = false;
    for (size_t k = 0; k < g.contacts(); ++k)
      if (on[k] && (degree[g.a[k]] <= g.dim || degree[g.b[k]] <= g.dim))
        on[k] = 0, again = true, --degree[g.a[k]], --degree[g.b[k]];
  }
  return std::count(on.begin(), on.end(), 1) > 0;
}

// A sphere that touches nothing but its own images has no motion of its own. It is held where their forces balance on
// the cell too.
void judge_alone(const RigidityMatrix &g, RigidityResult &r) {
  const RigidityResult strict = test_rigidity(subset(g, r.carrying), Jamming::strict);
  r.margin = strict.margin;
  r.jammed = strict.stressed == Verdict::yes ? Verdict::yes : Verdict::undecided;
}

}  // namespace

bool may_touch_own_image(const Packing &p, const GapResolution &resolution) {
  const double widest = diameter_max(p);
  return resolution.may_touch(p.cell.shortest() / widest - 1.0, widest);
}

PackingVerdict test_packing(const Packing &p, const ContactNetwork *listed, Jamming kind) {
  return test_packing(p, gap_resolution(p), listed, kind);
}

PackingVerdict test_packing(const Packing &p, const GapResolution &resolution, const ContactNetwork *listed,
                            Jamming kind) {
  PackingVerdict out;
  ContactNetwork &net = out.contacts;
  ContactNetwork near;
  near.pairs = find_pairs(p, resolution.reach(), 1.0 + listed_gap_limit);
  measure_contacts(p, near);
  near.coordination.assign(p.n(), 0);
  near.force.assign(near.size(), 0.0);
  std::vector<double> in_list(near.size(), 0.0);
  if (listed) in_list = carry_over(listed->pairs, std::vector<double>(listed->size(), 1.0), near.pairs);
  std::vector<char> wanted(near.size());
  // A sphere and its own image keep their distance in a fixed cell: contacts only of a network from a free one.
  const auto counts = [&](size_t k) { return kind == Jamming::strict || !near.pairs.own_image(k); };
  for (size_t k = 0; k < near.size(); ++k)
    wanted[k] = in_list[k] > 0.0 ||
                (counts(k) && resolution.may_touch(near.gap[k], contact_distance(p, near.pairs.i[k], near.pairs.j[k])));
  net = subset(near, wanted, p.dim);
  std::vector<char> closed, near_enough, listed_here;
  for (size_t k = 0; k < near.size(); ++k) {
    if (!wanted[k]) continue;
    const bool named = in_list[k] > 0.0;
    listed_here.push_back(named);
    closed.push_back(near.gap[k] < (named ? undecided_gap_limit : contact_gap_limit));
    near_enough.push_back(closed.back() || named ||
                          near.gap[k] * contact_distance(p, near.pairs.i[k], near.pairs.j[k]) < resolution.reach());
  }
  out.undecided_contacts =
      std::count_if(net.gap.begin(), net.gap.end(), [](double h) { return h >= contact_gap_limit; });
  const RigidityMatrix g = make_rigidity_matrix(p, net);
  out.sphere = g.sphere;
  out.result = test_part(g, closed, kind);
  out.when_closed = out.result.jammed;
  if (near_enough != closed && !(out.result.jammed == Verdict::yes && within_jammed(g, closed, out.result.carrying))) {
    RigidityResult shut = test_part(g, near_enough, kind);
    const bool same = shut.jammed == out.result.jammed;
    out.when_closed = shut.jammed;
    // Jammed with and without the pairs in doubt: closed contacts alone prove it. Else the flex of the open ones is
    // kept.
    if (same ? shut.jammed != Verdict::yes : out.result.jammed == Verdict::yes) out.result = std::move(shut);
    if (!same) out.result.jammed = Verdict::undecided;
  }
  if (out.result.jammed == Verdict::undecided && !resolution.coarse(p)) {
    // Unlisted pairs whose gaps are wider than rounding are open, and leave contacts that may decide alone.
    std::vector<char> tight(closed);
    for (size_t k = 0; k < net.size(); ++k)
      tight[k] = closed[k] && (listed_here[k] || net.gap[k] < 4.0 * resolution.rounding);
    RigidityResult r = tight == closed ? out.result : test_part(g, tight, kind);
    if (r.jammed != Verdict::undecided) out.result = std::move(r);
  }
  if (std::count(closed.begin(), closed.end(), 1) == 0 && g.nodes > 0 && out.result.jammed == Verdict::no) {
    out.result.flex.assign(g.unknowns(), 0.0);  // nothing is closed: any motion will do
    out.result.flex[0] = 1.0;
  }
  if (out.result.jammed == Verdict::no && resolution.coarse(p) && may_hold_spheres(g))
    out.result.jammed = Verdict::undecided;
  // A contact that stays open is none: only closed ones prove a packing jammed, whoever lists them.
  for (size_t k = 0; k < net.size(); ++k)
    if (out.result.jammed == Verdict::yes && out.result.carrying[k] && !(net.gap[k] < contact_gap_limit))
      out.result.jammed = Verdict::undecided;
  if (kind == Jamming::collective && out.result.spheres == 1 && out.result.contacts > 0) judge_alone(g, out.result);
  net.force = out.result.force;
  double sum = 0.0;
  for (size_t k = 0; k < g.contacts(); ++k) sum += net.force[k] * g.sigma[k] * g.sigma[k] / g.distance[k];
  net.force_scale = sum > 0.0 ? 1.0 / sum : 0.0;
  return out;
}

}  // namespace jam
