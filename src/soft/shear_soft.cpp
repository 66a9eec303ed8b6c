// What jam_shear asks for, and the minima of soft spheres on its way.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/call_scope.hpp"
#include "core/limits.hpp"
#include "linalg/dot.hpp"
#include "soft/shear.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {

jam_shear_options default_shear_options() {
  const jam_relax_options r = default_relax_options();
  jam_shear_options o{};
  o.struct_size = sizeof o;
  o.minimiser = r.minimiser, o.scale = r.scale, o.precision = r.precision;
  o.alpha = r.alpha, o.force_tolerance = r.force_tolerance, o.max_evaluations = r.max_evaluations;
  o.wall_time = r.wall_time;
  o.step = 1e-3, o.resolution = 1e-6;
  o.max_steps = 1000000;
  o.until = JAM_UNTIL_STRAIN;
  o.strain = r.strain, o.pressure = r.pressure, o.components = r.components;
  return o;
}

static jam_relax_options relax_options(const jam_shear_options &o) {
  jam_relax_options r = default_relax_options();
  r.minimiser = o.minimiser, r.scale = o.scale, r.precision = o.precision;
  r.alpha = o.alpha, r.force_tolerance = o.force_tolerance, r.max_evaluations = o.max_evaluations;
  r.wall_time = o.wall_time;
  r.strain = o.strain, r.pressure = o.pressure, r.components = o.components;
  return r;
}

void check_shear_options(const jam_shear_options &o, const ShearPath &path) {
  jam_relax_options r = relax_options(o);
  if (!path.stress.empty()) {
    if (o.pressure != 0.0) fail(JAM_E_ARGUMENT, "pressure is %g, it must be 0: a stress is given", o.pressure);
    if (o.strain == JAM_STRAIN_NONE)
      fail(JAM_E_ARGUMENT, "a stress is given, but strain frees nothing that could hold it");
    r.pressure = (o.strain & JAM_STRAIN_VOLUME) != 0 ? 1.0 : 0.0;  // of that stress
  }
  check_relax_options(r);
  const double most = largest_entry(path.mode);
  if (!(o.step * most >= ShearTuning::least_strain) || !std::isfinite(o.step))
    fail(JAM_E_ARGUMENT, "step is %g, it must be finite, and times the largest number of mode, %g, at least %g", o.step,
         most, ShearTuning::least_strain);
  check_range("resolution", o.resolution, ShearTuning::least_strain, std::numeric_limits<double>::infinity());
  check_at_least(o.max_steps, 1, "max_steps");
  check_enum(o.until, JAM_UNTIL_STRAIN, JAM_UNTIL_UNJAMMED, "until", "jam_shear_until");
}

ShearPath shear_path(int dim, const double *mode, size_t mode_len, const double *turns, size_t turns_len) {
  const size_t d = static_cast<size_t>(dim);
  ShearPath path;
  path.mode.assign(d * d, 0.0);
  if (!mode) {
    if (mode_len != 0) fail(JAM_E_NULL, "mode is NULL but its length is %zu", mode_len);
    path.mode[1] = 1.0;
  } else {
    if (mode_len != d * d && mode_len != 2 * d * d)
      fail(JAM_E_ARGUMENT, "mode has %zu numbers, it must have d d = %zu, or with a stress twice as many", mode_len,
           d * d);
    path.mode.assign(mode, mode + d * d);
    path.stress.assign(mode + d * d, mode + mode_len);
  }
  double most = 0.0;
  for (size_t k = 0; k < d * d; ++k) {
    if (!std::isfinite(path.mode[k])) fail(JAM_E_NONFINITE, "mode[%zu] is %g", k, path.mode[k]);
    if (k / d > k % d && path.mode[k] != 0.0)
      fail(JAM_E_ARGUMENT,
           "mode[%zu] is %g, it must be 0: the strain is upper-triangular, and a rotation gives any other that form", k,
           path.mode[k]);
    most = std::max(most, std::fabs(path.mode[k]));
  }
  if (!(most > 0.0 && most <= 10.0))
    fail(JAM_E_ARGUMENT, "the largest number of mode is %g, it must be above 0 and at most 10", most);
  if (!turns) fail(JAM_E_NULL, "turns is NULL");
  if (turns_len == 0) fail(JAM_E_ARGUMENT, "turns has no strain: the last one ends the shear");
  double before = 0.0;
  for (size_t k = 0; k < turns_len; ++k) {
    if (!std::isfinite(turns[k])) fail(JAM_E_NONFINITE, "turns[%zu] is %g", k, turns[k]);
    if (turns[k] == before) fail(JAM_E_ARGUMENT, "turns[%zu] is %g, as the strain before it", k, turns[k]);
    before = turns[k];
  }
  path.turns.assign(turns, turns + turns_len);
  return path;
}

// By its series, which ends: mode is triangular and steps are small.
std::vector<double> finite_strain(const std::vector<double> &mode, double amplitude, int dim) {
  const size_t d = static_cast<size_t>(dim);
  std::vector<double> out(d * d, 0.0), term(d * d, 0.0), next(d * d);
  for (size_t c = 0; c < d; ++c) term[c * (d + 1)] = 1.0;
  for (int k = 1; k < 200; ++k) {
    double most = 0.0;
    for (size_t a = 0; a < d; ++a)
      for (size_t b = 0; b < d; ++b) {
        double sum = 0.0;
        for (size_t c = 0; c < d; ++c) sum += term[a * d + c] * mode[c * d + b];
        next[a * d + b] = sum * amplitude / k;
        most = std::max(most, std::fabs(next[a * d + b]));
      }
    term = next;
    for (size_t c = 0; c < d * d; ++c) out[c] += term[c];
    if (most < ShearTuning::series_ends) break;
  }
  return out;
}

