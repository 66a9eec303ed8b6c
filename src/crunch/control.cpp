#include "crunch/phases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "core/size_laws.hpp"
#include "verdict/text.hpp"

namespace jam::inside {

void stop(CrunchState &s, jam_stop_reason reason, jam_status status) {
  s.out.report.stop_reason = reason, s.out.status = status;
}

bool stop_if_interrupted(CrunchState &s) {
  if (!s.monitor.interrupted()) return false;
  const bool cancelled = s.monitor.cancelled();
  stop(s, cancelled ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME, cancelled ? JAM_CANCELLED : JAM_LIMIT);
  return true;
}

bool stop_at_lp_limit(CrunchState &s) {
  if (s.out.report.lp_solves < s.o.max_lps) return false;
  stop(s, JAM_STOP_LP_LIMIT, JAM_LIMIT);
  return true;
}

void forget_contacts(CrunchState &s) {
  s.out.contacts = ContactNetwork();
  s.out.contacts.coordination.assign(s.out.packing.n(), 0);
  s.found.verdict = PackingVerdict();
  report_verdict(s.found.verdict, s.out.report);
}

void restart_lps(CrunchState &s, double bound) {
  s.next.bound = bound;
  s.next.moved = 1.0;
  s.next.stalled = 0;
  s.found.narrow = false;
  forget_contacts(s);
}

// An estimate for progress bars. The first decades of mu on a path take the longest, so the root of their share.
// Decades of gain in sequential LPs take about equal times.
double part_done(const CrunchState &s, double path, double gain) {
  double part = s.history.stage.path_taken ? 1.0 : 0.0;
  const double of_gain = log_share(s.first_gain, gain, s.next.gain_tolerance);
  if (!std::isnan(path))
    part = std::sqrt(path);
  else if (s.o.method == JAM_CRUNCH_SEQUENTIAL_LP && !std::isnan(of_gain))
    part = of_gain;
  const double rounds = s.o.strain == JAM_STRAIN_NONE ? 1.0 : 2.0, begun = s.next.strain.count() > 0 ? 1.0 : 0.0;
  return (begun + before_verdict * part) / rounds;
}

bool report_step(CrunchState &s, jam_phase phase, double gain, double step, bool finished) {
  jam_progress progress = progress_of(phase);
  progress.packing_fraction = packing_fraction(s.out.packing);
  progress.fraction = part_done(s, std::numeric_limits<double>::quiet_NaN(), gain);
  progress.gain = gain;
  progress.max_step = step;
  progress.steps = s.out.report.lp_solves;
  progress.factorisations = s.system.factorisations;
  s.history.step().shown = finished && s.history.details();
  const bool stopped = s.monitor.report(progress, true);
  s.history.step().shown = false;
  return stopped;
}

HistoryRow &record_step(CrunchState &s, jam_step_phase phase, const double *displacement) {
  return s.history.moved(s.out.packing, phase, s.monitor.seconds(), s.system.factorisations, displacement);
}

void record_opening(CrunchState &s) {
  const HistoryRow &row = record_step(s, JAM_STEP_PATH);
  if (s.history.details()) report_step(s, JAM_PHASE_CRUNCH, row[JAM_HISTORY_GAIN], row[JAM_HISTORY_STEP_MAX]);
}

void record_contacts(CrunchState &s, HistoryRow &row, size_t contacts, const std::vector<int32_t> &coordination) {
  const Packing &p = s.out.packing;
  const int64_t stable = stable_spheres(coordination), of_one_state = isostatic_contacts(stable, p.dim, p.container);
  row[JAM_HISTORY_CONTACTS] = static_cast<double>(contacts);
  row[JAM_HISTORY_EXCESS] = static_cast<double>(static_cast<int64_t>(contacts) - of_one_state);
  row[JAM_HISTORY_RATTLERS] = static_cast<double>(static_cast<int64_t>(coordination.size()) - stable);
  s.history.over_stable(coordination);
}

double free_spacing(const Packing &p) {
  return std::max(0.0, math::pow(packing_fraction(p), -1.0 / p.dim) - math::pow(jammed_fraction(p.dim), -1.0 / p.dim));
}

std::vector<double> relative_gaps(const Packing &p, const PairList &pairs) {
  std::vector<double> gap(pairs.size());
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < gap.size(); ++k)
    gap[k] = std::sqrt(pair_vector(p, pairs, k, r)) / contact_distance(p, pairs.i[k], pairs.j[k]) - 1.0;
  return gap;
}

double contact_gap(const Packing &p) {
  constexpr double widest = 0.5;
  const PairList pairs = find_pairs(p, 0.0, 1.0 + widest);
  const size_t wanted = static_cast<size_t>(p.dim) * p.n() / 2;
  if (pairs.size() <= wanted) return widest;
  std::vector<double> gap = relative_gaps(p, pairs);
  std::nth_element(gap.begin(), gap.begin() + wanted, gap.end());
  return gap[wanted];
}

}  // namespace jam::inside
