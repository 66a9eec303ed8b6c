// Tests of collective and strict jamming on lattices with known answers, with and without vacancies. Clp and a dense
// rank confirm each verdict.
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

#include "analysis_networks.hpp"
#include "core/create.hpp"
#include "core/rng.hpp"
#include "network/rigidity_test.hpp"
#include "rigidity_oracle.hpp"
// Last: cmocka defines a macro `fail`.
extern "C" {
#include "test.h"
}

using namespace jam;
using namespace jamtest;

namespace {

RigidityMatrix rows_of(const Case &c) { return make_rigidity_matrix(c.packing, c.network); }

// Contacts of removed spheres go.
Case without(const Case &c, const std::function<bool(int)> &removed) {
  Case out;
  out.packing = c.packing;
  for (size_t k = 0; k < c.network.size(); ++k) {
    const int i = c.network.pairs.i[k], j = c.network.pairs.j[k], d = c.packing.dim;
    if (removed(i) || removed(j)) continue;
    const double *o = &c.network.pairs.offset[k * d];
    add_contact(out, i, j, std::vector<double>(o, o + d));
  }
  out.network.coordination.resize(c.packing.n());
  return out;
}

Case square(int cells) { return lattice(square_basis(), square_bonds(), cells); }
Case cubic(int cells) { return lattice({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, cells); }
Case fcc(int cells) { return lattice(fcc_basis(), fcc_bonds(), cells); }
Case triangular(int cells) { return lattice(triangular_basis(), triangular_bonds(), cells); }

void check_stress(const RigidityMatrix &g, const RigidityResult &r) {
  std::vector<double> y(g.unknowns());
  apply_equilibrium(g, r.force.data(), y.data());
  for (const double v : y) assert_true(std::fabs(v) < 1e-10);
  double mean = 0.0;
  for (size_t k = 0; k < g.contacts(); ++k) {
    assert_true(r.carrying[k] ? r.force[k] > 0.0 : r.force[k] == 0.0);
    mean += r.force[k];
  }
  if (r.contacts > 0) assert_true(std::fabs(mean / static_cast<double>(r.contacts) - 1.0) < 1e-9);
}

// Every contact stays or opens, and not all nodes move together.
void check_flex(const RigidityMatrix &g, const RigidityResult &r, bool strain) {
  assert_int_equal(r.flex.size(), g.unknowns());
  std::vector<double> y(g.contacts());
  apply_compatibility(g, r.flex.data(), y.data());
  const int d = g.dim;
  double trace = 0.0, size = 0.0;
  for (size_t k = 0; k < g.contacts(); ++k) {
    for (int a = 0; a < d && strain; ++a)
      for (int b = 0; b < d; ++b)
        y[k] += r.strain[a * d + b] * g.normal[k * d + a] * g.normal[k * d + b] * g.distance[k];
    assert_true(y[k] > -1e-8);
  }
  for (int a = 0; a < d && strain; ++a) trace += r.strain[a * d + a];
  for (double e : r.strain) size = std::max(size, std::fabs(e));
  assert_true(trace < 1e-12);
  for (int32_t i = 1; i < g.nodes; ++i)
    for (int c = 0; c < d; ++c) size = std::max(size, std::fabs(r.flex[i * d + c] - r.flex[c]));
  assert_true(size > 1e-3);
}

RigidityResult confirmed(const RigidityMatrix &g, Jamming kind) {
  const RigidityResult r = test_rigidity(g, kind);
  const bool strain = kind == Jamming::strict;
  const Oracle o = ask_oracle(g, strain);
  assert_true(r.jammed != Verdict::undecided);
  assert_int_equal(r.jammed == Verdict::yes, o.jammed);
  for (size_t k = 0; k < g.contacts(); ++k) assert_int_equal(r.carrying[k], o.carrying[k]);
  if (r.stressed == Verdict::yes) assert_int_equal(r.flexes, o.flexes);
  check_stress(g, r);
  if (r.jammed == Verdict::no && g.contacts() > 0) check_flex(g, r, strain);
  if (r.jammed == Verdict::yes) assert_true(r.flex.empty());
  return r;
}

void expect(const Case &c, bool collective, int64_t flexes, bool strict, int64_t strict_flexes) {
  const RigidityMatrix g = rows_of(c);
  const RigidityResult a = confirmed(g, Jamming::collective), b = confirmed(g, Jamming::strict);
  if (getenv("SHOW"))
    printf("collective %d flexes %lld strict %d flexes %lld  margin %g %g carrying %lld %lld of %zu bridges %lld\n",
           (int)a.jammed, (long long)a.flexes, (int)b.jammed, (long long)b.flexes, a.margin, b.margin,
           (long long)a.contacts, (long long)b.contacts, g.contacts(), (long long)a.bridges);
  assert_int_equal(a.jammed == Verdict::yes, collective);
  if (flexes >= 0) assert_int_equal(a.flexes, flexes);
  assert_int_equal(b.jammed == Verdict::yes, strict);
  if (strict_flexes >= 0) assert_int_equal(b.flexes, strict_flexes);
}

void squares_and_cubes(void **) {
  expect(square(6), false, 10, false, 11);
  expect(cubic(4), false, 45, false, 48);
}
void close_packed(void **) {
  expect(fcc(3), true, 0, true, 0);
  expect(triangular(8), true, 0, true, 0);
}
void vacancies(void **) {
  expect(without(fcc(4), [](int i) { return i == 7; }), true, 0, true, 0);
  expect(without(triangular(8), [](int i) { return i == 9; }), true, 0, true, 0);
  expect(without(triangular(8), [](int i) { return i == 9 || i == 10; }), false, 2, false, -1);
  expect(without(triangular(8), [](int i) { return i >= 9 && i < 12; }), false, 6, false, -1);
}
void open_lattices(void **) {
  expect(without(triangular(6), [](int i) { return (i % 6 + 12 - i / 6) % 3 == 0; }), false, -1, false, -1);
  expect(without(triangular(6), [](int i) { return i % 2 == 0 && i / 6 % 2 == 0; }), false, -1, false, -1);
}

}  // namespace

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(squares_and_cubes), cmocka_unit_test(close_packed),
                                     cmocka_unit_test(vacancies), cmocka_unit_test(open_lattices)};
  return cmocka_run_group_tests_name("network_rigidity", tests, nullptr, nullptr);
}
