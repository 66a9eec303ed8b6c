#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "linalg/dot.hpp"
#include "soft/decompression.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {
namespace {

// Stable spheres with no contact too few. The curvature of a round wall may hold them with fewer.
bool enough_contacts(const SoftResult &at) {
  return at.report.stable > 0 && (at.report.excess_contacts >= 0 || at.packing.container.curved() != 0);
}

// Contacts of one state of self-stress that hold all stable spheres: the symmetries of the scene are the zero modes of
// the Hessian, and it has no negative one.
bool is_isostatic(const SoftState &state, const SoftResult &at, int64_t &factorisations) {
  if (!enough_contacts(at) || at.report.excess_contacts > 0) return false;
  const SoftContacts contacts = state.contacts();
  SoftHessian hessian;
  return hessian.factorise(state, contacts, stable_contacts(state, contacts), 0.0, factorisations) &&
         hessian.shift() == 0.0;
}

SoftRow row_of(const SoftResult &at, const Effort &before, const Effort &after, double seconds) {
  const jam_relax_report &r = at.report;
  SoftRow row{};
  row[JAM_SOFT_PHI] = r.packing_fraction;
  row[JAM_SOFT_PRESSURE] = r.pressure;
  row[JAM_SOFT_ENERGY] = r.energy / static_cast<double>(at.packing.n());
  row[JAM_SOFT_COORDINATION] = r.coordination;
  row[JAM_SOFT_DISTANCE] = r.distance;
  row[JAM_SOFT_EXCESS] = static_cast<double>(r.excess_contacts);
  row[JAM_SOFT_RATTLERS] = static_cast<double>(r.rattlers);
  row[JAM_SOFT_RESIDUAL] = r.force_residual;
  row[JAM_SOFT_EVALUATIONS] = static_cast<double>(after.evaluations - before.evaluations);
  row[JAM_SOFT_FACTORISATIONS] = static_cast<double>(after.factorisations - before.factorisations);
  row[JAM_SOFT_SECONDS] = seconds;
  return row;
}

}  // namespace

jam_decompress_options default_decompress_options() {
  const jam_relax_options r = default_relax_options();
  jam_decompress_options o{};
  o.struct_size = sizeof o;
  o.minimiser = r.minimiser;
  o.scale = r.scale;
  o.precision = r.precision;
  o.alpha = r.alpha;
  o.force_tolerance = r.force_tolerance;
  o.energy_factor = 0.01;
  o.isostatic = o.crunch = 1;
  o.max_steps = 1000;
  o.max_evaluations = r.max_evaluations;
  o.wall_time = r.wall_time;
  return o;
}

void check_decompress_options(const jam_decompress_options &o) {
  jam_relax_options r = default_relax_options();
  r.minimiser = o.minimiser, r.scale = o.scale, r.precision = o.precision, r.alpha = o.alpha;
  r.force_tolerance = o.force_tolerance, r.max_evaluations = o.max_evaluations, r.wall_time = o.wall_time;
  check_relax_options(r);
  if (!(o.energy_factor > 0.0 && o.energy_factor < 1.0))
    fail(JAM_E_ARGUMENT, "energy_factor is %g, it must be in (0, 1)", o.energy_factor);
  check_not_negative(o.pressure, "pressure");
  check_not_negative(o.distance, "distance");
  check_flag(o.isostatic, "isostatic");
  check_flag(o.crunch, "crunch");
  if (o.max_steps < 1) fail(JAM_E_ARGUMENT, "max_steps is %d, it must be at least 1", o.max_steps);
  if (o.reserved != 0) fail(JAM_E_ARGUMENT, "reserved is %d, it must be 0", o.reserved);
}

