// A sphere between two others of a jammed packing, whose directions are opposite but for a deviation: it carries no
// force, so the packing stays jammed. At a deviation of 0 the three carry force, and the sphere can slip out sideways.
// Clp and a dense rank judge the packing without that sphere.
#include <algorithm>
#include <cmath>

#include "core/pair_rule.hpp"
#include "rigidity_oracle.hpp"
#include "verdict/verdict.hpp"

using namespace jam::inside;
using namespace jamtest;

namespace {

double nearest_gap(const Packing &p, size_t i) {
  double r[JAM_MAX_DIM], least = 1.0;
  const PairList pairs = find_pairs(p, 0.0, 1.5);
  for (size_t k = 0; k < pairs.size(); ++k)
    if (static_cast<size_t>(pairs.i[k]) == i || static_cast<size_t>(pairs.j[k]) == i)
      least =
          std::min(least, std::sqrt(pair_vector(p, pairs, k, r)) / contact_distance(p, pairs.i[k], pairs.j[k]) - 1.0);
  return least;
}

// The packing with one sphere more, that touches the two of pair k at an angle of pi - deviation.
Packing bridged(const Packing &p, const PairList &pairs, size_t k, double deviation) {
  Packing out = p;
  double r[JAM_MAX_DIM];
  const double distance = std::sqrt(pair_vector(p, pairs, k, r));  // from j to i
  const double si = p.diameter[pairs.i[k]], sj = p.diameter[pairs.j[k]];
  double a = distance - 0.5 * (si + sj), sine = std::sin(0.5 * deviation);
  for (int pass = 0; pass < 200; ++pass)
    a = std::sqrt(distance * distance + (si + a) * (sj + a) * sine * sine) - 0.5 * (si + sj);
  const double to_i = 0.5 * (si + a), to_j = 0.5 * (sj + a);
  const double along = (distance * distance + to_j * to_j - to_i * to_i) / (2.0 * distance);
  const double aside = to_i * to_j * std::sin(deviation) / distance;
  double side[JAM_MAX_DIM] = {-r[1] / distance, r[0] / distance, 0.0};
  const double length = std::hypot(side[0], side[1]);
  for (int c = 0; c < p.dim; ++c)
    out.position.push_back(p.position[static_cast<size_t>(pairs.j[k]) * p.dim + c] + along * r[c] / distance +
                           aside * side[c] / length);
  out.diameter.push_back(a);
  return out;
}

// Pairs of force-carrying spheres between which a sphere has room, and touches nothing else.
std::vector<size_t> voids(const Packing &p, const ContactNetwork &net, const PairList &pairs) {
  std::vector<size_t> out;
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < pairs.size() && out.size() < 3; ++k) {
    const double gap = std::sqrt(pair_vector(p, pairs, k, r)) - contact_distance(p, pairs.i[k], pairs.j[k]);
    if (gap < 0.05 * p.diameter[0] || !net.coordination[pairs.i[k]] || !net.coordination[pairs.j[k]]) continue;
    const auto neighbours = [&](double deviation) {
      const PairList list = find_pairs(bridged(p, pairs, k, deviation), 0.0, 1.01);
      const auto last = static_cast<int32_t>(p.n());
      return std::count(list.i.begin(), list.i.end(), last) + std::count(list.j.begin(), list.j.end(), last);
    };
    if (neighbours(0.0) == 2 && neighbours(0.1) == 2) out.push_back(k);
  }
  return out;
}

