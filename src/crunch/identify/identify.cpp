#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cell_change.hpp"
#include "core/pair_rule.hpp"
#include "crunch/phases.hpp"
#include "linalg/dot.hpp"
#include "network/force_balance.hpp"
#include "network/rigidity_matrix.hpp"
#include "network/stress_cone.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

class Polish {
 public:
  Polish(NewtonSystem &system, int threads, const Tuning &tuning, double allowed_overlap, Monitor *monitor)
      : system_(system), threads_(threads), t_(tuning), allowed_(allowed_overlap), monitor_(monitor) {}

  // A contact too many can be a gap that the LP could not distinguish from a force. Then the rest closes without it.
  PolishEnd close_and_balance(Packing &p, ContactNetwork &net) {
    PolishEnd end = try_contacts(p, net);
    while (drops_gap(p, net, end)) end = try_contacts(p, net);
    return end;
  }

 private:
  PolishEnd try_contacts(Packing &p, ContactNetwork &net) {
    if (!close_all(p, net)) return PolishEnd::interrupted;
    if (!(largest_entry(net.gap) < t_.closing_gap)) return PolishEnd::open_contact;
    const bool round = p.container.curved() != 0;
    if (net.size() == 0 || (!round && excess_contacts(net, p) < 0)) return PolishEnd::too_few;
    balance_forces(p, net);
    if (round && !(balance_residual(p.dim, p.n(), net) < RigidityTuning::most_residual) &&
        !converge_at_curved_maximum(p, net))
      return PolishEnd::too_few;
    const bool one_state = excess_contacts(net, p) <= 0;
    // Forces of several states of self-stress are not unique: the test of the network decides which contacts carry.
    if (one_state && !pushes_only(net)) {
      log("polish: %td of %zu contacts pull, the strongest with %.1e",
          std::count_if(net.force.begin(), net.force.end(), [](double f) { return !(f > 0.0); }), net.size(),
          -*std::min_element(net.force.begin(), net.force.end()));
      return PolishEnd::negative_force;
    }
    if (closest_contact(p).gap < allowed_) return PolishEnd::overlap;
    return largest_entry(net.gap) > t_.closed_limit(p) ? PolishEnd::open_contact : PolishEnd::done;
  }

  // Contacts that do not close together leave gaps r that are orthogonal to all motions, and so balance, as forces
  // f - t r do. The contact whose force vanishes first, at t > 0, has its gap open once the rest closes. False where
  // there is none to drop, and in crystals, where gaps of many contacts too many say little.
  bool drops_gap(const Packing &p, ContactNetwork &net, PolishEnd end) const {
    if (end != PolishEnd::open_contact && end != PolishEnd::overlap) return false;
    const bool open =
        largest_entry(net.gap) > t_.closed_limit(p) || *std::min_element(net.gap.begin(), net.gap.end()) < allowed_;
    const int64_t excess = excess_contacts(net, p);
    if (!open || excess <= 0 || excess > t_.max_excess || !pushes_only(net)) return false;
    size_t weakest = net.size();
    double part = 0.0;
    for (size_t k = 0; k < net.size(); ++k)
      if (net.gap[k] > 0.0 && (weakest == net.size() || net.force[k] < part * net.gap[k]))
        weakest = k, part = net.force[k] / net.gap[k];
    if (weakest == net.size()) return false;
    log("polish: contact of %d and %d does not close, with a force of %.1e and a gap of %.1e", net.pairs.i[weakest],
        net.pairs.j[weakest], net.force[weakest], net.gap[weakest]);
    for (size_t k = 0; k < net.size(); ++k) net.force[k] -= part * net.gap[k];
    std::vector<char> on(net.size(), 1);
    on[weakest] = 0;
    net = subset(net, on, p.dim);
    return true;
  }

  template <class... T>
  void log(const char *format, T... values) const {
    if (monitor_) monitor_->log(JAM_LOG_DEBUG, format, values...);
  }

