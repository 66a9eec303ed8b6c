// Rare ends of a crunch, forced through CrunchSeams: an interior point that fails, a path that gives up, a polish that refuses.
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
extern "C" {
#include <cmocka.h>
}
#include <algorithm>
#include <cmath>
#include <string>

#include "core/create.hpp"
#include "crunch/crunch.hpp"

using namespace jam;

namespace {

// Warnings of what runs under this monitor, one after the other in `log`.
void listen(Monitor &monitor, std::string &log) {
  monitor.log_fn = [](int32_t, const char *line, void *user) { *static_cast<std::string *>(user) += line; };
  monitor.log_user = &log;
  monitor.log_level = JAM_LOG_WARNING;
  monitor.begin();
}

Packing start(int n, int dim, double phi, int64_t seed) {
  jam_create_options o = default_create_options();
  o.n = n, o.dim = dim, o.packing_fraction = phi, o.seed = seed;
  return make_packing(o, nullptr, 0, nullptr, 0);
}

CrunchResult run(const Packing &p, const jam_crunch_options &o, const CrunchSeams *seams = nullptr, History *history = nullptr) {
  Monitor monitor;
  monitor.begin();
  return crunch(p, o, monitor, history, seams);
}

void same_bits(const CrunchResult &a, const CrunchResult &b) {
  assert_memory_equal(a.packing.position.data(), b.packing.position.data(), a.packing.position.size() * sizeof(double));
  assert_memory_equal(a.packing.diameter.data(), b.packing.diameter.data(), a.packing.diameter.size() * sizeof(double));
  assert_int_equal(a.contacts.size(), b.contacts.size());
  assert_memory_equal(a.contacts.force.data(), b.contacts.force.data(), a.contacts.force.size() * sizeof(double));
}

// On two threads a crunch repeats its bits too: they share the work in the same way each time.
void two_threads_repeat(void **) {
  const Packing p = start(1500, 3, 0.35, 4);
  jam_crunch_options o = default_crunch_options();
  o.threads = 2, o.max_lps = 3;
  const CrunchResult r = run(p, o);
  assert_true(r.report.factorisations > 10);
  same_bits(r, run(p, o));
}

// Every answer of the interior point is spoiled, each time in another way: Clp must finish the job alone, on the same jamming
// point that it finds as the chosen solver.
void clp_takes_over(void **) {
  const Packing p = start(40, 3, 0.3, 3);
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_CHAIN;
  int ipm = 0, clp = 0;
  CrunchSeams seams;
  seams.answer = [&](LpSolution &x, jam_lp_solver solver) {
    if (solver == JAM_LP_CLP) {
      ++clp;
      return;
    }
    if (ipm % 4 == 0) x.solved = false;
    if (ipm % 4 == 1) x.g += 1e-6;                              // some pair would overlap
    if (ipm % 4 == 2) for (double &y : x.y) y *= 1.001;          // |sum y - 1|
    if (ipm % 4 == 3) x.g = std::nan("");
    ++ipm;
  };
  const CrunchResult r = run(p, o, &seams);
  assert_int_equal(r.status, JAM_OK);
  assert_int_equal(r.report.lp_solver, JAM_LP_CLP);
  assert_true(clp == r.report.lp_solves && ipm == 2 * clp);
  assert_true(r.report.jammed && r.report.max_overlap < 1e-12 && r.report.force_residual < 1e-12);
  o.lp_solver = JAM_LP_CLP;
  same_bits(r, run(p, o));
}

// Both solvers fail after a few LPs: a status with the state after those, which holds no overlap, and no contacts.
void nobody_solves(void **) {
  const Packing p = start(40, 3, 0.3, 3);
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_CHAIN;
  int asked = 0;
  CrunchSeams seams;
  seams.answer = [&](LpSolution &x, jam_lp_solver) { x.solved = x.solved && ++asked <= 3; };
  const CrunchResult r = run(p, o, &seams);
  assert_int_equal(r.status, JAM_E_SOLVER);
  assert_true(!r.text.empty() && r.report.stop_reason == JAM_STOP_SOLVER && !r.report.jammed);
  assert_true(r.report.lp_solves >= 1 && r.contacts.size() == 0 && r.report.rattlers == 40);
  o.max_lps = static_cast<int32_t>(r.report.lp_solves);
  const CrunchResult limited = run(p, o);
  assert_int_equal(limited.status, JAM_LIMIT);
  assert_memory_equal(r.packing.position.data(), limited.packing.position.data(), r.packing.position.size() * sizeof(double));
  assert_true(closest_pair(r.packing).gap > -1e-13);
}

// A path that ends undecided: the chain starts again at the same point and its answer is the chain's own; the history too.
void chain_takes_over(void **) {
  const Packing p = start(60, 3, 0.3, 4);
  jam_crunch_options o = default_crunch_options(), chain = o;
  CrunchSeams seams;
  seams.attempt = [](CrunchResult &r) { r.status = JAM_NOT_CONVERGED; };
  History history, expected;
  const CrunchResult r = run(p, o, &seams, &history);
  chain.method = JAM_CRUNCH_CHAIN;
  const CrunchResult alone = run(p, chain, nullptr, &expected);
  assert_true(r.status == JAM_OK && r.report.jammed && r.report.method == JAM_CRUNCH_CHAIN);
  assert_true(r.report.factorisations > alone.report.factorisations);  // the path's are counted too
  same_bits(r, alone);
  assert_int_equal(history.rows().size(), expected.rows().size());
  assert_true(history.rows().back()[JAM_HISTORY_PHI] == r.report.packing_fraction);
  assert_true(history.rows().front()[JAM_HISTORY_PHASE] == JAM_STEP_LP);
}

// The network of the fixed point, or a broken one, through polish alone.
PolishEnd try_polish(const Packing &p, const ContactNetwork &net) {
  Packing q = p;
  ContactNetwork changed = net;
  NewtonSystem system;
  const PolishEnd end = polish(q, changed, system, 1);
  if (end == PolishEnd::done) {
    for (size_t k = 0; k < changed.size(); ++k) assert_true(changed.force[k] > 0.0 && std::fabs(changed.gap[k]) < 1e-14);
    assert_true(closest_pair(q).gap > -1e-14);
  } else {
    assert_memory_equal(q.position.data(), p.position.data(), p.position.size() * sizeof(double));
    assert_memory_equal(changed.force.data(), net.force.data(), net.size() * sizeof(double));
  }
  return end;
}

// One contact replaced by a pair of stable spheres that do not touch: closing it opens or crosses the one left out, or
// pulls somewhere. What passes must be a packing without overlap and with positive forces all the same.
void polish_refuses(void **) {
  jam_crunch_options o = default_crunch_options();
  o.polish = 0;
  const CrunchResult r = run(start(60, 3, 0.3, 6), o);
  assert_true(r.report.jammed && r.report.excess_contacts == 0);
  assert_true(try_polish(r.packing, r.contacts) == PolishEnd::done);
  ContactNetwork net = r.contacts;
  for (double &f : net.force) f = -f;
  assert_true(try_polish(r.packing, net) == PolishEnd::negative_force);
  net.pairs.clear(), net.force.clear(), net.gap.clear(), net.vector.clear();
  assert_true(try_polish(r.packing, net) == PolishEnd::no_contacts);

  const PairList near = find_pairs(r.packing, 0.0, 1.3);
  int ends[6] = {0, 0, 0, 0, 0, 0};
  double v[3];
  for (size_t k = 0; k < near.size(); ++k) {
    const double sigma = r.packing.diameter[near.i[k]], gap = std::sqrt(pair_vector(r.packing, near, k, v)) / sigma - 1.0;
    if (gap < 1e-3 || !r.contacts.coordination[near.i[k]] || !r.contacts.coordination[near.j[k]]) continue;
    net = r.contacts;
    const size_t place = std::lower_bound(net.pairs.i.begin(), net.pairs.i.end(), near.i[k]) - net.pairs.i.begin();  // of the same i: the list stays sorted
    if (place >= net.size() || net.pairs.i[place] != near.i[k]) continue;
    net.pairs.j[place] = near.j[k];
    net.gap[place] = gap;
    for (int c = 0; c < 3; ++c) {
      net.vector[place * 3 + c] = v[c] / (sigma * (1.0 + gap));
      net.pairs.offset[place * 3 + c] = near.offset[k * 3 + c];
    }
    ++ends[static_cast<int>(try_polish(r.packing, net))];
  }
  print_message("done %d, open %d, negative %d, overlap %d\n", ends[0], ends[3], ends[4], ends[5]);
  assert_true(ends[static_cast<int>(PolishEnd::open_contact)] > 0 && ends[static_cast<int>(PolishEnd::negative_force)] > 0);
}

// Inside a crunch a refusal is followed by one more LP. When its network is refused too, its answer stays and the log says so;
// when that one passes, the result is as good as any.
void one_more_lp(void **) {
  const Packing p = start(60, 3, 0.3, 6);
  jam_crunch_options o = default_crunch_options(), bare = o;
  bare.polish = 0;
  const CrunchResult plain = run(p, bare);
  for (int refusals = 1; refusals <= 2; ++refusals) {
    int asked = 0;
    CrunchSeams seams;
    ContactNetwork given;
    seams.before_polish = [&](const Packing &, ContactNetwork &net) {
      if (++asked > 2) return;  // what follows belongs to the chain, which is tried when the path's answer is not jammed
      for (double &f : net.force) f = asked <= refusals ? -f : f;
      given = net;
    };
    std::string log;
    Monitor monitor;
    listen(monitor, log);
    CrunchResult first;
    seams.attempt = [&](CrunchResult &r) { first = r; };
    crunch(p, o, monitor, nullptr, &seams);
    assert_true(log.find("polish refused: a force turns negative; one more LP") != std::string::npos);
    assert_true((log.find("the LP's answer stays") != std::string::npos) == (refusals == 2));
    assert_true(asked >= 2 && first.report.lp_solves == plain.report.lp_solves + 1);
    assert_true(std::fabs(first.report.packing_fraction - plain.report.packing_fraction) < 1e-12 && first.report.contacts == plain.report.contacts);
    assert_true(first.report.jammed == (refusals == 1));  // the certificate sees negative forces
    if (refusals == 1) assert_true(first.report.force_residual < 1e-14);
    if (refusals == 2) assert_memory_equal(first.contacts.force.data(), given.force.data(), given.size() * sizeof(double));
  }
}

double relative_gap(const Packing &p, const PairList &pairs, size_t k = 0) {
  double r[JAM_MAX_DIM];
  return std::sqrt(pair_vector(p, pairs, k, r)) / (0.5 * (p.diameter[pairs.i[k]] + p.diameter[pairs.j[k]])) - 1.0;
}

// The nearest pair of stable spheres that is no contact.
PairList nearest_other(const Packing &p, const ContactNetwork &net) {
  const PairList near = find_pairs(p, 0.3 * diameter_mean(p), 1.0);
  PairList one, best;
  double closest = 1.0;
  for (size_t k = 0; k < near.size(); ++k) {
    one.i = {near.i[k]}, one.j = {near.j[k]};
    one.offset.assign(&near.offset[p.dim * k], &near.offset[p.dim * k] + p.dim);
    const double gap = relative_gap(p, one);
    bool other = gap < closest && net.coordination[near.i[k]] && net.coordination[near.j[k]];
    for (size_t c = 0; c < net.size() && other; ++c) other = net.pairs.i[c] != near.i[k] || net.pairs.j[c] != near.j[k];
    if (other) closest = gap, best = one;
  }
  return best;
}

// A pair that does not touch but that the LP counts among the contacts, with next to no force: polish leaves it out. With a force that
// counts it does not.
void idle_contact(void **) {
  const Packing p = start(60, 3, 0.3, 6);
  const CrunchResult plain = run(p, default_crunch_options());
  assert_true(plain.report.jammed && plain.report.excess_contacts == 0);
  for (const double force : {1e-7, 1e-3}) {
    int asked = 0;
    CrunchSeams seams;
    seams.before_polish = [&](const Packing &q, ContactNetwork &net) {
      if (++asked > 1) return;
      const PairList extra = nearest_other(q, net);
      assert_true(extra.size() == 1);
      ++net.coordination[extra.i[0]], ++net.coordination[extra.j[0]];
      net.pairs.i.push_back(extra.i[0]), net.pairs.j.push_back(extra.j[0]);
      net.pairs.offset.insert(net.pairs.offset.end(), extra.offset.begin(), extra.offset.end());
      net.vector.insert(net.vector.end(), {1.0, 0.0, 0.0});  // polish makes them anew
      net.gap.push_back(relative_gap(q, extra)), net.force.push_back(force);
    };
    CrunchResult first;
    seams.attempt = [&](CrunchResult &r) { first = r; };
    Monitor monitor;
    monitor.begin();
    crunch(p, default_crunch_options(), monitor, nullptr, &seams);
    assert_true(first.report.jammed && first.report.contacts == plain.report.contacts && first.report.force_residual < 1e-14);
    assert_true(std::fabs(first.report.packing_fraction - plain.report.packing_fraction) < 1e-12);
    assert_int_equal(first.report.lp_solves - plain.report.lp_solves, force > 1e-5);  // an LP more where the pair might carry
  }
}

// One sphere's size changes: its contacts open or overlap until polish closes them.
void resize(Packing &p, ContactNetwork &net, int32_t sphere, double change) {
  p.diameter[sphere] *= 1.0 + change;
  for (size_t k = 0; k < net.size(); ++k) net.gap[k] = relative_gap(p, net.pairs, k);
}

// One sphere is made larger or smaller until the nearest pair that is no contact is `wanted` apart. Returns how fast it moved; 0 when
// a force turns negative on the way.
double bring_together(Packing &p, ContactNetwork &net, PairList &pair, int32_t &sphere, double wanted) {
  for (size_t i = 0; i < p.n(); ++i)
    if (net.coordination[i] == 0) p.diameter[i] *= 0.1;  // rattlers are not in the way
  pair = nearest_other(p, net);
  sphere = pair.i[0];
  double last = relative_gap(p, pair), change = 0.1 * last, rate = 0.0;
  NewtonSystem system;
  for (int k = 0; k < 60 && std::fabs(last - wanted) > 1e-3 * wanted; ++k) {
    resize(p, net, sphere, change);
    if (polish(p, net, system, 1) != PolishEnd::done) return 0.0;
    const double now = relative_gap(p, pair);
    rate = (now - last) / change;
    pair = nearest_other(p, net);  // another may have become the nearest
    last = relative_gap(p, pair);
    change = std::max(-1e-3, std::min(1e-3, (wanted - last) / rate));
  }
  return std::fabs(last - wanted) < 0.1 * wanted ? rate : 0.0;
}

// A pair so near to contact that an LP counts it: all cannot close together. When it is open with the others closed it is left out,
// when it would overlap then another contact is: either way no gap is left above rounding.
void too_many_to_close(void **) {
  int scenes = 0, others = 0, left = 0;
  for (int seed = 1; seed <= 12; ++seed)
    for (const double wanted : {1e-11, -1e-11}) {
      CrunchResult r = run(start(40, 3, 0.3, seed), default_crunch_options());
      if (!r.report.jammed || r.report.excess_contacts != 0) continue;
      PairList pair;
      int32_t sphere;
      const double rate = bring_together(r.packing, r.contacts, pair, sphere, 1e-11);
      if (rate == 0.0) continue;
      if (wanted < 0.0) resize(r.packing, r.contacts, sphere, -2e-11 / rate);
      ContactNetwork net = r.contacts;
      const auto at = [&](auto &v, size_t place, const auto &what) { v.insert(v.begin() + place, what.begin(), what.end()); };
      size_t place = 0;  // lists are sorted
      while (place < net.size() && std::make_pair(net.pairs.i[place], net.pairs.j[place]) < std::make_pair(pair.i[0], pair.j[0])) ++place;
      std::vector<double> along(3);
      const double length = std::sqrt(pair_vector(r.packing, pair, 0, along.data()));
      for (double &v : along) v /= length;
      at(net.pairs.i, place, pair.i), at(net.pairs.j, place, pair.j), at(net.pairs.offset, 3 * place, pair.offset);
      at(net.vector, 3 * place, along), at(net.gap, place, std::vector<double>{relative_gap(r.packing, pair)}), at(net.force, place, std::vector<double>{1e-4});
      ++net.coordination[pair.i[0]], ++net.coordination[pair.j[0]];
      NewtonSystem system;
      Packing p = r.packing;
      std::string log;
      Monitor monitor;
      listen(monitor, log);
      assert_true(polish(p, net, system, 1, &monitor) == PolishEnd::done);
      assert_true((log.find("cannot all close") != std::string::npos) == (net.size() != r.contacts.size()));
      for (const double f : net.force) assert_true(f > 0.0);
      if (net.size() != r.contacts.size()) {  // the one to leave out belongs to a sphere with none to spare: the gaps stay, in sight
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
  assert_true(scenes - others >= 5 && others >= 5 && left >= 1 && left <= 2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(two_threads_repeat), cmocka_unit_test(clp_takes_over), cmocka_unit_test(nobody_solves), cmocka_unit_test(chain_takes_over),
                              cmocka_unit_test(polish_refuses), cmocka_unit_test(one_more_lp), cmocka_unit_test(idle_contact),
                              cmocka_unit_test(too_many_to_close)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