// H u = S^T (k sigma growth): contacts keep their forces' directions, and the overlaps of an isostatic network all
// change by one factor.
void follow_growth(SoftState &state, double growth, Effort &effort) {
  const size_t d = static_cast<size_t>(state.dim());
  const SoftContacts contacts = state.contacts();
  const std::vector<char> on = stable_contacts(state, contacts);
  SoftHessian hessian;
  if (!if_it_fits(effort, false, [&] { return hessian.factorise(state, contacts, on, 0.0, effort.factorisations); })) {
    state.scale_diameters(math::exp(growth));
    return;
  }
  std::vector<double> u(state.n() * d, 0.0);
  for (size_t q = 0; q < contacts.size(); ++q) {
    if (!on[q]) continue;
    const double sigma = contacts.distance[q] + contacts.overlap[q];
    const double push = state.energy().stiffness(contacts.overlap[q], contacts.force[q]) * sigma * growth;
    const size_t i = state.pairs().i[contacts.pair[q]], j = state.pairs().j[contacts.pair[q]];
    for (size_t c = 0; c < d; ++c) {
      u[i * d + c] += push * contacts.normal[q * d + c];
      if (!state.pairs().wall(contacts.pair[q])) u[j * d + c] -= push * contacts.normal[q * d + c];
    }
  }
  hessian.solve(u);
  const double most = largest_entry(u);
  if (!(most < DecompressTuning::longest_guess * state.diameter_mean())) {
    const double part = DecompressTuning::longest_guess * state.diameter_mean() / most;
    for (double &x : u) x *= part;
  }
  // The linear answer holds while few contacts change: the part of it that lowers the energy most.
  std::vector<double> force;
  SoftState best = state;
  best.scale_diameters(math::exp(growth));
  double least = best.evaluate(force).energy;
  for (const double part : {0.25, 0.5, 1.0}) {
    SoftState moved = state;
    for (size_t k = 0; k < u.size(); ++k) moved.displacement()[k] += part * u[k];
    moved.scale_diameters(math::exp(growth));
    const double energy = moved.evaluate(force).energy;
    if (!(energy < least)) continue;
    least = energy, best = moved;
  }
  state = best;
}

namespace {

class Decompression {
 public:
  Decompression(const Packing &start, const jam_decompress_options &o, Monitor &monitor,
                const std::function<SoftComparison(const SoftResult &)> &compare)
      : o_(o),
        monitor_(monitor),
        compare_(compare),
        state_(first_state(start, PairEnergy(o.alpha, o.scale), o.precision)),
        before_(state_),
        factor_(o.energy_factor) {
    effort_.monitor = &monitor;
    effort_.phase = JAM_PHASE_DECOMPRESS;
    effort_.packing_fraction = packing_fraction(start);
    effort_.pressure = std::nan("");
    report_.same_network = -1, report_.common_contacts = -1;
    report_.crunch_fraction = report_.force_difference = std::nan("");
  }

  DecompressionResult run() {
    bool ended = first_minimum();
    while (!ended) ended = step();
    finish();
    return std::move(out_);
  }

 private:
  bool end_with(jam_status status, int32_t reason) {
    out_.status = status, report_.stop_reason = reason;
    return true;
  }

  bool end_as(DescentEnd end) {
    out_.status = status_of(end, monitor_, report_.stop_reason);
    return true;
  }

  DescentEnd find_minimum(bool near_minimum, SoftResult &now, SoftRow &row) {
    const Effort spent = effort_;
    const double seconds = monitor_.seconds();
    const int64_t least = std::max<int64_t>(1, o_.max_evaluations / DecompressTuning::least_share);
    const int64_t most =
        effort_.evaluations > 0 ? DecompressTuning::work_share * effort_.evaluations : o_.max_evaluations;
    effort_.allow(std::clamp(most, least, o_.max_evaluations));
    Relaxation r(state_, effort_);
    const DescentEnd end = minimise_and_measure(r, o_.minimiser, o_.force_tolerance, near_minimum, now);
    row = row_of(now, spent, effort_, monitor_.seconds() - seconds);
    monitor_.log(JAM_LOG_INFO,
                 "decompress: step %lld phi %.9f distance %.3e excess %lld residual %.1e, %lld evaluations",
                 static_cast<long long>(effort_.steps), now.report.packing_fraction, now.report.distance,
                 static_cast<long long>(now.report.excess_contacts), now.report.force_residual,
                 static_cast<long long>(effort_.evaluations - spent.evaluations));
    return end;
  }

  bool first_minimum() {
    SoftRow row;
    const DescentEnd end = find_minimum(false, out_.soft, row);
    return end == DescentEnd::balanced ? keep(row) : end_as(end);
  }

