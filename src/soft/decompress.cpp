#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "soft/decompression.hpp"
#include "soft/soft_hessian.hpp"

namespace jam {
namespace {

// A step that failed is tried again with the square root of its factor, up to this one.
constexpr double last_factor = 0.95;

// Contacts of one state of self-stress that hold all stable spheres: the Hessian has d zero modes and no negative one.
bool is_isostatic(const SoftState &state, const SoftResult &at, int64_t &factorisations) {
  if (at.report.stable == 0 || at.report.excess_contacts != 0) return false;
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

// Whether the judge's jammed packing has the same network; notes the verdict.
bool ask(const std::function<SoftVerdict(const SoftResult &)> &judge, const SoftResult &soft,
         jam_decompress_report &report) {
  const SoftVerdict verdict = judge(soft);
  report.same_network = verdict.same_network;
  report.common_contacts = verdict.common_contacts;
  report.crunch_fraction = verdict.packing_fraction;
  report.force_difference = verdict.force_difference;
  report.seconds_crunch += verdict.seconds;
  return verdict.same_network;
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
  if (!(o.pressure >= 0.0)) fail(JAM_E_ARGUMENT, "pressure is %g, it must be >= 0", o.pressure);
  if (!(o.distance >= 0.0)) fail(JAM_E_ARGUMENT, "distance is %g, it must be >= 0", o.distance);
  if (o.isostatic != 0 && o.isostatic != 1) fail(JAM_E_ARGUMENT, "isostatic is %d, it must be 0 or 1", o.isostatic);
  if (o.crunch != 0 && o.crunch != 1) fail(JAM_E_ARGUMENT, "crunch is %d, it must be 0 or 1", o.crunch);
  if (o.max_steps < 1) fail(JAM_E_ARGUMENT, "max_steps is %d, it must be at least 1", o.max_steps);
  if (o.reserved != 0) fail(JAM_E_ARGUMENT, "reserved is %d, it must be 0", o.reserved);
}

// H u = S^T (k sigma growth): contacts keep their forces' directions, and the overlaps of an isostatic network all
// change by one factor.
void follow_growth(SoftState &state, double growth, int64_t &factorisations) {
  const size_t d = static_cast<size_t>(state.dim());
  const SoftContacts contacts = state.contacts();
  const std::vector<char> on = stable_contacts(state, contacts);
  SoftHessian hessian;
  if (!hessian.factorise(state, contacts, on, 0.0, factorisations)) {
    state.scale_diameters(std::exp(growth));
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
      u[j * d + c] -= push * contacts.normal[q * d + c];
    }
  }
  hessian.solve(u);
  double most = 0.0;
  for (const double x : u) most = std::max(most, std::fabs(x));
  if (!(most < 0.1 * state.diameter_mean())) {
    const double part = 0.1 * state.diameter_mean() / most;
    for (double &x : u) x *= part;
  }
  // The linear answer holds while few contacts change: the part of it that lowers the energy most.
  std::vector<double> force;
  SoftState best = state;
  best.scale_diameters(std::exp(growth));
  double least = best.evaluate(force).energy;
  for (const double part : {0.25, 0.5, 1.0}) {
    SoftState moved = state;
    for (size_t k = 0; k < u.size(); ++k) moved.displacement()[k] += part * u[k];
    moved.scale_diameters(std::exp(growth));
    const double energy = moved.evaluate(force).energy;
    if (!(energy < least)) continue;
    least = energy, best = moved;
  }
  state = best;
}

DecompressionResult decompress(const Packing &start, const jam_decompress_options &o, Monitor &monitor,
                               const std::function<SoftVerdict(const SoftResult &)> &judge) {
  check_decompress_options(o);
  monitor.wall_time = o.wall_time;
  Effort effort;
  effort.monitor = &monitor;
  effort.phase = JAM_PHASE_DECOMPRESS;
  effort.packing_fraction = packing_fraction(start);
  effort.pressure = std::nan("");
  DecompressionResult out;
  jam_decompress_report &report = out.report;
  report.same_network = -1, report.common_contacts = -1;
  report.crunch_fraction = report.force_difference = std::nan("");
  SoftState state(start, PairEnergy(o.alpha, o.scale), o.precision), before = state;
  double factor = o.energy_factor;
  DescentEnd end = DescentEnd::balanced;
  bool first = true;
  out.status = JAM_NOT_CONVERGED, report.stop_reason = JAM_STOP_STALLED;
  for (;;) {
    const Effort spent = effort;
    const double seconds = monitor.seconds();
    effort.max_evaluations = effort.evaluations + o.max_evaluations;
    SoftResult now;
    {
      Relaxation r(state, effort);
      end = minimise(r, o.minimiser, o.force_tolerance, !first);
      now = measure(state, o.minimiser);
    }
    monitor.log(JAM_LOG_INFO,
                "decompress: step %lld phi %.9f distance %.3e excess %lld residual %.1e, %lld evaluations",
                static_cast<long long>(effort.steps), now.report.packing_fraction, now.report.distance,
                static_cast<long long>(now.report.excess_contacts), now.report.force_residual,
                static_cast<long long>(effort.evaluations - spent.evaluations));
    if (first && end != DescentEnd::balanced) {
      out.soft = std::move(now);
      out.status = status_of(end, monitor, report.stop_reason);
      break;
    }
    if (end == DescentEnd::interrupted) {
      if (effort.steps == 0) out.soft = std::move(now);
      out.status = status_of(end, monitor, report.stop_reason);
      break;
    }
    const bool lost = end != DescentEnd::balanced || now.report.stable == 0 || now.report.excess_contacts < 0;
    if (lost && !first) {
      ++report.restored;
      state = before;
      factor = std::sqrt(factor);
      if (factor > last_factor) {
        if (end != DescentEnd::balanced) out.status = status_of(end, monitor, report.stop_reason);
        if (end == DescentEnd::no_overlaps || end == DescentEnd::balanced)
          out.status = JAM_NOT_CONVERGED, report.stop_reason = JAM_STOP_STALLED;
        break;
      }
    } else {
      out.soft = std::move(now);
      out.history.push_back(row_of(out.soft, spent, effort, monitor.seconds() - seconds));
      if (!first && factor > o.energy_factor) factor = std::max(factor * factor, o.energy_factor);
      const jam_relax_report &at = out.soft.report;
      effort.packing_fraction = at.packing_fraction, effort.pressure = at.pressure;
      report.isostatic = is_isostatic(state, out.soft, effort.factorisations);
      const bool target = at.pressure <= o.pressure || at.distance <= o.distance;
      if (target || (o.isostatic && report.isostatic)) {
        const bool same = !judge || ask(judge, out.soft, report);
        if (target || same) {
          out.status = JAM_OK;
          report.stop_reason = at.pressure <= o.pressure ? JAM_STOP_PRESSURE : JAM_STOP_CONVERGED;
          break;
        }
      }
      if (at.mean_overlap < overlap_resolution(out.soft.packing)) {
        out.status = JAM_PRECISION, report.stop_reason = JAM_STOP_PRECISION;
        break;
      }
      if (effort.steps >= o.max_steps) {
        out.status = JAM_LIMIT, report.stop_reason = JAM_STOP_STEPS;
        break;
      }
      before = state;
    }
    first = false;
    ++effort.steps;
    const double fall = out.soft.report.distance * (1.0 - std::pow(factor, 1.0 / o.alpha));
    if (o.minimiser == JAM_MINIMISER_NEWTON) {
      centre_rattlers(state);
      state.moved();
      follow_growth(state, -fall, effort.factorisations);
    } else {
      state.scale_diameters(std::exp(-fall));
    }
  }
  const jam_relax_report &at = out.soft.report;
  report.force_residual = at.force_residual;
  report.energy = at.energy;
  report.pressure = at.pressure;
  report.packing_fraction = at.packing_fraction;
  report.distance = at.distance;
  report.jammed_fraction = at.jammed_fraction;
  report.coordination = at.coordination;
  report.contacts = at.contacts;
  report.excess_contacts = at.excess_contacts;
  report.rattlers = at.rattlers;
  report.steps = effort.steps;
  report.evaluations = effort.evaluations;
  report.factorisations = effort.factorisations;
  report.seconds = monitor.seconds();
  return out;
}

}  // namespace jam
