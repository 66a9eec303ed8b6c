#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/call_scope.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "linalg/dot.hpp"
#include "soft/decompression.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {

jam_relax_options default_relax_options() {
  jam_relax_options o{};
  o.struct_size = sizeof o;
  o.minimiser = JAM_MINIMISER_NEWTON;
  o.scale = JAM_SOFT_RELATIVE;
  o.precision = JAM_SOFT_REFERENCE;
  o.alpha = 2.0;
  o.force_tolerance = 1e-12;
  o.max_evaluations = 1000000;
  o.wall_time = std::numeric_limits<double>::infinity();
  o.strain = JAM_STRAIN_NONE;
  o.pressure = 0.0;
  o.components = -1;
  return o;
}

void check_relax_options(const jam_relax_options &o) {
  check_enum(o.minimiser, JAM_MINIMISER_NEWTON, JAM_MINIMISER_LBFGS, "minimiser", "jam_minimiser");
  check_enum(o.scale, JAM_SOFT_RELATIVE, JAM_SOFT_BARE, "scale", "jam_soft_scale");
  check_enum(o.precision, JAM_SOFT_REFERENCE, JAM_SOFT_DOUBLE, "precision", "jam_soft_precision");
  if (!(o.alpha > 1.0) || !(o.alpha <= limits::minimised_exponent_max))
    fail(JAM_E_ARGUMENT, "alpha is %g, it must be above 1 and at most %g", o.alpha, limits::minimised_exponent_max);
  check_positive(o.force_tolerance, "force_tolerance");
  check_at_least(o.max_evaluations, 1, "max_evaluations");
  check_positive(o.wall_time, "wall_time");
  check_enum(o.strain, JAM_STRAIN_NONE, JAM_STRAIN_ALL, "strain", "jam_free_strain");
  if (o.reserved != 0) fail(JAM_E_ARGUMENT, "reserved is %d, it must be 0", o.reserved);
  const bool volume = (o.strain & JAM_STRAIN_VOLUME) != 0;
  if (!(o.pressure >= 0.0) || !std::isfinite(o.pressure) || volume != (o.pressure > 0.0))
    fail(JAM_E_ARGUMENT, "pressure is %g, with strain %d it must be %s", o.pressure, o.strain,
         volume ? "positive and finite" : "0: the volume is fixed");
  if (volume) check_range("pressure", o.pressure, limits::energy_min, limits::energy_max);
}

SoftState first_state(const Packing &p, const PairEnergy &energy, int32_t precision) {
  const double sigma = contact_distance_max(p), full = energy.value(energy.relative() ? 1.0 : sigma);
  check_energy("alpha", energy.alpha(), full);
  const double weak = full / sigma * math::pow(limits::weak_overlap, energy.alpha() - 1.0);
  if (!(weak >= limits::weak_force))
    fail(JAM_E_ARGUMENT, "alpha is %g: in this unit forces are %g where spheres overlap by %g, from %g on is supported",
         energy.alpha(), weak, limits::weak_overlap, limits::weak_force);
  const CancellableScope scope;
  return SoftState(p, energy, precision);
}

DescentEnd minimise(Relaxation &r, int32_t minimiser, double tolerance, bool near_minimum, bool *convex) {
  bool unused = false;
  DescentEnd end = DescentEnd::interrupted;
  ends_before_cancel([&] {
    if (minimiser == JAM_MINIMISER_FIRE)
      end = fire(r, tolerance);
    else if (minimiser == JAM_MINIMISER_LBFGS)
      end = lbfgs(r, tolerance);
    else
      end = hybrid(r, tolerance, near_minimum, convex ? *convex : unused);
  });
  return end;
}

// Of spheres that overlap with too few contacts to be held, as those of a straight line, and where the Hessian is not
// positive. Its zero modes may be any. Without Newton's method a large Hessian is not factorised for this question
// alone.
bool is_saddle(const Relaxation &r, const SoftResult &found, bool newton, bool convex) {
  if (found.report.contacts == 0) return found.report.max_overlap > overlap_resolution(found.packing);
  const SoftContacts contacts = r.state.contacts();
  const std::vector<char> on = stable_contacts(r.state, contacts);
  const double loose = RelaxTuning::loose_force * r.sums.mean_force();
  double push = 0.0, stiffness = 0.0;
  for (size_t q = 0; q < contacts.size(); ++q) {
    const size_t k = contacts.pair[q];
    const bool own_image = r.state.pairs().i[k] == r.state.pairs().j[k];
    if (!on[q] && !own_image && contacts.force[q] > loose && r.state.base().container.curved() == 0) return true;
    push += contacts.force[q] / contacts.distance[q];
    stiffness += r.state.energy().stiffness(contacts.overlap[q], contacts.force[q]);
  }
  if (convex) return false;
  const double shift = RelaxTuning::saddle_curvature * push / stiffness;
  SoftHessian hessian;
  if (!newton && hessian.factor_numbers(r.state, contacts, on) > RelaxTuning::most_factor) {
    if (r.effort.monitor)
      r.effort.monitor->log(
          JAM_LOG_INFO,
          "not tested whether this is a saddle: without Newton's method the test would take most of the memory");
    return false;
  }
  return if_it_fits(r.effort, false, [&] {
    return !hessian.factorise(r.state, contacts, on, shift, r.effort.factorisations) || hessian.shift() > shift;
  });
}

