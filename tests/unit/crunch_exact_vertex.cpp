// The exact vertex: from networks with a wrong contact, from those that are right, and the small LP that it ends in.
#include <cmath>
#include <cstring>
#include <functional>
#include "test.h"

#include "crunch/exact_vertex.hpp"
#include "lp/small_lp.hpp"
#include "near_contact.hpp"
#include "network/contact_network.hpp"

using namespace jam;

namespace {

// A jammed packing of which one pair more is at `wanted` from contact.
bool near_vertex(int seed, double wanted, Packing &p, ContactNetwork &net, PairList &pair) {
  CrunchResult r = run(start(40, 3, 0.3, seed), default_crunch_options());
  int32_t sphere;
  if (!r.report.jammed || r.report.excess_contacts != 0 ||
      bring_together(r.packing, r.contacts, pair, sphere, wanted) == 0.0)
    return false;
  p = r.packing, net = r.contacts;
  return true;
}

// `pair` among the contacts instead of contact k.
ContactNetwork exchanged(const Packing &p, const ContactNetwork &net, size_t k, const PairList &pair) {
  ContactNetwork all;
  all.pairs = find_pairs(p, 0.0, 1.0 + 1e-6);
  all.force = carry_over(net.pairs, net.force, all.pairs);
  all.force_scale = net.force_scale;
  all.coordination.assign(p.n(), 0);
  measure_contacts(p, all);
  std::vector<double> flag(net.size(), 1.0);
  flag[k] = 0.0;
  const std::vector<double> stays = carry_over(net.pairs, flag, all.pairs), added = carry_over(pair, {1.0}, all.pairs);
  std::vector<char> on(all.size());
  for (size_t q = 0; q < on.size(); ++q) on[q] = stays[q] + added[q] > 0.0;
  return subset(all, on, p.dim);
}

// A neighbour of the vertex: one contact is exchanged for a pair that is nearly one. All close, but forces pull. From
// there polish finds back: the same contacts, the same diameters to rounding, nothing pulls.
void wrong_contact(void **) {
  int back = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    Packing p;
    ContactNetwork net;
    PairList pair;
    if (!near_vertex(seed, 1e-9, p, net, pair)) continue;
    for (size_t k = 0; k < net.size(); ++k) {
      ContactNetwork wrong = exchanged(p, net, k, pair);
      if (wrong.size() != net.size() || excess_contacts(wrong, 3) != 0) continue;
      Packing q = p;
      NewtonSystem system;
      Vertex vertex;  // of the packing that is closed already: the right forces from the wrong network's
      assert_true(find_vertex(p, wrong, system, 1, Tuning(), nullptr, vertex) && vertex.net.size() == net.size());
      for (size_t c = 0; c < net.size(); ++c) assert_true(std::fabs(vertex.net.force[c] - net.force[c]) < 1e-9);
      const PolishEnd end = polish(q, wrong, system, 1, Tuning());
      assert_true(end == PolishEnd::done);
      assert_true(std::fabs(q.diameter[0] / p.diameter[0] - 1.0) < 1e-13 && closest_pair(q).gap > -1e-14);
      assert_memory_equal(wrong.pairs.i.data(), net.pairs.i.data(), net.size() * sizeof(int32_t));
      assert_memory_equal(wrong.pairs.j.data(), net.pairs.j.data(), net.size() * sizeof(int32_t));
      for (size_t c = 0; c < net.size(); ++c)
        assert_true(wrong.force[c] > 0.0 && std::fabs(wrong.force[c] - net.force[c]) < 1e-6 &&
                    std::fabs(wrong.gap[c]) < 1e-14);
      ++back;
    }
  }
  assert_true(back >= 200);  // of about 110 contacts in each of the scenes
}

// A contact too weak for an LP to list: the others close but cannot balance. Polish finds it among the pairs that
// nearly touch, whether or not another is there to choose from, and the result is the packing.
void missing_contact(void **) {
  int back[2] = {0, 0};
  for (int seed = 1; seed <= 6; ++seed)
    for (const bool other : {false, true}) {
      Packing p;
      ContactNetwork net;
      PairList pair;
      if (!near_vertex(seed, 1e-9, p, net, pair)) continue;
      if (!other) {
        const CrunchResult alone = run(start(40, 3, 0.3, seed), default_crunch_options());
        p = alone.packing, net = alone.contacts;
      }
      for (size_t k = 0; k < net.size(); ++k) {
        std::vector<char> on(net.size(), 1);
        on[k] = 0;
        ContactNetwork fewer = subset(net, on, 3);
        if (excess_contacts(fewer, 3) != -1) continue;
        Packing q = p;
        NewtonSystem system;
        assert_true(polish(q, fewer, system, 1, Tuning()) == PolishEnd::done);
        assert_true(std::fabs(q.diameter[0] / p.diameter[0] - 1.0) < 1e-13 && closest_pair(q).gap > -1e-14 &&
                    fewer.pairs.i == net.pairs.i && fewer.pairs.j == net.pairs.j);
        for (size_t c = 0; c < net.size(); ++c)
          assert_true(std::fabs(fewer.force[c] - net.force[c]) < 1e-6 && std::fabs(fewer.gap[c]) < 1e-14);
        ++back[other];
      }
    }
  assert_true(back[0] >= 200 && back[1] >= 200);
}