  // One Gauss-Newton step of all gaps to zero over positions and the common factor of the diameters. With a single
  // state of self-stress the system is square and the step is Newton's; with more contacts it is least squares.
  void close_once(Packing &p, ContactNetwork &net) {
    const std::vector<double> a = relative_rows(p, net);
    GapRows rows(net, p.dim, a, translation_ground, system_);
    if (!rows.factorise()) return;
    std::vector<double> wanted(net.gap), got;
    for (double &h : wanted) h = -h;
    const Motion motion = rows.towards(wanted, got);
    move_packing(p, net.pairs, motion.s.data(), diameter_mean(p), 1.0 + motion.g);
    measure_contacts(p, net);
  }

  // False when interrupted.
  bool close_all(Packing &p, ContactNetwork &net) {
    system_.set_graph(p.dim, static_cast<int32_t>(p.n()), net.pairs, threads_);
    const auto open = [&] { return excess_contacts(net, p) > 0 ? norm(net.gap) : largest_entry(net.gap); };
    constexpr double rounding = 0.5 * std::numeric_limits<double>::epsilon();
    double worst = open();
    for (int round = 0; worst > rounding; ++round) {
      log("polish %d largest gap %.2e", round, largest_entry(net.gap));
      if (monitor_ && monitor_->interrupted()) return false;
      Packing p_old = p;
      ContactNetwork old = net;
      close_once(p, net);
      const double now = open();
      if (!(now < t_.progress * worst)) {  // rounding, or the contacts cannot all close
        if (!(now < worst)) p = std::move(p_old), net = std::move(old);
        break;
      }
      worst = now;
    }
    return !(monitor_ && monitor_->interrupted());
  }

  // The nearest forces that balance on every sphere, in units of their mean.
  void balance_forces(const Packing &p, ContactNetwork &net) {
    GapRows rows(net, p.dim, net.vector, translation_ground, system_);
    if (!rows.factorise()) return;
    rows.balance(net.force);
    scale_to_mean(net);
  }

  NewtonSystem &system_;
  const int threads_;
  const Tuning &t_;
  const double allowed_;
  Monitor *monitor_;
};

// A lattice of one sphere has nothing but its cell that could leave a saddle. Lengths change by less than the share.
void strain_at_random(Packing &p, Rng &rng, double share) {
  const size_t d = static_cast<size_t>(p.dim);
  std::vector<double> strain(d * d);
  const auto open = [&](size_t c) { return (p.container.closed() >> c & 1) == 0; };
  for (size_t a = 0; a < d; ++a)
    for (size_t b = a; b < d; ++b)
      if (open(a) && open(b)) strain[a * d + b] = (2.0 * rng.uniform() - 1.0) * share / static_cast<double>(d);
  PairList none;
  strain_at_fixed_volume(p, none, strain);
}

// Spheres that come no nearer may be jammed. A limit of the call says nothing about them.
Phase end_early(CrunchState &s) {
  return s.out.report.stop_reason == JAM_STOP_STALLED ? give_verdict(s, {}) : Phase::done;
}

}  // namespace

Phase identify(CrunchState &s) {
  if (frees_cell(s)) return free_cell(s);
  if (s.last.active.rows.empty()) {
    if (s.out.report.stop_reason == JAM_STOP_NONE && !s.found.narrow && s.o.polish) return Phase::narrow_lps;
    if (s.out.report.stop_reason != JAM_STOP_NONE) return Phase::done;
    return s.o.polish && recompress(s) ? Phase::approach : give_verdict(s, {});
  }
  s.out.contacts = make_contacts(s.out.packing, s.last.pairs, s.last.answer, s.last.active);
  // Along a flex that only the curvature of a round wall ends, a step reaches a small part of the growth of its LP.
  // Newton's steps on contacts and forces may get there.
  const int32_t reason = s.out.report.stop_reason;
  const bool slow =
      s.out.packing.container.curved() != 0 && (reason == JAM_STOP_STALLED || reason == JAM_STOP_LP_LIMIT);
  if (reason != JAM_STOP_NONE && !(slow && s.o.polish)) return end_early(s);
  if (s.o.polish && !polish_contacts(s)) return Phase::done;
  if (slow && !s.found.polished) return end_early(s);
  if (slow) stop(s, JAM_STOP_NONE, JAM_OK);
  if (s.o.polish && !s.found.polished && !converged(s)) {
    s.next.gain_tolerance = default_crunch_options().gain_tolerance;
    forget_contacts(s);
    return Phase::approach;
  }
  if (s.o.polish && !s.found.polished && !s.found.narrow) return Phase::narrow_lps;
  return decide_jamming(s);
}

