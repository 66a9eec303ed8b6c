#include <algorithm>
#include <cmath>
#include <map>

#include "core/call_scope.hpp"
#include "linalg/dot.hpp"
#include "network/rigidity_test.hpp"
#include "proof/newton.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

void add(std::vector<double> &x, double factor, const std::vector<double> &y) {
  for (size_t k = 0; k < x.size(); ++k) x[k] += factor * y[k];
}

// The states of self-stress of all contacts, less the directions that have been taken out of them.
class States {
 public:
  States(const ProofScene &s, const ProofEquations &e, const NormalMatrix &normal) : s_(s), e_(e), normal_(normal) {}
  // x := the nearest to it among them.
  void project(std::vector<double> &x) const {
    std::vector<double> part(x.size());
    multiply_rows(s_, e_, normal_.nearest(x).data(), part.data());
    add(x, -1.0, part);
    for (int pass = 0; pass < 2; ++pass)  // the second one takes out what rounding left
      for (const std::vector<double> &q : out_) add(x, -dot(q, x), q);
  }
  // Only states with x . y = 0 are left, of x as well.
  void take_out(std::vector<double> y, std::vector<double> &x) {
    const double before = std::sqrt(dot(y, y));
    project(y);
    const double length = std::sqrt(dot(y, y));
    if (!(length > proof_tuning::vanishing * before)) return;  // no state that is left has a part along y
    for (double &v : y) v /= length;
    add(x, -dot(y, x), y);
    out_.push_back(std::move(y));
  }

 private:
  const ProofScene &s_;
  const ProofEquations &e_;
  const NormalMatrix &normal_;
  std::vector<std::vector<double>> out_;
};

// The contacts that close together, as flags; f becomes a force on them. For all forces in balance with
// sum f sigma^2 = 1, Gamma <= sum f |r|^2 to first order. Where Newton's steps end, no motion lessens the gaps r = F:
// they balance like forces, and f - t r has a lower bound of Gamma. The contact whose force vanishes first is open once
// the others close. Then r is what stays of the others' gaps.
std::vector<char> closing_together(const ProofScene &s, const ProofEquations &e, const NormalMatrix &normal,
                                   std::vector<double> &force) {
  std::vector<char> on(s.contacts(), 1);
  std::vector<double> r(e.f);
  States states(s, e, normal);
  states.project(r);
  states.take_out(e.sigma2, r);  // the scale of forces stays
  for (const double end = proof_tuning::vanishing * largest_entry(r); largest_entry(r) > end;) {
    CallScope::look();
    const double noise = proof_tuning::vanishing * largest_entry(r);
    size_t first = s.contacts();
    for (size_t c = 0; c < s.contacts(); ++c)
      if (on[c] && r[c] > noise && (first == s.contacts() || force[c] * r[first] < force[first] * r[c])) first = c;
    if (first == s.contacts()) break;
    add(force, -force[first] / r[first], r);
    for (double &f : force) f = std::max(0.0, f);
    std::vector<double> unit(s.contacts(), 0.0);
    unit[first] = 1.0;
    on[first] = 0;
    states.take_out(std::move(unit), r);
    for (size_t c = 0; c < s.contacts(); ++c)
      if (!on[c]) force[c] = r[c] = 0.0;
  }
  return on;
}

bool is_stable(const ProofScene &s, const NearPair &pair) {
  return s.node[pair.i] >= 0 && (pair.j < 0 || s.node[pair.j] >= 0);
}

void add_contact(ProofScene &s, const NearPair &pair) {
  s.a.push_back(s.node[pair.i]), s.b.push_back(pair.j < 0 ? pair.j : s.node[pair.j]), s.force.push_back(0.0);
  s.image.insert(s.image.end(), pair.image.begin(), pair.image.end());
}

RigidityMatrix rows_of(const ProofScene &s) {
  const ProofEquations e = evaluate(s);
  RigidityMatrix g;
  g.dim = s.dim, g.nodes = static_cast<int32_t>(s.nodes()), g.sphere = s.sphere, g.node = s.node;
  g.a = s.a, g.b = s.b;
  if (s.container) take_symmetries(s.container, s.high.data(), g);
  g.curved = 0;  // rows alone count
  for (size_t c = 0; c < s.contacts(); ++c) {
    const double square = squared(&e.row[c * s.dim], s.dim);
    for (int k = 0; k < s.dim; ++k) g.normal.push_back(e.row[c * s.dim + k] / std::sqrt(square));
    const double part = s.wall(c) ? 0.5 : 1.0;  // of the mirror image's distance
    const double length = 0.5 * std::sqrt(square), sigma2 = s.sigma_squared(c).value();
    g.distance.push_back(part * (s.round(s.b[c]) ? s.cell.edge(0) - length : length));
    g.sigma.push_back(part * std::sqrt(s.gamma() * sigma2));
  }
  return g;
}