CASE(deviations) {
  for (const int dim : {2, 3})
    for (const int64_t seed : {1, 2}) {
      Sys s;
      make(s, dim, 24, seed);
      const Packing &p = s.sys->packing;
      const PackingVerdict base = test_packing(p, nullptr, Jamming::collective);
      assert_true(ask_oracle(make_rigidity_matrix(p, base.contacts), false).jammed);
      const PairList pairs = find_pairs(p, 0.0, 1.9);
      const std::vector<size_t> free = voids(p, s.sys->contacts, pairs);
      assert_true(!free.empty());
      for (const size_t k : free)
        for (const double deviation : {0.0, 1e-14, 3e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 3e-6,
                                       1e-5, 3e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
          const Packing q = bridged(p, pairs, k, deviation);
          assert_true(std::fabs(nearest_gap(q, p.n())) < 1e-12);
          const PackingVerdict v = test_packing(q, nullptr, Jamming::collective);
          if (deviation > 0.0) {
            assert_true(v.jammed == Verdict::yes);
            assert_int_equal(v.result.contacts, base.result.contacts);
            assert_int_equal(v.result.spheres, base.result.spheres);
            continue;
          }
          assert_true(v.jammed == Verdict::no && v.result.stressed == Verdict::yes);
          assert_int_equal(v.result.flexes, dim - 1);
          assert_int_equal(v.result.undercoordinated, 1);
          assert_false(ask_oracle(make_rigidity_matrix(q, v.contacts), false).jammed);
        }
    }
}

void add_contact(RigidityMatrix &g, int32_t a, int32_t b, double x, double y) {
  g.a.push_back(a), g.b.push_back(b);
  const double length = std::hypot(x, y);
  g.normal.push_back(x / length), g.normal.push_back(y / length);
  g.distance.push_back(1.0), g.sigma.push_back(1.0);
}

// Rows alone: 16 disks on a triangular lattice; a disk between two of them whose directions are opposite but for
// `tilt`, and that leans on a third one with a force of as much; and three disks, each of which its three contacts may
// balance, but whose ratios of forces contradict each other, so that none of these six carries force.
RigidityMatrix with_weak_and_without(double tilt) {
  RigidityMatrix g;
  g.dim = 2, g.nodes = 20;
  for (int32_t i = 0; i < g.nodes; ++i) g.sphere.push_back(i), g.node.push_back(i);
  const double height = std::sqrt(0.75);
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) {
      const auto at = [&](int dc, int dr) { return (r + dr + 4) % 4 * 4 + (c + dc + 4) % 4; };
      add_contact(g, at(0, 0), at(1, 0), -1.0, 0.0);
      add_contact(g, at(0, 0), at(r % 2, 1), -0.5, -height);
      add_contact(g, at(0, 0), at(r % 2 - 1, 1), 0.5, -height);
    }
  add_contact(g, 16, 0, 1.0, tilt), add_contact(g, 16, 2, -1.0, tilt), add_contact(g, 16, 9, 0.0, -1.0);
  add_contact(g, 17, 18, 1.0, 0.0), add_contact(g, 18, 19, -0.5, height), add_contact(g, 19, 17, -0.5, -height);
  add_contact(g, 17, 1, -1.0, 0.4), add_contact(g, 18, 6, 0.6, -1.0), add_contact(g, 19, 11, 0.1, 1.0);
  return g;
}

CASE(weak_forces_beside_none) {
  for (const double tilt : {1e-4, 1e-6, 1e-8, 1e-9, 3e-10}) {
    const RigidityResult r = test_rigidity(with_weak_and_without(tilt), Jamming::collective);
    assert_true(r.rigid == Verdict::yes);
    assert_int_equal(r.spheres, 17);
    assert_int_equal(r.contacts, 51);
    assert_int_equal(r.zero_force_contacts, 6);
    assert_true(std::fabs(r.force[50] / (r.force[48] * 2.0 * tilt) - 1.0) < 1e-5);
  }
}

void add_wall(RigidityMatrix &g, int32_t i, double x, double y, double bending) {
  add_contact(g, i, -1, x, y);
  g.bending.push_back(bending);
}

// Rows alone: wall, disk 0, disk 1, wall in a line along x, with one state of self-stress. Across it the forces times
// second derivatives give q = (y0 - y1)^2 - 20 y0^2 - y1^2 / 2: disk 1 may leave the line, as q(0, y1) > 0. Two
// contacts without force ask for y0 >= y1 >= 0, where q <= -19 y0^2: then there is no motion.
CASE(contacts_without_force_at_a_round_wall) {
  for (const bool blocked : {false, true}) {
    RigidityMatrix g;
    g.dim = 2, g.nodes = 2, g.curved = 3u, g.wall = {{3u, 1.0}}, g.open_axes = 0;
    g.sphere = {0, 1}, g.node = {0, 1};
    add_wall(g, 0, 1.0, 0.0, -20.0), add_wall(g, 1, -1.0, 0.0, -0.5);
    add_contact(g, 0, 1, -1.0, 0.0), g.bending.push_back(1.0);
    if (blocked) {
      add_wall(g, 1, 0.0, 1.0, -0.5);
      add_contact(g, 0, 1, 0.0, 1.0), g.bending.push_back(1.0);
    }
    const RigidityResult r = test_rigidity(g, Jamming::collective);
    assert_true(r.stressed == Verdict::yes);
    assert_int_equal(r.contacts, 3);
    assert_int_equal(r.flexes, 2);
    assert_true(r.rigid == (blocked ? Verdict::undecided : Verdict::no));
    assert_true(r.flex.empty() == blocked);
  }
}

}  // namespace
