#include "network/rigidity_test.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "network/flex.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

bool is_below_limit(int64_t flexes) { return flexes < static_cast<int64_t>(RigidityTuning::most_flexes); }

// Counts of K+ with this many flexes. counted: all of them; beyond a limit the number of states is not known.
void count_carrying(const RigidityMatrix &carrying, int strains, bool counted, RigidityResult &out) {
  const int d = carrying.dim;
  out.spheres = carrying.nodes;
  out.contacts = static_cast<int64_t>(carrying.contacts());
  out.zero_force_contacts -= out.contacts;
  const int64_t motions = d * out.spheres - carrying.symmetries() + strains;
  out.contacts_needed = motions + 1;
  out.self_stresses = counted || out.flexes >= motions ? out.contacts - (motions - out.flexes) : -1;
  std::vector<int32_t> z(carrying.nodes, 0);
  for (size_t k = 0; k < carrying.contacts(); ++k)
    for_spheres(carrying.a[k], carrying.b[k], [&](int32_t i) { ++z[i]; });
  out.undercoordinated = std::count_if(z.begin(), z.end(), [d](int32_t c) { return c <= d; });
}

// Without round walls the sum of forces times second derivatives of distances is positive, except for flexes that move
// each part of the network as a whole. Where there are no others nothing opens.
bool only_slides(const SoftestModes &modes) { return modes.flexes.empty() && modes.slides.count() > 0; }

// All flexes, one after the other.
std::vector<double> flex_of(const SoftestModes &modes, size_t k, size_t columns) {
  if (k < modes.flexes.size()) return modes.flexes[k];
  std::vector<double> flex = modes.slides.motion(k - modes.flexes.size());
  flex.resize(columns, 0.0);
  return flex;
}

// Flags and forces of the rows that are `on` into those of all.
void spread(const std::vector<char> &on, const std::vector<char> &carrying, const std::vector<double> &force,
            RigidityResult &out) {
  for (size_t k = 0, at = 0; k < on.size(); ++k)
    if (on[k]) out.carrying[k] = carrying[at], out.force[k] = force[at++];
}

// A list of contacts, and those of its spheres that their contacts might support.
struct Supported {
  const RigidityMatrix &g;
  const bool strain;
  std::vector<char> on;
  const std::vector<Release> released;
  const RigidityMatrix sub;
  const ConstraintRows rows;
  Supported(const RigidityMatrix &all, Jamming kind)
      : g(all),
        strain(kind == Jamming::strict),
        on(all.contacts(), 1),
        released(release_unbalanced(g.dim, static_cast<size_t>(g.nodes), g.a, g.b, g.normal, on)),
        sub(subset(g, on)),
        rows(sub, strain) {}
  void complete(const std::vector<double> &motion, bool with_strain, RigidityResult &out) const {
    complete_flex(g, sub, rows, motion, released, with_strain, out);
  }
};

// Where the forces of the other contacts stay open: a positive state and a flex of its spheres that closes none of the
// others make a no. False without such a flex.
bool find_flex_of_part(const Supported &s, const StressCone &cone, RigidityResult &out) {
  if (cone.positive.empty() || s.rows.strains > 0 || s.g.curved != 0) return false;
  const RigidityMatrix part = subset(s.sub, cone.positive);
  const ConstraintRows kept(part, false);
  NormalSolver solver(kept);
  solver.factorise(std::vector<double>(kept.rows(), 1.0), flex_eigenvalue);
  const SoftestModes modes = softest_modes(kept, solver, flex_eigenvalue, RigidityTuning::most_flexes);
  for (size_t k = 0; k < std::min(static_cast<size_t>(modes.count()), RigidityTuning::most_flexes); ++k) {
    const std::vector<double> flex = flex_of(modes, k, kept.columns());
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> x(s.rows.columns(), 0.0);
      scatter(part, flex.data(), sign, x);
      RigidityResult found = out;
      std::vector<double> force(cone.path_force);
      for (size_t k = 0; k < force.size(); ++k) force[k] *= cone.positive[k];
      spread(s.on, cone.positive, force, found);
      s.complete(x, false, found);
      if (found.flex.empty()) continue;
      out = std::move(found);
      out.rigid = Verdict::no, out.stressed = Verdict::yes;
      out.flexes = modes.count(), out.margin = modes.margin;
      count_carrying(part, 0, modes.complete, out);
      out.force_residual = balance_residual(s.g, out.force.data());
      return true;
    }
  }
  return false;
}

// The centre of the forces was not found. A rigid part of the contacts, or a flex of a part, may decide.
void test_undecided_cone(const Supported &s, const StressCone &cone, Jamming kind, RigidityResult &out) {
  out.rigid = out.stressed = Verdict::undecided;
  StressCone pushed;
  pushed.positive = cone.pushed, pushed.path_force = cone.pushed_force;
  RigidityResult part;
  if (!test_from_rigid_part(s.sub, cone, kind, part) &&
      !(test_from_rigid_part(s.sub, pushed, kind, part) && part.rigid == Verdict::yes)) {
    find_flex_of_part(s, cone, out);
    return;
  }
  out.rigid = part.rigid, out.stressed = part.stressed, out.margin = part.margin, out.flexes = part.flexes;
  out.curvature = part.curvature;
  out.force_residual = part.force_residual;
  spread(s.on, part.carrying, part.force, out);
  count_carrying(subset(s.sub, part.carrying), s.rows.strains, is_below_limit(part.flexes), out);
  if (out.rigid == Verdict::yes && !(out.force_residual < RigidityTuning::most_residual))
    out.rigid = Verdict::undecided;
  if (!part.flex.empty()) s.complete(part.flex, false, out);
}