static void displace_at_random(Relaxation &r, size_t attempt) {
  Rng rng(r.state.base().seed, Stream::soft_saddle, static_cast<uint64_t>(attempt) << 40);
  const double move = RelaxTuning::saddle_moves[attempt] * r.state.diameter_mean();
  if (r.effort.monitor)
    r.effort.monitor->log(JAM_LOG_INFO, "a saddle: forces balance, and spheres would buckle; all move by up to %.1e",
                          move);
  for (double &x : r.state.displacement()) x += (2.0 * rng.uniform() - 1.0) * move;
}

DescentEnd minimise_and_measure(Relaxation &r, int32_t minimiser, double tolerance, bool near_minimum,
                                SoftResult &out) {
  bool convex = false;
  double asked = tolerance;
  const auto descend = [&](bool near) { return minimise(r, minimiser, asked, near, &convex); };
  DescentEnd end = descend(near_minimum);
  size_t saddles = 0;
  for (int attempt = 0;; ++attempt) {
    out = measure(r.state, minimiser);
    if (end != DescentEnd::balanced && end != DescentEnd::rounding) return end;
    bool near = true;
    const double residual = std::max(out.report.force_residual, out.report.stress_residual);
    if (residual < tolerance) {
      bool saddle = false;
      if (!ends_before_cancel([&] { saddle = is_saddle(r, out, minimiser == JAM_MINIMISER_NEWTON, convex); }))
        return DescentEnd::interrupted;
      if (!saddle) return out.report.contacts > 0 ? DescentEnd::balanced : DescentEnd::no_overlaps;
      if (asked > RelaxTuning::before_strain) {  // so roughly, forces may balance before the minimum
        asked *= NewtonTuning::next_target;
      } else if (saddles == std::size(RelaxTuning::saddle_moves)) {
        return DescentEnd::stalled;
      } else {
        displace_at_random(r, saddles++);
        near = false;
      }
      attempt = 0;
    } else if (end == DescentEnd::rounding && attempt > 0) {
      return end;  // also from the overlaps of the rounded positions, which have more digits
    }
    const bool loads = !r.state.cell().beyond.empty();
    if (attempt == RelaxTuning::most_roundings + (loads ? RelaxTuning::most_loadings : 0))
      return r.at_rounding(residual, tolerance) ? DescentEnd::rounding : DescentEnd::stalled;
    r.evaluate();
    end = descend(near);
  }
}

jam_status status_of(DescentEnd end, const Monitor &monitor, int32_t &stop_reason) {
  switch (end) {
    case DescentEnd::balanced:
      stop_reason = JAM_STOP_CONVERGED;
      return JAM_OK;
    case DescentEnd::no_overlaps:
      stop_reason = JAM_STOP_UNJAMMED;
      return JAM_NOT_JAMMED;
    case DescentEnd::limit:
      stop_reason = JAM_STOP_EVALUATIONS;
      return JAM_LIMIT;
    case DescentEnd::interrupted:
      stop_reason = monitor.cancelled() ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME;
      return monitor.cancelled() ? JAM_CANCELLED : JAM_LIMIT;
    case DescentEnd::rounding:
      stop_reason = JAM_STOP_PRECISION;
      return JAM_PRECISION;
    case DescentEnd::yields:
    case DescentEnd::stalled:
      break;
  }
  stop_reason = JAM_STOP_STALLED;
  return JAM_NOT_CONVERGED;
}

double overlap_resolution(const Packing &p) {
  return 8.0 * std::numeric_limits<double>::epsilon() * p.cell.side() /
         *std::min_element(p.diameter.begin(), p.diameter.end());
}

