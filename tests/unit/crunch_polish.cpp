// The last digits of a crunch: networks that close, and those with a contact too many or too few.
#include <algorithm>
#include <cmath>
#include "test.h"

#include "near_contact.hpp"

using namespace jam::inside;

namespace {

// The network of the fixed point, or a broken one, through polish alone.
PolishEnd try_polish(const Packing &p, const ContactNetwork &net) {
  Packing q = p;
  ContactNetwork changed = net;
  NewtonSystem system;
  const PolishEnd end = polish(q, changed, system, 1, Tuning());
  if (end == PolishEnd::done) {
    for (size_t k = 0; k < changed.size(); ++k)
      assert_true(changed.force[k] > 0.0 && std::fabs(changed.gap[k]) < 1e-14);
    assert_true(closest_pair(q).gap > -1e-14);
  } else {
    assert_memory_equal(q.position.data(), p.position.data(), p.position.size() * sizeof(double));
    assert_memory_equal(changed.force.data(), net.force.data(), net.size() * sizeof(double));
  }
  return end;
}

// One contact replaced by a pair of stable spheres that do not touch: closing it opens or crosses the one left out, or
// pulls somewhere. What passes must be a packing without overlap and with positive forces all the same.
CASE(polish_refuses) {
  jam_crunch_options o = default_crunch_options();
  o.polish = 0;
  const CrunchResult r = run(start(60, 3, 0.3, 6), o);
  assert_true(r.report.jammed && r.report.excess_contacts == 0);
  assert_true(try_polish(r.packing, r.contacts) == PolishEnd::done);
  ContactNetwork net = r.contacts;
  for (double &f : net.force) f = -f;
  assert_true(try_polish(r.packing, net) == PolishEnd::negative_force);
  std::vector<char> on(r.contacts.size(), 0);
  on[0] = 1;  // one contact holds no sphere
  assert_true(try_polish(r.packing, subset(r.contacts, on, 3)) == PolishEnd::too_few);
  net.pairs.clear(), net.force.clear(), net.gap.clear(), net.vector.clear();
  assert_true(try_polish(r.packing, net) == PolishEnd::no_contacts);

  const PairList near = find_pairs(r.packing, 0.0, 1.3);
  int ends[static_cast<int>(PolishEnd::overlap) + 1] = {};
  const auto count = [&](PolishEnd end) -> int & { return ends[static_cast<int>(end)]; };
  double v[3];
  for (size_t k = 0; k < near.size(); ++k) {
    const double sigma = r.packing.diameter[near.i[k]],
                 gap = std::sqrt(pair_vector(r.packing, near, k, v)) / sigma - 1.0;
    if (gap < 1e-3 || !r.contacts.coordination[near.i[k]] || !r.contacts.coordination[near.j[k]]) continue;
    net = r.contacts;
    const size_t place = std::lower_bound(net.pairs.i.begin(), net.pairs.i.end(), near.i[k]) -
                         net.pairs.i.begin();  // of the same i: the list stays sorted
    if (place >= net.size() || net.pairs.i[place] != near.i[k]) continue;
    net.pairs.j[place] = near.j[k];
    net.gap[place] = gap;
    for (int c = 0; c < 3; ++c) {
      net.vector[place * 3 + c] = v[c] / (sigma * (1.0 + gap));
      net.pairs.offset[place * 3 + c] = near.offset[k * 3 + c];
    }
    ++count(try_polish(r.packing, net));
  }
  print_message("done %d, open %d, negative %d, overlap %d\n", count(PolishEnd::done), count(PolishEnd::open_contact),
                count(PolishEnd::negative_force), count(PolishEnd::overlap));
  assert_true(count(PolishEnd::open_contact) > 0 && count(PolishEnd::negative_force) > 0);
}

// A pair so near to contact that an LP counts it: all cannot close together. When it is open with the others closed it
// is left out, when it would overlap then another contact is: either way no gap is left above rounding.
CASE(too_many_to_close) {
  int scenes = 0, others = 0, left = 0, alone = 0;  // alone: without an LP
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;    // the path's scenes change with it
  for (int seed = 1; seed <= 24; ++seed)  // one pair of seed 11 is of the rare kind that is left
    for (const double wanted : {1e-11, -1e-11}) {
      CrunchResult r = run(start(40, 3, 0.2, seed), o);
      if (!r.report.jammed || r.report.excess_contacts != 0) continue;
      PairList pair;
      int32_t sphere;
      const double rate = bring_together(r.packing, r.contacts, pair, sphere, 1e-11);
      if (rate == 0.0) continue;
      if (wanted < 0.0) resize(r.packing, r.contacts, sphere, -2e-11 / rate);
      ContactNetwork net = r.contacts;
      const auto at = [&](auto &v, size_t place, const auto &what) {
        v.insert(v.begin() + place, what.begin(), what.end());
      };
      size_t place = 0;  // lists are sorted
      while (place < net.size() &&
             std::make_pair(net.pairs.i[place], net.pairs.j[place]) < std::make_pair(pair.i[0], pair.j[0]))
        ++place;
      std::vector<double> along(3);
      const double length = std::sqrt(pair_vector(r.packing, pair, 0, along.data()));
      for (double &v : along) v /= length;
      at(net.pairs.i, place, pair.i), at(net.pairs.j, place, pair.j), at(net.pairs.offset, 3 * place, pair.offset);
      at(net.vector, 3 * place, along), at(net.gap, place, std::vector<double>{relative_gap(r.packing, pair)}),
          at(net.force, place, std::vector<double>{1e-4});
      ++net.coordination[pair.i[0]], ++net.coordination[pair.j[0]];
      alone += try_polish(r.packing, net) == PolishEnd::done;
      CrunchHooks hooks;
      int asked = 0;
      hooks.before_polish = [&](const Packing &, ContactNetwork &first) {
        if (++asked == 1) first = net;
      };
      CrunchResult again = run(r.packing, o, &hooks);
      assert_true(again.report.jammed);
      const Packing &p = again.packing;
      net = again.contacts;
      for (const double f : net.force) assert_true(f > 0.0);
      if (net.size() !=
          r.contacts.size()) {  // the one to leave out belongs to a sphere with none to spare: the gaps stay, in sight
        assert_true(closest_pair(p).gap > wanted);
        ++left;
        continue;
      }
      for (const double gap : net.gap) assert_true(std::fabs(gap) < 1e-14);
      assert_true(closest_pair(p).gap > -1e-14);
      const double gap = relative_gap(p, pair);
      assert_true(wanted > 0.0 ? std::fabs(gap - wanted) < 0.2 * wanted : std::fabs(gap) < 1e-14);
      ++scenes, others += wanted < 0.0;
    }
  assert_true(scenes - others >= 15 && alone >= scenes && others + left >= 16);
  // A narrow LP decides which other contact is left out. A build without Clp solves none, so those overlaps stay.
  if (clp_is_built()) assert_true(others >= 15 && left >= 1 && left <= 2);
}

// Positions round by the size of the box: in one of 150 diameters closed contacts overlap by more than in one of ten,
// and are closed all the same.
CASE(rounding_grows_with_the_box) {
  constexpr int across = 150;
  Packing p;
  p.set_cube(2, 1.0);
  for (int k = 0; k < across * across; ++k) {
    p.position.push_back((k % across) / double(across)), p.position.push_back((k / across) / double(across));
    p.diameter.push_back((1.0 - 1e-12) / across);
  }
  p.velocity.assign(p.position.size(), 0.0);
  ContactNetwork net;
  net.pairs = find_pairs(p, 0.0, 1.0 + 1e-11);
  assert_int_equal(net.pairs.size(), 2 * p.n());
  measure_contacts(p, net);
  net.force.assign(net.size(), 1.0);
  net.coordination.assign(p.n(), 4);
  assert_true(closest_pair(p).gap > 0.0);
  NewtonSystem system;
  assert_true(polish(p, net, system, 1, Tuning()) == PolishEnd::done);
  const double gap = closest_pair(p).gap;
  assert_true(gap < -1e-14 && gap > -2e-13);
  assert_true(std::fabs(p.diameter[0] * across - 1.0) < 1e-14);
}

// Contacts that close and forces that balance end a crunch: steps need not fall below a tolerance that rounding
// forbids. The bare LP must meet its step tolerance.
CASE(closed_contacts_end_it) {
  const Packing p = start(60, 3, 0.3, 6);
  jam_crunch_options o = default_crunch_options();
  const CrunchResult plain = run(p, o);
  o.step_tolerance = 1e-300;
  const CrunchResult closed = run(p, o);
  assert_true(closed.status == JAM_OK && closed.report.stop_reason == JAM_STOP_CONVERGED && closed.report.jammed);
  assert_true(closed.report.contacts == plain.report.contacts && closed.report.force_residual < 1e-13);
  assert_true(std::fabs(closed.report.packing_fraction - plain.report.packing_fraction) < 1e-14);
  o.polish = 0;
  assert_int_equal(run(p, o).status, JAM_NOT_CONVERGED);
}

}  // namespace