  // Smaller diameters and the minimum there. One that has lost its contacts, or was not found, is taken back.
  bool step() {
    ++effort_.steps;
    const double fall = out_.soft.report.distance * (1.0 - math::pow(factor_, 1.0 / o_.alpha));
    if (math::exp(-fall) == 1.0) return end_with(JAM_PRECISION, JAM_STOP_PRECISION);  // no diameter would change
    if (o_.minimiser == JAM_MINIMISER_NEWTON) {
      const bool followed = ends_before_cancel([&] {
        centre_rattlers(state_);
        state_.moved();
        follow_growth(state_, -fall, effort_);
      });
      if (!followed) return end_as(DescentEnd::interrupted);
    } else {
      state_.scale_diameters(math::exp(-fall));
    }
    SoftResult now;
    SoftRow row;
    const DescentEnd end = find_minimum(true, now, row);
    if (end == DescentEnd::interrupted) return end_as(end);
    if (end == DescentEnd::balanced && enough_contacts(now)) {
      out_.soft = std::move(now);
      factor_ = std::max(factor_ * factor_, o_.energy_factor);
      return keep(row);
    }
    ++report_.restored;
    state_ = before_;
    factor_ = std::sqrt(factor_);
    if (factor_ <= DecompressTuning::last_factor) return false;
    if (end == DescentEnd::limit || end == DescentEnd::rounding) return end_as(end);
    return end_with(JAM_NOT_CONVERGED, JAM_STOP_STALLED);
  }

  // Notes a minimum; true when it is the end.
  bool keep(const SoftRow &row) {
    out_.history.push_back(row);
    before_ = state_;
    const jam_relax_report &at = out_.soft.report;
    effort_.packing_fraction = at.packing_fraction, effort_.pressure = at.pressure;
    report_.isostatic = 0;
    const auto test = [&] { return is_isostatic(state_, out_.soft, effort_.factorisations); };
    if (!ends_before_cancel([&] { report_.isostatic = o_.isostatic ? test() : if_it_fits(effort_, false, test); }))
      return end_as(DescentEnd::interrupted);
    const bool target = at.pressure <= o_.pressure || at.distance <= o_.distance;
    if (target || (o_.isostatic && report_.isostatic)) {
      const bool same = !compare_ || same_as_hard();
      if (compare_ && report_.same_network == -1 && monitor_.interrupted()) return end_as(DescentEnd::interrupted);
      if (target || same) return end_with(JAM_OK, at.pressure <= o_.pressure ? JAM_STOP_PRESSURE : JAM_STOP_CONVERGED);
    }
    if (at.mean_overlap < overlap_resolution(out_.soft.packing)) return end_with(JAM_PRECISION, JAM_STOP_PRECISION);
    if (effort_.steps >= o_.max_steps) return end_with(JAM_LIMIT, JAM_STOP_STEPS);
    return false;
  }

  // Whether the packing of a crunch from below has the same network. Records the comparison.
  bool same_as_hard() {
    const SoftComparison hard = compare_(out_.soft);
    report_.same_network = hard.same_network;
    report_.common_contacts = hard.common_contacts;
    report_.crunch_fraction = hard.packing_fraction;
    report_.force_difference = hard.force_difference;
    report_.seconds_crunch += hard.seconds;
    return hard.same_network == 1;
  }

  void finish() {
    const jam_relax_report &at = out_.soft.report;
    report_.force_residual = at.force_residual;
    report_.energy = at.energy;
    report_.pressure = at.pressure;
    report_.packing_fraction = at.packing_fraction;
    report_.distance = at.distance;
    report_.jammed_fraction = at.jammed_fraction;
    report_.coordination = at.coordination;
    report_.contacts = at.contacts;
    report_.excess_contacts = at.excess_contacts;
    report_.rattlers = at.rattlers;
    report_.steps = effort_.steps;
    report_.evaluations = effort_.evaluations;
    report_.factorisations = effort_.factorisations;
    report_.seconds = monitor_.seconds();
    out_.report = report_;
  }

  const jam_decompress_options &o_;
  Monitor &monitor_;
  const std::function<SoftComparison(const SoftResult &)> &compare_;
  SoftState state_, before_;  // now, and at the last minimum
  double factor_;             // of the energy in the next step
  Effort effort_;
  DecompressionResult out_;
  jam_decompress_report report_{};
};

}  // namespace

DecompressionResult decompress(const Packing &start, const jam_decompress_options &o, Monitor &monitor,
                               const std::function<SoftComparison(const SoftResult &)> &compare) {
  check_decompress_options(o);
  monitor.wall_time = o.wall_time;
  return Decompression(start, o, monitor, compare).run();
}

}  // namespace jam::inside