// Contacts that hold no sphere are no network, and no near pair makes them one: polish says that they are too few and
// changes nothing.
void no_network(void **) {
  const CrunchResult r = run(start(40, 3, 0.3, 1), default_crunch_options());
  assert_true(r.report.jammed);
  std::vector<char> on(r.contacts.size(), 0);
  on[0] = 1;
  ContactNetwork one = subset(r.contacts, on, 3);
  Packing p = r.packing;
  for (size_t i = 0; i < p.n(); ++i)
    if (one.coordination[i] == 0) p.diameter[i] *= 0.9;
  const Packing before = p;
  NewtonSystem system;
  Vertex vertex;
  assert_true(!find_vertex(p, one, system, 1, Tuning(), nullptr, vertex));
  assert_true(polish(p, one, system, 1, Tuning()) == PolishEnd::too_few);
  assert_true(p.position == before.position && p.diameter == before.diameter && one.size() == 1);
}

// Cancelled or out of time while it looks for the vertex: it says so, and nothing has changed.
void interrupted_at_the_vertex(void **) {
  Packing p;
  ContactNetwork net;
  PairList pair;
  int seed = 1;
  while (!near_vertex(seed, 1e-9, p, net, pair)) assert_true(++seed < 10);
  size_t k = 0;
  ContactNetwork wrong = exchanged(p, net, k, pair);
  while (wrong.size() != net.size() || excess_contacts(wrong, 3) != 0) wrong = exchanged(p, net, ++k, pair);
  for (const bool cancel : {true, false}) {
    Monitor monitor;
    std::function<void()> stop = [&] { cancel ? monitor.cancel() : void(monitor.wall_time = 0.0); };
    monitor.log_fn = [](int32_t, const char *line, void *user) {
      if (std::strstr(line, "pull")) (*static_cast<std::function<void()> *>(user))();  // before it looks for the vertex
    };
    monitor.log_level = JAM_LOG_DEBUG, monitor.log_user = &stop;
    monitor.begin();
    Packing q = p;
    ContactNetwork same = wrong;
    NewtonSystem system;
    assert_true(polish(q, same, system, 1, Tuning(), &monitor) == PolishEnd::interrupted);
    assert_true(q.position == p.position && q.diameter == p.diameter && same.force == wrong.force &&
                same.pairs.i == wrong.pairs.i);
    Vertex vertex;
    assert_true(!find_vertex(p, wrong, system, 1, Tuning(), &monitor, vertex) &&
                find_vertex(p, wrong, system, 1, Tuning(), nullptr, vertex));
  }
}

// The vertex of a network that is right is the network: no step, the same forces, nothing open. Where no pair but the
// contacts is near there is nothing to decide, and it says so.
void vertex_of_an_exact_vertex(void **) {
  int scenes = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    Packing p;
    ContactNetwork net;
    PairList pair;
    if (!near_vertex(seed, 1e-9, p, net, pair)) continue;
    NewtonSystem system;
    Vertex vertex;
    assert_true(find_vertex(p, net, system, 1, Tuning(), nullptr, vertex));
    assert_int_equal(vertex.net.size(), net.size());
    double step = 0.0;
    for (const double s : vertex.step.s) step = std::max(step, std::fabs(s));
    assert_true(vertex.open < 1e-14 && step < 1e-12 && std::fabs(vertex.step.g) < 1e-14);
    for (size_t c = 0; c < net.size(); ++c) assert_true(std::fabs(vertex.net.force[c] - net.force[c]) < 1e-10);
    const CrunchResult alone = run(start(40, 3, 0.3, seed), default_crunch_options());
    if (relative_gap(alone.packing, nearest_other(alone.packing, alone.contacts)) > 1e-5)
      assert_true(!find_vertex(alone.packing, alone.contacts, system, 1, Tuning(), nullptr, vertex)), ++scenes;
  }
  assert_true(scenes >= 2);
}

// min -2 a - b, a + b + c = 1, a - d = 0.25: a = 1. No optimum where a column is free to grow, nor where nothing is
// feasible.
void small_lp(void **) {
  const std::vector<double> x =
      solve_small_lp({-2.0, -1.0, 0.0, 0.0}, {1.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0, -1.0}, {1.0, 0.25});
  assert_int_equal(x.size(), 4);
  assert_true(std::fabs(x[0] - 1.0) < 1e-12 && x[1] == 0.0 && x[2] == 0.0 && std::fabs(x[3] - 0.75) < 1e-12);
  assert_true(solve_small_lp({-1.0, 0.0}, {1.0, -1.0}, {0.0}).empty());
  assert_true(solve_small_lp({1.0, 1.0}, {1.0, 1.0}, {-1.0}).empty());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(wrong_contact),
                              cmocka_unit_test(missing_contact),
                              cmocka_unit_test(no_network),
                              cmocka_unit_test(interrupted_at_the_vertex),
                              cmocka_unit_test(vertex_of_an_exact_vertex),
                              cmocka_unit_test(small_lp)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
