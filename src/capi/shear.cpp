// Header section "soft spheres": jam_shear, of soft spheres and of hard ones.
#include "soft/shear.hpp"

#include <utility>

#include "capi/table.hpp"
#include "core/create.hpp"
#include "crunch/crunch.hpp"

using namespace jam::inside;

namespace {

void refuse_soft_options(const jam_shear_options &o, const ShearPath &path) {
  jam_shear_options plain = default_shear_options();
  plain.step = o.step, plain.resolution = o.resolution, plain.max_steps = o.max_steps, plain.until = o.until;
  plain.wall_time = o.wall_time;
  const bool same = plain.minimiser == o.minimiser && plain.scale == o.scale && plain.precision == o.precision &&
                    plain.alpha == o.alpha && plain.force_tolerance == o.force_tolerance &&
                    plain.max_evaluations == o.max_evaluations && plain.strain == o.strain &&
                    plain.pressure == o.pressure && plain.components == o.components;
  if (!same || !path.stress.empty())
    fail(JAM_E_ARGUMENT,
         "these spheres are hard, and an option is set that soft ones have: leave minimiser, scale, precision, alpha, "
         "force_tolerance, max_evaluations, strain, pressure, components and stress at their defaults, or make the "
         "system with "
         "overlap = JAM_OVERLAP_ALLOW");
}

// Of a jammed packing in units of its pressure: V over the volume of the spheres.
ShearPoint hard_point(const Packing &p, const ContactNetwork &net, const jam_crunch_report &report) {
  ShearPoint out;
  out.at.packing = p;
  out.at.contacts = net;
  out.at.report.packing_fraction = report.packing_fraction;
  out.at.report.rattlers = report.rattlers;
  out.crunch = report;
  out.found = out.rigid = true;
  out.enthalpy = out.volume = 1.0 / report.packing_fraction;
  out.confining = 1.0;
  out.stress = stress_tensor(p, net);
  return out;
}

// Jamming points: diameters shrink until no spheres overlap, then a crunch jams them. A start that is jammed stays.
FindMinimum jamming_point(const jam_system &sys, Effort &effort, Monitor &monitor) {
  return [&](const Packing &strained, bool first) {
    if (first && sys.known_contacts() && sys.report.jammed == 1) return hard_point(strained, sys.contacts, sys.report);
    Packing p = strained;
    shrink_to_contact(p, 0.0, nullptr);
    jam_crunch_options options = default_crunch_options();
    options.wall_time = monitor.wall_time;
    CrunchResult hard = crunch(p, options, monitor);
    effort.factorisations += hard.report.factorisations;
    hard.report.status = hard.status;
    if (hard.status == JAM_OK && hard.report.jammed == 1) return hard_point(hard.packing, hard.contacts, hard.report);
    ShearPoint out;
    out.at.packing = hard.packing;
    out.at.contacts.coordination.assign(p.n(), 0);
    // Not even a failure of the solver takes back the strains before it.
    out.at.status = hard.status == JAM_OK ? JAM_NOT_JAMMED : hard.status < 0 ? JAM_NOT_CONVERGED : hard.status;
    out.stop_reason = hard.report.stop_reason;
    out.why = !hard.text.empty() ? hard.text : hard.status == JAM_OK ? "a strained packing did not jam" : "";
    return out;
  };
}

}  // namespace

extern "C" {

jam_status jam_shear_options_init(jam_shear_options *o, size_t size) {
  return init_options(o, size, default_shear_options());
}

jam_status jam_shear(jam_system *sys, const jam_shear_options *o, const double *turns, size_t turns_len,
                     const double *mode, size_t mode_len, jam_shear_report *report) {
  return guard_reporting(sys, report, [&]() -> Answer {
    jam_shear_options full = default_shear_options();
    take_options(o, full);
    refuse_walls(sys->packing, "sheared");
    if (sys->packing.model == JAM_MODEL_MK)
      fail(JAM_E_UNSUPPORTED, "Mari-Kurchan systems cannot be sheared: their shifts are fractions of the cell vectors");
    const bool soft = sys->packing.overlap_allowed;
    const ShearPath path = shear_path(sys->packing.dim, mode, mode_len, turns, turns_len);
    check_shear_options(full, path);
    if (!soft) refuse_soft_options(full, path);
    Effort effort;
    const FindMinimum minimum =
        soft ? soft_minimum(full, path, effort, sys->monitor) : jamming_point(*sys, effort, sys->monitor);
    ShearResult result = shear(sys->packing, full, path, minimum, effort, sys->monitor);
    const jam_shear_report made = result.report;
    refuse_outside(result.last.at.packing, pushed_out);
    Results found;
    found.report = soft ? soft_certificate(result.last.at, made.seconds) : result.last.crunch;
    found.contacts = std::move(result.last.at.contacts);
    found.has_report = result.last.found;
    found.shear_history = std::move(result.rows);
    sys->commit(result.last.at.packing, std::move(found));
    give_struct(made, report);
    if (result.status > 0 && !result.why.empty()) return {result.status, result.why};
    return stopped(result.status, made.stop_reason);
  });
}

jam_status jam_shear_history(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t *needed) {
  return guard_read(sys, [&]() -> jam_status {
    if (sys->shear_history.empty()) fail(JAM_E_STATE, "there is no history of a shear: call jam_shear first");
    return give_table(sys->shear_history, columns, table, table_len, needed);
  });
}

}  // extern "C"
