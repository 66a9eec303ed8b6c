// The end of a crunch at a finite duality gap. On the path y c = mu for every row: a contact has much force and a small
// gap, another pair the reverse. Those in between stay undecided until the path goes on.
//
//   multipliers of the path -> contacts (the rule of LPs) -> forces that balance -> duality gap of these forces
#include <algorithm>
#include <cmath>

#include "core/pair_rule.hpp"
#include "crunch/gap_rows.hpp"
#include "crunch/state.hpp"
#include "network/rigidity_matrix.hpp"

namespace jam {
namespace {

// Pairs of stable spheres whose force and gap are of one size, each in its own unit.
int64_t count_undecided(const CrunchState &s) {
  const std::vector<int32_t> &z = s.out.contacts.coordination;
  const double carrying = static_cast<double>(s.lp.spheres()), most = s.tuning.doubt * s.tuning.doubt;
  int64_t count = 0;
  for (size_t k = 0; k < s.lp.rows(); ++k) {
    const double force = s.answer.y[k] * carrying, gap = s.answer.w[k];
    count += z[s.pairs.i[k]] > 0 && z[s.pairs.j[k]] > 0 && force < most * gap && gap < most * force;
  }
  return count;
}

// The balanced forces nearest to those of the path, each measured by itself: weak ones change little. A contact that
// would pull carries no force at this gap; it goes, and the rest is balanced again.
bool balance(CrunchState &s) {
  ContactNetwork &net = s.out.contacts;
  const Packing &p = s.out.packing;
  for (int round = 0; round < s.tuning.max_projections && net.size() > 0 && !s.monitor.interrupted(); ++round) {
    s.system.set_graph(p.dim, static_cast<int32_t>(p.n()), net.pairs, s.o.threads);
    std::vector<double> weight(net.force), diagonal(p.position.size(), 1e-14);
    for (double &w : weight) w *= w;
    for (size_t i = 0; i < p.n(); ++i)
      for (int c = 0; c < p.dim && net.coordination[i] == 0; ++c) diagonal[i * p.dim + c] = 1.0;
    GapRows rows(net.pairs, p.dim, net.vector, diagonal, s.system);
    rows.weigh(weight);
    if (!rows.factorise()) return false;
    const std::vector<double> before = net.force;
    rows.balance(net.force);
    std::vector<char> on(net.size());
    for (size_t k = 0; k < on.size(); ++k) on[k] = net.force[k] > 0.0;
    const auto pulling = std::count(on.begin(), on.end(), 0);
    s.monitor.log(JAM_LOG_DEBUG, "finite gap: %td of %zu contacts pull", pulling, net.size());
    if (pulling == 0) return balance_residual(p.dim, p.n(), net) < s.tuning.balanced;
    net.force = before;
    net = subset(net, on, p.dim);
  }
  return false;
}

// sum y c with sum y = 1: by LP duality no small motion gains more (lp/packing_lp.hpp).
double duality_gap(const Packing &p, const ContactNetwork &net) {
  double sum = 0.0, gap = 0.0;
  for (size_t k = 0; k < net.size(); ++k) {
    const double y = net.force[k] * contact_distance(p, net.pairs.i[k], net.pairs.j[k]) / (1.0 + net.gap[k]);
    sum += y, gap += y * net.gap[k] * (2.0 + net.gap[k]);
  }
  return gap / sum;
}

void scale_to_mean(ContactNetwork &net) {
  double mean = 0.0;
  for (const double f : net.force) mean += f / static_cast<double>(net.size());
  for (double &f : net.force) f /= mean;
  net.force_scale *= mean;
}

}  // namespace

bool ends_at_gap(CrunchState &s, const Multipliers &path) {
  s.pairs = path.pairs;
  s.lp = make_lp(s.out.packing, s.pairs, diameter_mean(s.out.packing));
  s.answer = LpSolution();
  s.answer.y = path.y, s.answer.w = s.lp.c;
  s.active = find_active_set(s.lp, s.answer, 0.0);
  s.out.contacts = make_contacts(s.out.packing, s.pairs, s.answer, s.active);
  const size_t named = s.out.contacts.size();
  jam_crunch_report &r = s.out.report;
  r.stationary = balance(s) && !s.interrupted();
  if (!r.stationary) {
    s.monitor.log(JAM_LOG_INFO, "finite gap: forces of %zu contacts do not balance, the path goes on", named);
    s.active = ActiveSet();
    s.out.contacts = ContactNetwork();
    s.out.contacts.coordination.assign(s.out.packing.n(), 0);
    return false;
  }
  scale_to_mean(s.out.contacts);
  r.duality_gap = duality_gap(s.out.packing, s.out.contacts);
  r.undecided_contacts = count_undecided(s);
  s.monitor.log(JAM_LOG_INFO, "finite gap: duality gap %.2e, %zu contacts, %lld undecided pairs", r.duality_gap,
                s.out.contacts.size(), static_cast<long long>(r.undecided_contacts));
  s.stop(JAM_STOP_DUALITY_GAP, JAM_OK);
  return true;
}

}  // namespace jam