void add_closed_pairs(ProofScene &s, double opening) {
  for (const NearPair &pair : near_pairs(s))
    if (pair.opening <= opening && is_stable(s, pair)) add_contact(s, pair);
}

// All closed pairs become contacts, with the forces that the test of jamming finds in the middle of all states. Those
// without force leave again. Where their test finds no jammed packing, pairs that are open by far less than second
// orders of any motion are taken too. False where that does not hold the spheres either.
bool take_middle_forces(ProofScene &scene) {
  std::vector<char> on;
  for (const double opening : {proof_tuning::closed, proof_tuning::nearly_closed * scene.gamma()}) {
    ProofScene s = scene;
    add_closed_pairs(s, opening);
    const RigidityMatrix g = rows_of(s);
    const RigidityResult r = test_rigidity(g, Jamming::collective);
    if (r.rigid != Verdict::yes) continue;
    for (size_t c = 0; c < s.contacts(); ++c) {
      const bool round = s.round(s.b[c]);
      s.force[c] = r.force[c] / (round ? s.lever(c) * std::sqrt(s.gamma()) : (s.wall(c) ? 4.0 : 1.0) * g.sigma[c]);
      on.push_back(r.force[c] > 0.0);
    }
    keep_contacts(s, on);
    scene = std::move(s);
    return true;
  }
  for (const double f : scene.force) on.push_back(f > 0.0);
  keep_contacts(scene, on);
  return false;
}

enum class Round { closed, changed, stuck };

// One round: Newton's steps to the least gaps, then one kind of exchange.
Round exchange_once(ProofScene &s) {
  ProofEquations e = evaluate(s);
  if (!approach_closure(s, e)) return Round::stuck;
  if (largest_entry(e.f) > proof_tuning::closed) {
    NormalMatrix normal(s, e);
    if (!normal.factorise()) return Round::stuck;
    refine_forces(s, e, normal);
    const std::vector<char> on = closing_together(s, e, normal, s.force);
    if (std::count(on.begin(), on.end(), 0) == 0) return Round::stuck;
    keep_contacts(s, on);
    return s.contacts() > 0 ? Round::changed : Round::stuck;
  }
  Round end = Round::closed;
  for (const NearPair &pair : near_pairs(s))
    if (pair.opening < -proof_tuning::closed && is_stable(s, pair)) add_contact(s, pair), end = Round::changed;
  return end;
}

}  // namespace

Exchange close_together(ProofScene &scene, LpsEnd *lps) {
  ProofScene s = scene;
  Round round = Round::changed;
  bool changed = false;
  for (int k = 0; k < proof_tuning::most_rounds && round == Round::changed; ++k) {
    round = exchange_once(s);
    changed = changed || round == Round::changed;
  }
  if (round != Round::closed) {
    const LpsEnd end = close_by_lps(scene);
    if (lps) *lps = end;
    return end == LpsEnd::closed ? Exchange::changed : Exchange::endless;
  }
  scene = std::move(s);
  return changed ? Exchange::changed : Exchange::same;
}

Settled finish_exchange(ProofScene &scene, Exchange end) {
  if (end == Exchange::endless) return Settled::unchanged;
  ProofScene s = scene;
  const Settled out = take_middle_forces(s) ? Settled::held : Settled::changed;
  free_rattlers(s);
  scene = std::move(s);
  return out;
}

namespace {

double scale_of(const ProofScene &s) {
  double sum = 0.0;
  for (size_t c = 0; c < s.contacts(); ++c) sum += s.force[c] * s.weight(c);
  return sum;
}

}  // namespace

void mix_in_forces_of_closed(ProofScene &settled, const ProofScene &closed) {
  const size_t d = static_cast<size_t>(closed.dim);
  const auto key = [d](const ProofScene &s, size_t c) {
    const auto at = s.image.begin() + static_cast<std::ptrdiff_t>(c * d);
    std::vector<int32_t> out{s.sphere[s.a[c]], s.partner(c)};
    out.insert(out.end(), at, at + static_cast<std::ptrdiff_t>(d));
    return out;
  };
  std::map<std::vector<int32_t>, double> force;
  const double whole = scale_of(closed), part = proof_tuning::leaning / scale_of(settled);
  for (size_t c = 0; c < closed.contacts(); ++c) force[key(closed, c)] = std::max(0.0, closed.force[c]) / whole;
  for (size_t c = 0; c < settled.contacts(); ++c) {
    const auto at = force.find(key(settled, c));
    settled.force[c] = part * settled.force[c] + (at == force.end() ? 0.0 : at->second);
  }
}

}  // namespace jam::inside