// A flex of B or its opposite, and as much of the motion that opens all other contacts as keeps them open.
void find_flex(const Supported &s, const StressCone &cone, const RigidityMatrix &carrying, const ConstraintRows &kept,
               const std::vector<double> &f, const std::vector<double> &flex, RigidityResult &out) {
  const ConstraintRows &rows = s.rows;
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> x(rows.columns(), 0.0), y0(rows.rows()), y1(rows.rows());
    scatter(carrying, flex.data(), sign, x);
    for (int q = 0; q < rows.strains; ++q)
      x[s.sub.unknowns() + q] = sign * flex[carrying.unknowns() + q] * rows.length / kept.length;
    if (!cone.motion.empty()) {
      rows.multiply(x.data(), y0.data());
      rows.multiply(cone.motion.data(), y1.data());
      double factor = 0.0;
      for (size_t k = 0; k < rows.rows(); ++k)
        if (!cone.carrying[k]) factor = std::max(factor, -y0[k] / y1[k]);
      for (size_t k = 0; k < x.size(); ++k) x[k] += factor * cone.motion[k];
      // What opens the others is a flex of K+ too, and the curvature of a round wall may hold the sum of both.
      if (s.g.curved != 0 && factor > 0.0 && !opens_by_curvature(carrying, f, x)) continue;
    }
    s.complete(x, s.strain, out);
    if (!out.flex.empty()) return;
  }
}

// K+ and its forces are known: the rank of its rows decides.
void test_rank(const Supported &s, const StressCone &cone, SoftestModes modes, RigidityResult &out) {
  out.stressed = Verdict::yes;
  const RigidityMatrix carrying = subset(s.sub, cone.carrying);
  const ConstraintRows kept(carrying, s.strain);
  if (carrying.contacts() < s.sub.contacts()) {
    NormalSolver inner(kept);
    inner.factorise(std::vector<double>(carrying.contacts(), 1.0), flex_eigenvalue);
    modes = softest_modes(kept, inner, flex_eigenvalue, RigidityTuning::most_flexes);
  }
  out.flexes = modes.count();
  out.margin = modes.margin;
  count_carrying(carrying, s.rows.strains, modes.complete, out);
  std::vector<double> f;
  for (size_t k = 0; k < s.sub.contacts(); ++k)
    if (cone.carrying[k]) f.push_back(cone.force[k]);
  out.force_residual = balance_residual(carrying, f.data());
  const bool doubtful = modes.margin < undecided_eigenvalue || !(out.force_residual < RigidityTuning::most_residual);
  out.rigid = out.flexes > 0 ? Verdict::no : doubtful ? Verdict::undecided : Verdict::yes;
  if (out.flexes == 0) return;
  if (s.g.curved != 0 && modes.complete) test_prestress_stability(carrying, f, modes.flexes, out);
  if (only_slides(modes) && !s.strain) out.slides = out.flexes;
  if (out.rigid == Verdict::no) find_flex(s, cone, carrying, kept, f, flex_of(modes, 0, kept.columns()), out);
}

RigidityResult test_rows(const RigidityMatrix &g, Jamming kind) {
  CallScope::report_share();
  RigidityResult out;
  out.carrying.assign(g.contacts(), 0), out.force.assign(g.contacts(), 0.0);
  out.zero_force_contacts = static_cast<int64_t>(g.contacts());
  const Supported s(g, kind);
  if (s.sub.contacts() == 0) {
    s.complete({}, s.strain, out);
    return out;
  }
  NormalSolver solver(s.rows);
  solver.factorise(std::vector<double>(s.sub.contacts(), 1.0), flex_eigenvalue);
  SoftestModes modes = softest_modes(s.rows, solver, flex_eigenvalue, RigidityTuning::most_flexes);
  const int64_t rank = static_cast<int64_t>(s.rows.columns()) - s.sub.symmetries() - modes.count();
  const int64_t states = modes.complete ? std::max<int64_t>(0, static_cast<int64_t>(s.sub.contacts()) - rank) : -1;
  const StressCone cone = find_stress_cone(s.rows, solver, states);
  out.margin = cone.decided ? 0.0 : modes.margin;
  if (!cone.decided) {
    test_undecided_cone(s, cone, kind, out);
    return out;
  }
  spread(s.on, cone.carrying, cone.force, out);
  if (std::count(cone.carrying.begin(), cone.carrying.end(), 1) == 0)
    s.complete(cone.motion, s.strain, out);
  else
    test_rank(s, cone, std::move(modes), out);
  return out;
}

