#include "proof/closing.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "network/rigidity_test.hpp"
#include "proof/newton.hpp"
#include "proof/open_gaps.hpp"
#include "proof/outward.hpp"
#include "proof/tuning.hpp"

namespace jam {
namespace {

double product(const std::vector<double> &x, const std::vector<double> &y) {
  double sum = 0.0;
  for (size_t k = 0; k < x.size(); ++k) sum += x[k] * y[k];
  return sum;
}

void add(std::vector<double> &x, double factor, const std::vector<double> &y) {
  for (size_t k = 0; k < x.size(); ++k) x[k] += factor * y[k];
}

double largest(const std::vector<double> &x) {
  double most = 0.0;
  for (const double v : x) most = std::max(most, std::fabs(v));
  return most;
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
      for (const std::vector<double> &q : out_) add(x, -product(q, x), q);
  }
  // Only states with x . y = 0 are left, of x as well.
  void take_out(std::vector<double> y, std::vector<double> &x) {
    const double before = std::sqrt(product(y, y));
    project(y);
    const double length = std::sqrt(product(y, y));
    if (!(length > proof_tuning::vanishing * before)) return;  // no state that is left has a part along y
    for (double &v : y) v /= length;
    add(x, -product(y, x), y);
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
  for (const double end = proof_tuning::vanishing * largest(r); largest(r) > end;) {
    CallScope::look();
    const double noise = proof_tuning::vanishing * largest(r);
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

bool is_stable(const ProofScene &s, const NearPair &pair) { return s.node[pair.i] >= 0 && s.node[pair.j] >= 0; }

void add_contact(ProofScene &s, const NearPair &pair) {
  s.a.push_back(s.node[pair.i]), s.b.push_back(s.node[pair.j]), s.force.push_back(0.0);
  s.image.insert(s.image.end(), pair.image.begin(), pair.image.end());
}

RigidityMatrix rows_of(const ProofScene &s) {
  const ProofEquations e = evaluate(s);
  RigidityMatrix g;
  g.dim = s.dim, g.nodes = static_cast<int32_t>(s.nodes()), g.sphere = s.sphere, g.node = s.node;
  g.a = s.a, g.b = s.b;
  for (size_t c = 0; c < s.contacts(); ++c) {
    double square = 0.0;
    for (int k = 0; k < s.dim; ++k) square += e.row[c * s.dim + k] * e.row[c * s.dim + k];
    for (int k = 0; k < s.dim; ++k) g.normal.push_back(e.row[c * s.dim + k] / std::sqrt(square));
    g.distance.push_back(0.5 * std::sqrt(square)), g.sigma.push_back(std::sqrt(s.gamma * e.sigma2[c]));
  }
  return g;
}

void add_closed_pairs(ProofScene &s) {
  for (const NearPair &pair : near_pairs(s))
    if (pair.opening <= proof_tuning::closed && is_stable(s, pair)) add_contact(s, pair);
}

// All closed pairs become contacts, with the forces that the test of jamming finds in the middle of all states. Those
// without force leave again.
void take_middle_forces(ProofScene &s) {
  add_closed_pairs(s);
  const RigidityMatrix g = rows_of(s);
  const RigidityResult r = test_rigidity(g, Jamming::collective);
  if (r.jammed == Verdict::yes)
    for (size_t c = 0; c < s.contacts(); ++c) s.force[c] = r.force[c] / g.sigma[c];
  std::vector<char> on;
  for (const double f : s.force) on.push_back(f > 0.0);
  keep_contacts(s, on);
}

// A direction with a positive component along each vector, where the search finds one (F. Rosenblatt's perceptron).
bool way_out(size_t d, const std::vector<double> &vectors, std::vector<double> &way) {
  way.assign(d, 0.0);
  for (int turn = 0; turn < proof_tuning::turns; ++turn) {
    double least = HUGE_VAL;
    size_t worst = 0;
    for (size_t k = 0; k < vectors.size(); k += d) {
      double along = 0.0;
      for (size_t c = 0; c < d; ++c) along += vectors[k + c] * way[c];
      if (along < least) least = along, worst = k;
    }
    if (least > 0.0) return true;
    for (size_t c = 0; c < d; ++c) way[c] += vectors[worst + c];
  }
  return false;
}

// A rattler that overlaps moves away from the pairs that it nearly touches, as far as it leaves all others open.
bool free_rattler(ProofScene &s, int32_t i, const std::vector<NearPair> &pairs) {
  const size_t d = static_cast<size_t>(s.dim);
  std::vector<NearPair> own;
  std::vector<double> vectors, way;
  for (const NearPair &pair : pairs) {
    if (pair.i != i && pair.j != i) continue;
    own.push_back(pair);
    if (pair.opening > proof_tuning::freed * s.gamma) continue;
    Cell::Vector r{};
    double square = 0.0;
    for (size_t c = 0; c < d; ++c) {
      r[c] = s.high[pair.i * d + c] - s.high[pair.j * d + c];
      for (size_t q = c; q < d; ++q) r[c] += pair.image[q] * s.cell.row(static_cast<int>(q))[c];
      square += r[c] * r[c];
    }
    for (size_t c = 0; c < d; ++c) vectors.push_back((pair.i == i ? r[c] : -r[c]) / std::sqrt(square));
  }
  if (!way_out(d, vectors, way)) return false;
  double length = 0.0;
  for (const double x : way) length += x * x;
  for (double t = proof_tuning::freed * s.ratio[i] * std::sqrt(s.gamma / length); t > half_ulp; t *= 0.25) {
    const std::vector<double> before(&s.high[i * d], &s.high[i * d] + d);
    for (size_t c = 0; c < d; ++c) s.high[i * d + c] += t * way[c];
    if (std::all_of(own.begin(), own.end(), [&](const NearPair &pair) { return opening_of(s, pair) > 0.0; }))
      return true;
    std::copy(before.begin(), before.end(), &s.high[i * d]);
  }
  return false;
}

enum class Round { closed, changed, stuck };

// One round: Newton's steps to the least gaps, then one kind of exchange.
Round exchange_once(ProofScene &s) {
  ProofEquations e = evaluate(s);
  if (!approach_closure(s, e)) return Round::stuck;
  if (largest(e.f) > proof_tuning::closed) {
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

bool exchange_contacts(ProofScene &scene) {
  ProofScene s = scene;
  Round round = Round::changed;
  bool changed = false;
  for (int k = 0; k < proof_tuning::exchanges && round == Round::changed; ++k) {
    round = exchange_once(s);
    changed = changed || round == Round::changed;
  }
  if (round != Round::closed) return false;
  if (changed) take_middle_forces(s);
  const std::vector<NearPair> pairs = near_pairs(s);
  for (const NearPair &pair : pairs)
    for (const int32_t i : {pair.i, pair.j})
      if (pair.opening < 0.0 && s.node[i] < 0) changed = free_rattler(s, i, pairs) || changed;
  if (changed) scene = std::move(s);
  return changed;
}

}  // namespace jam