// The held component that is farthest from its target.
static std::string out_of_reach(const FreeCell &cell, const ShearPoint &p) {
  const size_t d = static_cast<size_t>(cell.dim);
  size_t worst = 0;
  double most = -1.0, target = 0.0, is = 0.0;
  for (size_t k = 0; k < d * d; ++k) {
    const bool held = std::any_of(cell.matrices.begin(), cell.matrices.end(), [&](const double &x) {
      return x != 0.0 && static_cast<size_t>(&x - cell.matrices.data()) % (d * d) == k;
    });
    const double t = cell.beyond[k] + (k % (d + 1) == 0 ? cell.pressure : 0.0),
                 s = p.stress.empty() ? 0.0 : p.stress[k];
    if (held && std::fabs(s - t) > most) most = std::fabs(s - t), worst = k, target = t, is = s;
  }
  char line[200];
  std::snprintf(line, sizeof line,
                "stress[%zu] cannot be held at %g: the cell yields, and strained by more than %g in one step while it "
                "held %g",
                worst, target, RelaxTuning::most_strain, is);
  return line;
}

// Whether the start is a minimum as it is, measured then.
static bool is_minimum(Relaxation &r, const jam_shear_options &o, SoftResult &at) {
  if (!r.rounded(o.force_tolerance)) return false;
  at = measure(r.state, o.minimiser);
  if (r.open() || !is_saddle(r, at, o.minimiser == JAM_MINIMISER_NEWTON, false)) return true;
  r.evaluate();
  return false;
}

FindMinimum soft_minimum(const jam_shear_options &o, const ShearPath &path, Effort &effort, Monitor &monitor) {
  const int dim = static_cast<int>(std::lround(std::sqrt(static_cast<double>(path.mode.size()))));
  int64_t free = o.components;
  for (size_t k = 0; k < path.mode.size(); ++k)
    if (path.mode[k] != 0.0) free &= static_cast<int64_t>(~(uint64_t{1} << k));
  FreeCell cell = free_cell_of(dim, o.strain, free, o.pressure);
  if (o.strain != JAM_STRAIN_NONE && cell.count() == 0)
    fail(JAM_E_ARGUMENT, "components is %lld: no strain is free beside the sheared ones",
         static_cast<long long>(o.components));
  if (!path.stress.empty()) hold_stress(cell, o.strain, path.stress.data());
  return [o, cell, &effort, &monitor](const Packing &p, bool first) {
    ShearPoint out;
    DescentEnd end = DescentEnd::interrupted;
    const CancellableScope scope;
    try {
      SoftState state = first_state(p, PairEnergy(o.alpha, o.scale), o.precision);
      effort.allow(o.max_evaluations);
      Relaxation r(state, effort);
      const int64_t begun = effort.evaluations;
      const bool near = !first || r.stable_residual() < RelaxTuning::before_strain;
      bool untouched = true;
      end = DescentEnd::balanced;
      if (cell.count() > 0) {
        const bool far = first && cell.pressure > 0.0;  // a step at a pressure opens contacts that it closes again
        if (!near) end = minimise(r, o.minimiser, std::max(o.force_tolerance, RelaxTuning::before_strain), false);
        if (near && r.open() && (far || !(cell.pressure > 0.0))) end = DescentEnd::no_overlaps;
        if (far) end = approach_pressure(r, cell, o.minimiser, o.force_tolerance, end);
        untouched = effort.evaluations == begun;
        if (can_continue(end)) {
          state.free_cell(cell);
          r.evaluate();
        }
      }
      // A start that is a minimum is not changed by a bit: a call that went on would begin its next step from it.
      if (first && untouched && can_continue(end) && is_minimum(r, o, out.at))
        end = r.open() ? DescentEnd::no_overlaps : end, out.at.packing = p;
      else if (can_continue(end))
        end = minimise_and_measure(r, o.minimiser, o.force_tolerance, near || cell.count() > 0, out.at);
      else
        out.at = measure(state, o.minimiser);
    } catch (const Cancelled &) {  // in a search for pairs, of the last measurement too
      end = DescentEnd::interrupted;
      out.at.packing = p;
      out.at.contacts.coordination.assign(p.n(), 0);
    }
    out.at.status = status_of(end, monitor, out.stop_reason);
    out.found = end == DescentEnd::balanced || end == DescentEnd::no_overlaps;
    out.rigid = end == DescentEnd::balanced && out.at.report.contacts > 0;
    if (!out.rigid) out.at.report.energy = 0.0;  // what is left is below the rounding of positions
    out.volume = out.at.packing.cell.volume();
    out.confining = cell.volume ? cell.pressure : 0.0;
    out.enthalpy = out.at.report.energy + out.confining * out.volume;
    if (out.at.report.contacts > 0) out.stress = stress_tensor(out.at.packing, out.at.contacts);
    if (cell.count() > 0) out.strain = strain_between(p.cell, out.at.packing.cell);
    const bool collapsed = out.at.packing.cell.shortest() < diameter_max(out.at.packing);  // is refused with its cell
    if (end == DescentEnd::yields && !collapsed) {
      out.why = out_of_reach(cell, out);
      if (first) out.at.packing = p, out.at.contacts = {}, out.at.contacts.coordination.assign(p.n(), 0);
    }
    return out;
  };
}

}  // namespace jam::inside
