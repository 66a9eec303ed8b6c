// Tests of collective and strict jamming on lattices with known answers, with and without vacancies. Clp and a dense
// rank confirm each verdict.
#include <cmath>
#include <functional>

#include "analysis_networks.hpp"
#include "rigidity_oracle.hpp"
#include "verdict/verdict.hpp"

using namespace jam::inside;
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
    double all = 0.0;
    for (int a = 0; a < d; ++a) {
      double w = r.flex[g.a[k] * d + a] - r.flex[g.b[k] * d + a];
      for (int b = 0; b < d && strain; ++b) w += r.strain[a * d + b] * g.normal[k * d + b] * g.distance[k];
      for (int b = 0; b < d && strain; ++b)
        y[k] += r.strain[a * d + b] * g.normal[k * d + a] * g.normal[k * d + b] * g.distance[k];
      all += w * w;
    }
    // Of length t: overlaps by y^2 / 2 w^2 at most, w across the normal, or by the rounding of positions.
    const double across = std::sqrt(std::max(0.0, all - y[k] * y[k]));
    assert_true(y[k] > -1e-8 * std::max(across, 1e-6));
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
  assert_true(r.rigid != Verdict::undecided);
  assert_int_equal(r.rigid == Verdict::yes, o.jammed);
  for (size_t k = 0; k < g.contacts(); ++k) assert_int_equal(r.carrying[k], o.carrying[k]);
  if (r.stressed == Verdict::yes) assert_int_equal(r.flexes, o.flexes);
  check_stress(g, r);
  if (r.rigid == Verdict::no && g.contacts() > 0) check_flex(g, r, strain);
  if (r.rigid == Verdict::yes) assert_true(r.flex.empty());
  return r;
}

void expect(const Case &c, bool collective, int64_t flexes, bool strict, int64_t strict_flexes) {
  const RigidityMatrix g = rows_of(c);
  const RigidityResult a = confirmed(g, Jamming::collective), b = confirmed(g, Jamming::strict);
  if (a.contacts > 0) assert_int_equal(a.contacts_needed, g.dim * (a.spheres - 1) + 1);
  if (b.contacts > 0) assert_int_equal(b.contacts_needed, g.dim * (b.spheres - 1) + g.dim * (g.dim + 1) / 2);
  assert_int_equal(a.rigid == Verdict::yes, collective);
  if (flexes >= 0) assert_int_equal(a.flexes, flexes);
  assert_int_equal(b.rigid == Verdict::yes, strict);
  if (strict_flexes >= 0) assert_int_equal(b.flexes, strict_flexes);
}

CASE(squares_and_cubes) {
  expect(square(6), false, 10, false, 11);
  expect(cubic(4), false, 45, false, 48);
}

CASE(close_packed) {
  expect(fcc(3), true, 0, true, 0);
  expect(triangular(8), true, 0, true, 0);
}

CASE(vacancies) {
  expect(without(fcc(4), [](int i) { return i == 7; }), true, 0, true, 0);
  expect(without(triangular(8), [](int i) { return i == 9; }), true, 0, true, 0);
  expect(without(triangular(8), [](int i) { return i == 9 || i == 10; }), false, 2, false, -1);
  expect(without(triangular(8), [](int i) { return i >= 9 && i < 12; }), false, 6, false, -1);
}

CASE(open_lattices) {
  // Honeycomb and kagome: a triangular lattice without a third and a quarter of its spheres.
  expect(without(triangular(6), [](int i) { return (i % 6 + 12 - i / 6) % 3 == 0; }), false, -1, false, -1);
  expect(without(triangular(6), [](int i) { return i % 2 == 0 && i / 6 % 2 == 0; }), false, -1, false, -1);
}

// ---- amorphous packings and what becomes of them

Verdict answer_of(const Packing &p, Jamming kind = Jamming::collective) {
  return test_packing(p, nullptr, kind).jammed;
}

// The contacts that the test looked at, as a list for the oracle.
RigidityMatrix list_of(const Packing &p) {
  return make_rigidity_matrix(p, test_packing(p, nullptr, Jamming::collective).contacts);
}

