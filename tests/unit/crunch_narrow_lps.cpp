// Narrow LPs: from networks with a wrong contact, with a contact missing, and interrupted.
#include <cmath>
#include <cstring>
#include <functional>
#include "test.h"

#include "lp/packing_lp.hpp"
#include "near_contact.hpp"
#include "network/contact_network.hpp"

using namespace jam::inside;

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

// A crunch from p whose first network is replaced by `wrong`.
CrunchResult run_from(const Packing &p, const ContactNetwork &wrong) {
  CrunchHooks hooks;
  int asked = 0;
  hooks.before_polish = [&](const Packing &, ContactNetwork &net) {
    if (++asked == 1) net = wrong;
  };
  return run(p, default_crunch_options(), &hooks);
}

void same_vertex(const CrunchResult &r, const Packing &p, const ContactNetwork &net) {
  assert_true(r.report.jammed && r.report.max_overlap < 1e-14 && r.report.force_residual < 1e-12);
  assert_true(std::fabs(r.packing.diameter[0] / p.diameter[0] - 1.0) < 1e-13);
  assert_true(r.contacts.pairs.i == net.pairs.i && r.contacts.pairs.j == net.pairs.j);
  for (size_t c = 0; c < net.size(); ++c)
    assert_true(r.contacts.force[c] > 0.0 && std::fabs(r.contacts.force[c] - net.force[c]) < 1e-6 &&
                std::fabs(r.contacts.gap[c]) < 1e-14);
}

// A neighbour of the vertex: one contact is exchanged for a pair that is nearly one. All close, but forces pull. The
// crunch finds back: the same contacts, the same diameters to rounding, nothing pulls.
CASE(wrong_contact) {
  int back = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    Packing p;
    ContactNetwork net;
    PairList pair;
    if (!near_vertex(seed, 1e-9, p, net, pair)) continue;
    for (size_t k = 0; k < net.size(); ++k) {
      const ContactNetwork wrong = exchanged(p, net, k, pair);
      if (wrong.size() != net.size() || excess_contacts(wrong, p) != 0) continue;
      same_vertex(run_from(p, wrong), p, net);
      ++back;
    }
  }
  assert_true(back >= 100);  // of about 110 contacts in each of the scenes
}

// A contact too weak for an LP to list: the others close but cannot balance. It is found among the pairs that nearly
// touch, whether or not another is there to choose from.
CASE(missing_contact) {
  int back[2] = {0, 0};
  for (int seed = 1; seed <= 3; ++seed)
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
        const ContactNetwork fewer = subset(net, on, 3);
        if (excess_contacts(fewer, p) != -1) continue;
        same_vertex(run_from(p, fewer), p, net);
        ++back[other];
      }
    }
  assert_true(back[0] >= 100 && back[1] >= 100);
}

// Cancelled or out of time before the narrow LPs: it says so, and the packing is valid.
CASE(interrupted_at_the_vertex) {
  Packing p;
  ContactNetwork net;
  PairList pair;
  int seed = 1;
  while (!near_vertex(seed, 1e-9, p, net, pair)) assert_true(++seed < 10);
  size_t k = 0;
  ContactNetwork wrong = exchanged(p, net, k, pair);
  while (wrong.size() != net.size() || excess_contacts(wrong, p) != 0) wrong = exchanged(p, net, ++k, pair);
  for (const bool cancel : {true, false}) {
    Monitor monitor;
    std::function<void()> stop = [&] { cancel ? monitor.cancel() : void(monitor.wall_time = 0.0); };
    monitor.log_fn = [](int32_t, const char *line, void *user) {
      if (std::strstr(line, "polish refused")) (*static_cast<std::function<void()> *>(user))();
    };
    monitor.log_level = JAM_LOG_WARNING, monitor.log_user = &stop;
    monitor.begin();
    CrunchHooks hooks;
    hooks.before_polish = [&](const Packing &, ContactNetwork &list) { list = wrong; };
    const CrunchResult r = crunch(p, default_crunch_options(), monitor, nullptr, &hooks);
    assert_int_equal(r.status, cancel ? JAM_CANCELLED : JAM_LIMIT);
    assert_int_equal(r.report.stop_reason, cancel ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME);
    assert_true(!r.report.jammed && closest_pair(r.packing).gap > -1e-13);
  }
}

}  // namespace
