// Contact networks and states of self-stress from positions alone, also where they fail.
#include <functional>
#include "analysis/modes.hpp"
#include "analysis_networks.hpp"
#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/rng.hpp"
#include "network/contacts_from_geometry.hpp"
#include "test.h"
#include "verdict/verdict.hpp"

using namespace jam::inside;
using namespace jamtest;

namespace {

struct Look : GeometryResult {
  PackingVerdict verdict;
  jam_status status = JAM_OK;
};

Look look(const Packing &p, double tolerance = 0.0) {
  jam_geometry_options o = default_geometry_options();
  o.tolerance = tolerance;
  Look out;
  static_cast<GeometryResult &>(out) = contacts_from_geometry(p, o);
  const GapResolution resolution = gap_resolution(p);
  out.verdict = verdict_of(without_overlaps(p), &out.network, Jamming::collective);
  out.status = status_of(out, out.verdict.jammed, resolution, p);
  return out;
}

CASE(fcc) {
  const Packing p = fcc_cube(3);
  const Look r = look(p);
  assert_int_equal(r.status, JAM_AMBIGUOUS);  // hyperstatic: more than one state of self-stress
  assert_int_equal(r.report.contacts, 6 * 108);
  assert_int_equal(r.report.excess_contacts, 6 * 108 - (3 * 107 + 1));
  assert_int_equal(r.report.clusters, 1);
  assert_int_equal(r.report.second_contacts, -1);  // a clear case has one candidate
  // rank from the dense spectrum
  const RigidityMatrix g = make_rigidity_matrix(p, r.network);
  Monitor monitor;
  Modes modes;
  jam_modes_options o = default_modes_options();
  o.which = JAM_MODES_ALL;
  assert_int_equal(find_modes(g, contact_weights(g, 1.0, default_hessian_options()), o, monitor, modes), JAM_OK);
  int64_t zeros = 0;
  for (double l : modes.lambda) zeros += std::fabs(l) < 1e-10;
  assert_int_equal(r.report.zero_modes, zeros);
  assert_int_equal(r.report.self_stresses, 6 * 108 - (3 * 108 - zeros));
  for (double f : r.network.force) assert_true(std::fabs(f - 1.0) < 1e-12);  // by symmetry the least norm is uniform
  assert_true(r.report.force_residual < 1e-13);
  const StressStates s = find_stress(g, true);
  const size_t m = g.contacts();
  std::vector<double> y(g.unknowns());
  for (int64_t k = 0; k < s.dimension; ++k) {
    apply_equilibrium(g, &s.basis[static_cast<size_t>(k) * m], y.data());
    for (double v : y) assert_true(std::fabs(v) < 1e-12);
  }
  assert_int_equal(s.basis.size(), static_cast<size_t>(s.dimension) * m);
}

CASE(one_cell_with_many_images) {
  const Look r = look(fcc_cube(1));  // four spheres, each pair touching through four images
  assert_int_equal(r.report.contacts, 24);
  assert_int_equal(r.status, JAM_AMBIGUOUS);
  for (double f : r.network.force) assert_true(std::fabs(f - 1.0) < 1e-12);
}

CASE(own_image) {
  Packing p;
  p.set_cube(3, 1.0);
  p.position = {0.1, 0.2, 0.3};
  p.diameter = {1.0};
  const Look r = look(p);
  assert_int_equal(r.status, JAM_NOT_JAMMED);
  assert_int_equal(r.report.self_contacts, 3);
  assert_int_equal(r.report.contacts, 0);
}

CASE(fluid_is_not_jammed) {
  jam_create_options o = default_create_options();
  o.n = 200;
  const Look r = look(make_packing(o, nullptr, 0, nullptr, 0));
  assert_int_equal(r.status, JAM_NOT_JAMMED);
  assert_true(r.verdict.jammed == Verdict::no);
  assert_int_equal(r.report.contacts, 0);
  for (int32_t z : r.network.coordination) assert_int_equal(z, 0);
}

CASE(separate_clusters_have_separate_stresses) {
  // Two strips of three triangular rows: only the horizontal lines can carry repulsive forces.
  Packing p;
  p.set_cube(2, 6.0);
  const double h = std::sqrt(0.75);
  for (int strip = 0; strip < 2; ++strip)
    for (int row = 0; row < 3; ++row)
      for (int i = 0; i < 6; ++i)
        p.position.insert(p.position.end(), {i + 0.5 * (row % 2), 0.1 + 3.0 * strip + row * h});
  p.diameter.assign(36, 1.0);
  const Look r = look(p, 1e-9);
  assert_int_equal(r.report.contacts, 2 * (18 + 24));
  assert_int_equal(r.report.clusters, 2);
  assert_true(r.report.second_jump == 1.0 && r.report.second_contacts == -1);  // no other candidate
  assert_int_equal(r.report.zero_modes, 4);                                    // each strip has its two translations
  assert_int_equal(r.status, JAM_NOT_JAMMED);
  const RigidityMatrix g = make_rigidity_matrix(p, r.network);
  for (size_t k = 0; k < g.contacts(); ++k) {
    const bool flat = std::fabs(g.normal[2 * k + 1]) < 1e-9;
    assert_true(std::fabs(r.network.force[k] - (flat ? 84.0 / 36.0 : 0.0)) < 1e-9);
  }
}

CASE(without_a_clear_jump_the_answer_is_ambiguous) {
  // A crystal whose spheres are shaken by 1e-3: its gaps have no decade without a pair.
  Packing p = fcc_cube(3);
  Rng rng(1, Stream::analysis_start);
  for (double &x : p.position) x = wrap(x + 1e-3 * rng.normal(), p.cell.side());
  const Look r = look(p);
  assert_true(r.status == JAM_AMBIGUOUS || r.status == JAM_NOT_JAMMED);
  assert_true(r.report.jump < 1e3);
  assert_true(r.report.second_contacts >= 0 && r.report.second_jump <= r.report.jump);
  for (const bool second : {false, true}) {  // each of the two is what its tolerance gives
    const double tolerance = second ? r.report.second_tolerance : r.report.tolerance;
    const int64_t contacts = second ? r.report.second_contacts : r.report.contacts;
    assert_true(look(p, tolerance).report.contacts <= contacts);  // forces can balance on fewer
  }
}

CASE(networks_without_repulsive_balance_are_not_jammed) {
  // Four disks with six bars, sides and diagonals: the self-stress of one such square pulls where it does not push. Two
  // of them have two states, and no combination repels everywhere.
  Case c;
  c.packing.set_cube(2, 10.0);
  for (double shift : {1.0, 5.0})
    for (int k = 0; k < 4; ++k) {
      c.packing.position.insert(c.packing.position.end(), {shift + (k & 1), 2.0 + (k >> 1)});
      c.packing.diameter.push_back(1.0);
    }
  for (int first : {0, 4})
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) add_contact(c, first + i, first + j, {0.0, 0.0});
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  const StressStates s = find_stress(g, true);
  assert_int_equal(s.dimension, 2);
  assert_false(s.positive);
  assert_true(s.residual < 1e-12 && s.min_force < 0.0);  // a balance, but no repulsive one
  assert_true(test_rigidity(g, Jamming::collective).stressed == Verdict::no);
}