CASE(amorphous) {
  for (const int dim : {2, 3}) {
    Sys s;
    make(s, dim, 64, dim);
    const Packing &p = s.sys->packing;
    const RigidityMatrix g = list_of(p);
    const RigidityResult r = confirmed(g, Jamming::collective);
    assert_true(r.rigid == Verdict::yes);
    assert_true(r.contacts >= r.contacts_needed && r.margin > 1e-8 && r.force_residual < 1e-10);
    // A fixed cube does not make it strictly jammed: too few contacts.
    assert_true(confirmed(g, Jamming::strict).rigid == Verdict::no);
    // Without any one sphere of the backbone nothing is left that carries force.
    Packing fewer = p;
    const int32_t gone = g.sphere[static_cast<size_t>(g.a[0])];
    fewer.diameter.erase(fewer.diameter.begin() + gone);
    fewer.position.erase(fewer.position.begin() + gone * dim, fewer.position.begin() + (gone + 1) * dim);
    const RigidityResult hole = confirmed(list_of(fewer), Jamming::collective);
    assert_true(hole.stressed == Verdict::no && hole.rigid == Verdict::no);
    assert_int_equal(hole.contacts, 0);
    // A gap of 1e-3 everywhere.
    Packing shrunk = p;
    for (double &x : shrunk.diameter) x *= 1.0 - 1e-3;
    assert_true(answer_of(shrunk) == Verdict::no);
    // Gaps are known to 1e-15: nothing touches.
    for (const double gap : {3e-10, 1e-9, 1e-8, 1e-7, 1e-6}) {
      Packing close = p;
      for (double &x : close.diameter) x *= 1.0 - gap;
      const PackingVerdict v = test_packing(close, nullptr, Jamming::collective);
      assert_true(v.jammed == Verdict::no && v.result.stressed == Verdict::no);
      assert_true(answer_of(close, Jamming::strict) == Verdict::no);
      assert_int_equal(v.result.flex.size(), v.sphere.size() * static_cast<size_t>(dim));
      assert_true(check_as_it_is(close).report.reason == JAM_CHECK_APART);
    }
  }
}

CASE(rattlers_by_force_alone) {
  // A triangular lattice with a hole of seven sites. Three spheres that touch each other rattle in it: they have two
  // contacts each, and no force.
  Case c = without(triangular(8), [](int i) {
    const int x = i % 8 - 4, y = i / 8 - 4;
    return std::abs(x) <= 1 && std::abs(y) <= 1 && std::abs(x + y) <= 1;
  });
  const RigidityResult before = confirmed(rows_of(c), Jamming::collective);
  for (const auto &at : {std::pair<double, double>{5.5, 3.2}, {6.2, 3.2}, {5.85, 3.2 + 0.7 * std::sqrt(0.75)}}) {
    c.packing.position.insert(c.packing.position.end(), {at.first, at.second});
    c.packing.diameter.push_back(0.7);
  }
  const int first = static_cast<int>(c.packing.n()) - 3;
  c.network.coordination.resize(c.packing.n());
  add_contact(c, first, first + 1, {0.0, 0.0});
  add_contact(c, first, first + 2, {0.0, 0.0});
  add_contact(c, first + 1, first + 2, {0.0, 0.0});
  const RigidityResult after = confirmed(rows_of(c), Jamming::collective);
  assert_int_equal(after.spheres, before.spheres);
  assert_int_equal(after.contacts, before.contacts);
  assert_int_equal(after.zero_force_contacts, before.zero_force_contacts + 3);
  // A row across the box: each of its spheres has two contacts and carries force.
  Case row;
  row.packing.set_cube(2, 4.0);
  for (int i = 0; i < 4; ++i) row.packing.position.insert(row.packing.position.end(), {i + 0.0, 1.0});
  row.packing.diameter.assign(4, 1.0);
  for (int i = 0; i < 4; ++i) add_contact(row, i, (i + 1) % 4, {i == 3 ? -4.0 : 0.0, 0.0});
  const RigidityResult r = confirmed(rows_of(row), Jamming::collective);
  assert_int_equal(r.undercoordinated, 4);
  assert_int_equal(r.flexes, 3);
  // A square sheet across the box: its eight rows slide, and all spheres can leave the plane, less three translations.
  Case sheet;
  sheet.packing.set_cube(3, 4.0);
  for (int i = 0; i < 16; ++i)
    sheet.packing.position.insert(sheet.packing.position.end(), {i % 4 + 0.0, i / 4 + 0.0, 2.0});
  sheet.packing.diameter.assign(16, 1.0);
  for (int i = 0; i < 16; ++i) {
    const int x = i % 4, y = i / 4;
    add_contact(sheet, i, y * 4 + (x + 1) % 4, {x == 3 ? -4.0 : 0.0, 0.0, 0.0});
    add_contact(sheet, i, (y + 1) % 4 * 4 + x, {0.0, y == 3 ? -4.0 : 0.0, 0.0});
  }
  const RigidityResult flat = confirmed(rows_of(sheet), Jamming::collective);
  assert_true(flat.rigid == Verdict::no);
  assert_int_equal(flat.flexes, 8 + 16 - 3);
}

// One sphere of an fcc lattice is smaller: its twelve gaps are 1e-8, too wide for contacts and too narrow to be open
// for certain. The lattice is jammed with them and without them, and the contacts that carry force are closed.
CASE(a_loose_sphere_in_doubt) {
  Packing p = fcc_cube(4);
  p.diameter[9] *= 1.0 - 2e-8;
  const PackingVerdict v = test_packing(p, nullptr, Jamming::collective);
  assert_true(v.jammed == Verdict::yes);
  assert_int_equal(v.undecided_contacts, 12);
  assert_int_equal(v.result.spheres, 255);
  assert_int_equal(v.result.contacts, 6 * 256 - 12);
  for (size_t k = 0; k < v.contacts.size(); ++k) assert_true(!v.result.carrying[k] || v.contacts.gap[k] < 1e-10);
}

}  // namespace