// Strains the free cell along its force, that of the pressure and loads, by PressureTuning::shrink, and fixes it again.
// False where this force is 0: the strains that are free do not change the volume.
static bool shrink(Relaxation &r, const FreeCell &cell) {
  r.state.free_cell(cell);
  r.evaluate();
  std::vector<double> &u = r.state.displacement();
  const auto strains = u.begin() + static_cast<std::ptrdiff_t>(r.state.spheres());
  std::copy(r.force.begin() + static_cast<std::ptrdiff_t>(r.state.spheres()), r.force.end(), strains);
  const double unit = largest_entry(std::vector<double>(strains, u.end())) * r.state.amplitude_unit();
  std::for_each(strains, u.end(), [&](double &x) { x *= unit > 0.0 ? PressureTuning::shrink / unit : 0.0; });
  r.state.rebase();
  r.state.free_cell({});
  r.evaluate();
  return unit > 0.0;
}

DescentEnd approach_pressure(Relaxation &r, const FreeCell &cell, int32_t minimiser, double tolerance, DescentEnd end) {
  const SoftState &state = r.state;
  const double rough = std::max(tolerance, RelaxTuning::before_strain);
  const CancellableScope scope;
  while (end == DescentEnd::no_overlaps) {
    if (DescentEnd stop; r.must_stop(stop, true)) return stop;
    if (!shrink(r, cell)) return end;
    end = minimise(r, minimiser, rough, false);
  }
  const double above = r.sums.virial / (state.dim() * scene_volume(state.base()) * cell.pressure);
  const double fall = math::log(PressureTuning::overlaps_fall), all = math::log(above) / (state.energy().alpha() - 1.0);
  const double falls = std::round(std::min(all, -math::log(std::numeric_limits<double>::epsilon())) / fall);
  for (double left = falls - 1.0; can_continue(end) && left > 0.0; --left) {
    FreeCell at = cell;
    const double times = math::pow(above, left / falls);
    at.pressure *= times;
    for (double &load : at.beyond) load *= times;
    r.state.free_cell(at);
    r.evaluate();
    end = minimise(r, minimiser, rough, false);
  }
  return end;
}

// The minimum with the cell free, from that of the fixed one, which ended so.
static DescentEnd relax_cell(Relaxation &r, const jam_relax_options &o, DescentEnd end, SoftResult &out) {
  const FreeCell cell =
      free_cell_of(r.state.dim(), o.strain, o.components, o.pressure, ~r.state.base().container.closed());
  try {
    const CancellableScope scope;  // ends before the state reached is measured: that must not be cancelled
    if (cell.pressure > 0.0) end = approach_pressure(r, cell, o.minimiser, o.force_tolerance, end);
    if (can_continue(end)) {
      r.state.free_cell(cell);
      r.evaluate();
    }
  } catch (const Cancelled &) {  // in a search for pairs
    end = DescentEnd::interrupted;
  }
  if (can_continue(end)) return minimise_and_measure(r, o.minimiser, o.force_tolerance, false, out);
  out = measure(r.state, o.minimiser);
  return end;
}

SoftResult relax(const Packing &start, const jam_relax_options &o, Monitor &monitor) {
  check_relax_options(o);
  if (o.strain != JAM_STRAIN_NONE &&
      free_cell_of(start.dim, o.strain, o.components, o.pressure, ~start.container.closed()).count() == 0)
    fail(JAM_E_ARGUMENT, "components is %lld: no strain is free", static_cast<long long>(o.components));
  monitor.wall_time = o.wall_time;
  SoftState state = first_state(start, PairEnergy(o.alpha, o.scale), o.precision);
  Effort effort;
  effort.monitor = &monitor;
  effort.phase = JAM_PHASE_RELAX;
  effort.max_evaluations = o.max_evaluations;
  effort.packing_fraction = packing_fraction(start);
  effort.pressure = std::nan("");
  Relaxation r(state, effort);
  const bool frees = o.strain != JAM_STRAIN_NONE;
  SoftResult out;
  DescentEnd end = frees ? minimise(r, o.minimiser, std::max(o.force_tolerance, RelaxTuning::before_strain), false)
                         : minimise_and_measure(r, o.minimiser, o.force_tolerance, false, out);
  if (frees) end = relax_cell(r, o, end, out);
  out.status = status_of(end, monitor, out.report.stop_reason);
  out.report.converged = end == DescentEnd::balanced || end == DescentEnd::no_overlaps;
  if (end == DescentEnd::balanced && out.report.mean_overlap < overlap_resolution(out.packing)) {
    out.status = JAM_PRECISION;
    out.report.stop_reason = JAM_STOP_PRECISION;
  }
  out.report.evaluations = effort.evaluations;
  out.report.factorisations = effort.factorisations;
  out.report.seconds = monitor.seconds();
  return out;
}

}  // namespace jam::inside