Phase narrow_lps(CrunchState &s) {
  const Tuning &t = s.tuning;
  s.found.narrow = true;
  const double narrowest = std::sqrt(t.closed_gap);  // the motion whose square is rounding
  s.next.moved = 0.0;                                // they begin at an optimum: its forces are near theirs
  s.next.bound = std::min(s.next.bound, t.narrow_bound);
  for (int k = 0; k < t.max_narrow_lps && !stop_at_lp_limit(s); ++k) {
    const double reach = build_lp(s, t.reach_per_bound * s.next.bound * diameter_mean(s.out.packing));
    IpmControl control;
    control.tolerance = s.o.lp_tolerance * s.next.bound;
    control.ridge = 0.0;
    const LpAnswer answer = solve_lp(s, control);
    if (stop_if_interrupted(s)) break;
    if (answer != LpAnswer::kept) {
      s.monitor.log(JAM_LOG_WARNING, "narrow LP: no answer");
      return decide_jamming(s);  // of the contacts that are there
    }
    const LpStep step = make_step(s, reach);
    if (report_step(s, JAM_PHASE_CRUNCH, step.gain, step.longest)) stop(s, JAM_STOP_CANCELLED, JAM_CANCELLED);
    if (s.out.report.stop_reason != JAM_STOP_NONE) break;
    // of spheres, or of the strain, which moves own images alone
    const double longest = std::max(step.longest, largest_entry(s.last.answer.strain));
    s.next.moved = longest;
    const bool converged = step.gain < t.closed_gap;
    if (converged && s.next.bound <= narrowest && longest < narrowest) break;
    s.next.bound = std::max(narrowest, std::min(converged ? t.narrower * s.next.bound : s.next.bound, 10.0 * longest));
  }
  return Phase::identify;
}

bool recompress(CrunchState &s) {
  const auto &parts = s.tuning.decompression;
  const size_t done = s.history.stage.decompressions;
  if (done >= parts.size() || !(parts[done] > 0.0)) return false;
  ++s.history.stage.decompressions;
  Packing &p = s.out.packing;
  s.monitor.log(JAM_LOG_INFO, "not shown to be jammed at phi %.12f: decompresses by %.0e of the diameters",
                packing_fraction(p), parts[done]);
  // Gaps open by parts[done] of sigma_ij = (1 + Delta) (s_i + s_j) / 2, or of (s_i + s_j) / 2. Each of two spheres
  // moves by at most half of the share of_screened of a gap; the strain of a free cell takes the rest.
  const size_t d = static_cast<size_t>(p.dim);
  const double gap = parts[done] * std::min(1.0, 1.0 + p.non_additivity),
               room = 0.5 * WorkingSetTuning::of_screened * gap / std::sqrt(static_cast<double>(d));
  Rng rng(p.seed, Stream::recompression, static_cast<uint64_t>(done) << 40);
  for (size_t k = 0; k < p.position.size(); ++k)
    p.position[k] += (2.0 * rng.uniform() - 1.0) * room * p.diameter[k / d];
  for (double &diameter : p.diameter) diameter *= 1.0 - parts[done];
  if (s.o.strain == JAM_STRAIN_FREE) strain_at_random(p, rng, (1.0 - WorkingSetTuning::of_screened) * gap);
  wrap_positions(p);
  record_opening(s);
  s.history.stage.path_taken = false;
  s.last.active = ActiveSet();
  restart_lps(s, first_bound(p, s.o, s.tuning));
  return true;
}

PolishEnd polish(Packing &p, ContactNetwork &net, NewtonSystem &system, int threads, const Tuning &tuning,
                 Monitor *monitor) {
  if (net.size() == 0) return PolishEnd::no_contacts;
  Polish polisher(system, threads, tuning, std::min(-tuning.rounded_overlap(p), closest_contact(p).gap), monitor);
  Packing q = p;
  ContactNetwork better = net;
  const PolishEnd end = polisher.close_and_balance(q, better);
  if (end != PolishEnd::done) return end;
  p = std::move(q);
  net = std::move(better);
  return PolishEnd::done;
}

}  // namespace jam::inside