// What is held in every strain is held in the fixed cell: a motion of the spheres alone is one without strain. Other
// contacts between spheres of the strict K+ carry force too, as their rows depend on its rows.
bool test_by_strict(const RigidityMatrix &g, RigidityResult &out) {
  const RigidityResult strict = test_rows(g, Jamming::strict);
  if (strict.rigid != Verdict::yes) return false;
  StressCone cone;
  cone.positive = strict.carrying;
  for (const double share : RigidityTuning::dependent_forces) {
    cone.path_force = strict.force;
    for (size_t k = 0; k < g.contacts(); ++k)
      if (!strict.carrying[k]) cone.path_force[k] = share;
    RigidityResult part;
    part.zero_force_contacts = static_cast<int64_t>(g.contacts());
    if (!test_from_rigid_part(g, cone, Jamming::collective, part) || part.rigid != Verdict::yes) return false;
    for (size_t k = 0; k < g.contacts(); ++k) part.carrying[k] = part.force[k] > 0.0;
    count_carrying(subset(g, part.carrying), 0, is_below_limit(part.flexes), part);
    if (!(part.force_residual < RigidityTuning::most_residual)) continue;
    out = std::move(part);
    return true;
  }
  return false;
}

// Spheres whose contact vectors nearly but not quite balance, as two that are opposite except for 1e-6, carry no force,
// and each can slip out. Vectors are known to rounding, so that none is too near to a balance. Without them the rest
// may be proved jammed. False where it is not.
bool test_without_unbalanced(const RigidityMatrix &g, Jamming kind, RigidityResult &out) {
  std::vector<char> clear(g.contacts(), 1), on(g.contacts(), 1);
  const auto nodes = static_cast<size_t>(g.nodes);
  release_unbalanced(g.dim, nodes, g.a, g.b, g.normal, on, direction_errors(g));
  drop_unbalanced(g.dim, nodes, g.a, g.b, g.normal, clear);
  if (on == clear || std::count(on.begin(), on.end(), 1) == 0) return false;
  const RigidityMatrix rest = subset(g, on);
  RigidityResult part = test_rows(rest, kind);
  const bool open = part.rigid == Verdict::undecided || (part.rigid == Verdict::no && part.flex.empty());
  if (kind == Jamming::collective && open) test_by_strict(rest, part);
  if (part.rigid != Verdict::yes) return false;
  out = part;
  out.carrying.assign(g.contacts(), 0), out.force.assign(g.contacts(), 0.0);
  spread(on, part.carrying, part.force, out);
  out.zero_force_contacts = static_cast<int64_t>(g.contacts()) - out.contacts;
  return true;
}

// A no is proved by its motion. Where none holds up, K+ was not what it seemed, and nothing is decided.
RigidityResult test_motions(const RigidityMatrix &g, Jamming kind) {
  RigidityResult out = test_rows(g, kind);
  if (out.rigid == Verdict::yes || g.contacts() == 0) return out;
  if (test_without_unbalanced(g, kind, out)) return out;
  const bool open = out.rigid == Verdict::undecided || out.flex.empty();
  if (kind == Jamming::collective && open && test_by_strict(g, out)) return out;
  if (out.rigid != Verdict::no || !out.flex.empty()) return out;
  const bool stressed = out.stressed == Verdict::yes, useless = !(out.force_residual < least_rest);
  if (stressed && useless) {
    out = RigidityResult();
    out.carrying.assign(g.contacts(), 0), out.force.assign(g.contacts(), 0.0);
    out.zero_force_contacts = static_cast<int64_t>(g.contacts());
  }
  out.rigid = Verdict::undecided;
  if (!stressed || !(out.force_residual < RigidityTuning::most_residual) || useless) out.stressed = Verdict::undecided;
  return out;
}

// One axis repeats alone: no strain keeps the volume, and a shorter period reduces it. Only contacts of K+ with a
// component along that axis resist. Without them a no needs that no other contact closes.
void test_single_period(const RigidityMatrix &g, RigidityResult &out) {
  int axis = 0, open = 0;
  for (int c = 0; c < g.dim; ++c)
    if (g.open_axes >> c & 1u) axis = c, ++open;
  if (open != 1) return;
  double held = 0.0, closes = 0.0;
  for (size_t k = 0; k < g.contacts(); ++k) {
    double &largest = out.carrying[k] ? held : closes;
    largest = std::max(largest, std::fabs(g.normal[k * g.dim + axis]));
  }
  if (held * held >= undecided_eigenvalue) return;
  out.rigid = Verdict::undecided;
  if (held * held >= flex_eigenvalue || closes * closes >= flex_eigenvalue) return;
  out.rigid = Verdict::no, out.flexes = 1;
  out.flex.assign(g.unknowns(), 0.0), out.strain.assign(static_cast<size_t>(g.dim) * g.dim, 0.0);
  out.strain[axis * (g.dim + 1)] = -1.0;
}

}  // namespace

RigidityResult test_rigidity(const RigidityMatrix &g, Jamming kind) {
  RigidityResult out = test_motions(g, kind);
  if (kind == Jamming::strict && out.rigid == Verdict::yes) test_single_period(g, out);
  return out;
}

}  // namespace jam::inside
