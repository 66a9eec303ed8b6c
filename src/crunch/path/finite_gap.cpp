#include <utility>

#include "core/pair_rule.hpp"
#include "crunch/control.hpp"
#include "crunch/phases.hpp"
#include "lp/interior_point.hpp"
#include "network/force_balance.hpp"
#include "network/rigidity_matrix.hpp"

namespace jam::inside {
namespace {

// Pairs of stable spheres whose force on the path and gap are of one size, each in its own unit.
int64_t count_undecided(const CrunchState &s, const std::vector<double> &path, const std::vector<int32_t> &z) {
  const double carrying = static_cast<double>(s.last.lp.spheres()),
               most = s.tuning.ambiguity_ratio * s.tuning.ambiguity_ratio;
  int64_t count = 0;
  for (size_t k = 0; k < s.last.lp.rows(); ++k) {
    const double force = path[k] * carrying, gap = s.last.lp.c[k];
    const bool stable = z[s.last.pairs.i[k]] > 0 && (s.last.pairs.wall(k) || z[s.last.pairs.j[k]] > 0);
    count += stable && force < most * gap && gap < most * force;
  }
  return count;
}

// Contacts and forces of the LP at this point, without a bound on motions.
bool name_contacts(CrunchState &s, const std::vector<double> &path, ContactNetwork &net) {
  IpmControl control;
  double gap = 0.0;
  for (size_t k = 0; k < path.size(); ++k) gap += path[k] * s.last.lp.c[k];
  control.tolerance = s.tuning.lp_gap_fraction * gap;
  control.threads = s.o.threads;
  control.doubles_from = s.tuning.doubles_from;
  control.multipliers = &path;
  s.last.answer = s.interior_point.solve(s.last.lp, control, &s.monitor);
  if (s.hooks.answer) s.hooks.answer(s.last.answer, JAM_LP_IPM);
  if (!s.last.answer.solved) return false;
  ++s.out.report.lp_solves;
  net = make_contacts(s.out.packing, s.last.pairs, s.last.answer, find_active_set(s.last.lp, s.last.answer, 0.0));
  return net.size() > 0 && !s.monitor.interrupted();
}

// The balanced forces nearest to those of the LP, each measured by itself: weak ones change little. False where one
// would pull.
bool balance(CrunchState &s, ContactNetwork &net) {
  const Packing &p = s.out.packing;
  s.system.set_graph(p.dim, static_cast<int32_t>(p.n()), net.pairs, s.o.threads);
  std::vector<double> weight(net.force);
  for (double &w : weight) w *= w;
  GapRows rows(net, p.dim, net.vector, weighted_ground, s.system);
  rows.weigh(weight);
  if (!rows.factorise()) return false;
  rows.balance(net.force);
  return pushes_only(net) && balance_residual(p.dim, p.n(), net) < s.tuning.balanced;
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

}  // namespace

bool ends_at_gap(CrunchState &s, const Multipliers &path) {
  s.last.pairs = path.pairs;
  s.last.lp = make_lp(s.out.packing, s.last.pairs, diameter_mean(s.out.packing));
  ContactNetwork net;
  const bool balanced = name_contacts(s, path.y, net) && balance(s, net);
  if (stop_if_interrupted(s)) return false;
  const double gap = balanced ? duality_gap(s.out.packing, net) : 0.0;
  if (!balanced || gap > s.o.duality_gap) {
    s.monitor.log(JAM_LOG_INFO, "finite gap: %s, the path goes on",
                  balanced ? "larger than asked for" : "forces do not balance");
    return false;
  }
  scale_to_mean(net);
  jam_crunch_report &r = s.out.report;
  r.stationary = 1;
  r.duality_gap = gap;
  r.undecided_contacts = count_undecided(s, path.y, net.coordination);
  s.monitor.log(JAM_LOG_INFO, "finite gap: duality gap %.2e, %zu contacts, %lld undecided pairs", r.duality_gap,
                net.size(), static_cast<long long>(r.undecided_contacts));
  s.out.contacts = std::move(net);
  stop(s, JAM_STOP_DUALITY_GAP, JAM_OK);
  return true;
}

}  // namespace jam::inside