CASE(cancelling_anywhere_leaves_no_network) {
  // A cancel that comes late: each of the long parts asks by itself.
  const Case c = lattice(triangular_basis(), triangular_bonds(), 4);
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  const NullSpace space(g);
  Monitor monitor;
  monitor.cancel();
  const CancellableScope scope(default_memory_limit(), &monitor);
  std::vector<double> f(g.contacts(), 1.0);
  f[0] = 2.0;
  int stopped = 0;
  const auto stops = [&](const std::function<void()> &call) {
    try {
      call();
    } catch (const Cancelled &) {
      ++stopped;
    }
  };
  stops([&] { space.project(f); });
  stops([&] { space.zero_modes(); });
  stops([&] { test_rigidity(g, Jamming::collective); });
  stops([&] { find_stress(g, space, true); });
  assert_int_equal(stopped, 4);
}

CASE(spheres_held_from_one_side_carry_no_force) {
  // A sphere held by three contacts on one side only: S^T f = 0 has solutions on the rest alone.
  Case c = lattice(triangular_basis(), triangular_bonds(), 4);
  c.packing.diameter.push_back(1.0);
  c.packing.position.insert(c.packing.position.end(), {0.9, 0.3});
  add_contact(c, 0, 16, {0.0, 0.0});
  add_contact(c, 1, 16, {0.0, 0.0});
  const StressStates s = find_stress(make_rigidity_matrix(c.packing, c.network), false);
  assert_true(s.positive);
  assert_true(s.force[48] < 1e-9 && s.force[49] < 1e-9);
}

}  // namespace
