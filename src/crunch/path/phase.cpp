#include <algorithm>
#include <cmath>
#include <utility>

#include "core/pair_rule.hpp"
#include "crunch/phases.hpp"
#include "lp/interior_point.hpp"
#include "network/force_balance.hpp"
#include "network/rigidity_matrix.hpp"

namespace jam::inside {
namespace {

// Spheres that lack a neighbour in one of the 2 d directions along the axes: a line to it with at least the component
// `covered` / sqrt(d). Of 2 d neighbours along axes turned as badly as can be, the best has 1 / sqrt(d).
std::vector<size_t> uncovered_spheres(const Packing &p, const PairList &pairs, double covered) {
  const size_t d = p.dim, sides = 2 * d;
  std::vector<double> cover(p.n() * sides, 0.0);
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs.i[k] == pairs.j[k]) continue;  // its own image moves with it
    const double length = std::sqrt(pair_vector(p, pairs, k, r));
    for (size_t c = 0; c < d; ++c) {
      const double along = std::fabs(r[c]) / length;
      for (const bool of_i : {true, false}) {
        if (!of_i && pairs.wall(k)) continue;
        double &w = cover[(of_i ? pairs.i[k] : pairs.j[k]) * sides + 2 * c + ((r[c] > 0.0) == of_i)];
        w = std::max(w, along);
      }
    }
  }
  std::vector<size_t> free;
  for (size_t i = 0; i < p.n(); ++i)
    if (*std::min_element(&cover[i * sides], &cover[i * sides] + sides) < covered / std::sqrt(static_cast<double>(d)))
      free.push_back(i);
  return free;
}

// Pairs of stable spheres whose force on the path and gap are of one size, each in its own unit: within the square of
// the factor that the path leaves to their product.
int64_t count_undecided(const CrunchState &s, const std::vector<double> &path, const std::vector<int32_t> &z) {
  const double carrying = static_cast<double>(s.last.lp.spheres()), most = Tuning::centrality * Tuning::centrality;
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
  control.tolerance = gap / InteriorPointTuning::near_gap;
  control.threads = s.o.threads;
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
  GapRows rows(net, p.dim, net.vector, translation_ground, s.system);
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

// The end of a crunch at a finite duality gap. On the path y c = mu for every row: a contact has much force and a small
// gap, another pair the reverse. The linear program at this point parts those in between; a curved path may still part
// some of them the other way. False where the forces of the LP do not balance or leave a larger gap than the options
// allow, or when interrupted.
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

void add_history_row(CrunchState &s, double gap, size_t pairs, const PathPoint &at) {
  s.history.stage.path = at;
  HistoryRow &row = record_step(s, JAM_STEP_PATH);
  row[JAM_HISTORY_DUALITY_GAP] = gap;
  row[JAM_HISTORY_PAIRS] = static_cast<double>(pairs);
  if (s.history.details()) report_step(s, JAM_PHASE_CRUNCH, gap, row[JAM_HISTORY_STEP_MAX]);
}

}  // namespace

Phase follow_path(CrunchState &s) {
  s.history.stage.path_taken = true;
  s.last.active = ActiveSet();  // of the state before: an interrupted path leaves no contacts
  BarrierPathControl control;
  control.tuning = s.tuning;
  // Opens the gaps that the LP's own gain and the curvature of its step would close.
  control.opening = std::max(
      {0.5 * s.out.report.gain, s.tuning.opening * s.out.report.max_step * s.out.report.max_step, contact_gap_limit});
  control.strain = s.next.strain;
  control.least_gap = frees_cell(s) ? s.tuning.close_gap : s.o.duality_gap / s.tuning.lp_to_path_gap;
  // Strains lead away from the maximum at fixed cell, so gaps are opened as far as motions of length min_bound open
  // them.
  if (s.next.strain.count() > 0) control.opening = s.tuning.min_bound * s.tuning.min_bound;
  control.threads = s.o.threads;
  control.lps = s.out.report.lp_solves;
  control.from = s.history.stage.path;
  control.done = [&s](double part) { return part_done(s, part, 0.0); };
  control.on_step = [&s](double gap, size_t pairs, const PathPoint &at) { add_history_row(s, gap, pairs, at); };
  BarrierPathResult path = follow_barrier_path(s.out.packing, control, s.system, s.monitor);
  // Forces do not balance at every point of the path: then it continues to a smaller gap.
  while (path.reached && path.gap > s.tuning.path_end(s.out.packing) && s.o.duality_gap > 0.0 &&
         !stop_if_interrupted(s) && !stop_at_lp_limit(s)) {
    if (ends_at_gap(s, path.multipliers)) return Phase::done;
    control.from = s.history.stage.path;
    control.least_gap = s.tuning.reduction * path.gap;
    path = follow_barrier_path(s.out.packing, control, s.system, s.monitor);
  }
  if (s.history.behind(s.out.packing)) add_history_row(s, path.gap, 0, PathPoint());
  if (stop_if_interrupted(s) || stop_at_lp_limit(s)) return Phase::identify;
  s.history.stage.path = PathPoint();
  s.monitor.log(JAM_LOG_INFO, "path: %s duality gap %.2e after %d factorisations, %d saddles, phi %.12f",
                path.reached ? "reached" : "stopped at", path.gap, path.factorisations, path.increases,
                packing_fraction(s.out.packing));
  if (path.reached && frees_cell(s)) return free_cell(s), Phase::barrier_path;
  s.next.bound = path.reached && s.o.step_bound == 0.0 ? s.tuning.min_bound : first_bound(s.out.packing, s.o, s.tuning);
  s.next.multipliers = std::move(path.multipliers);
  s.last.at_bound = 0;
  s.next.moved = path.reached ? 0.0 : 1.0;
  return Phase::approach;
}

PairList select_neighbours(const Packing &p, double reach, double slope, const Tuning &tuning) {
  std::vector<double> own(p.n(), reach);
  PairList pairs = find_pairs(p, reach, slope);
  const double unit = diameter_mean(p), limit = tuning.farthest_reach * unit;
  while (reach < limit) {
    const std::vector<size_t> free = uncovered_spheres(p, pairs, tuning.covered);
    if (free.empty()) break;
    reach = std::min(2.0 * std::max(reach, tuning.least_reach * unit), limit);
    std::vector<char> again(p.n(), 0);
    for (const size_t i : free) own[i] = reach, again[i] = 1;
    pairs = replace_pairs(pairs, again, find_pairs_of(p, again, own, slope));
  }
  return pairs;
}

}  // namespace jam::inside
