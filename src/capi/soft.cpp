// Header sections "radii as unknowns", "soft spheres".
#include "capi/analysis.hpp"
#include "core/cell_change.hpp"
#include "core/create.hpp"
#include "crunch/crunch.hpp"
#include "radii/maximise.hpp"
#include "soft/shear.hpp"

using namespace jam::inside;

namespace {

void need_soft(const jam_system *sys) {
  if (!sys->packing.overlap_allowed)
    fail(JAM_E_STATE,
         "the system does not allow overlaps: make it, or another one of its arrays, with overlap = JAM_OVERLAP_ALLOW");
}

Results soft_results(SoftResult &soft, double seconds) {
  Results found;
  found.report = soft_certificate(soft, seconds);
  found.contacts = std::move(soft.contacts);
  found.has_report = true;
  return found;
}

Answer why_no_minimum(jam_status status, int32_t stop_reason) {
  if (status == JAM_NOT_JAMMED)
    return {status, "no overlaps are left, so no contacts carry force: take larger diameters or a higher density"};
  return stopped(status, stop_reason);
}

SoftComparison compare_with_crunch(const SoftResult &soft, Monitor &monitor, CrunchResult &hard) {
  const double begun = monitor.seconds();
  jam_crunch_options options = default_crunch_options();
  options.wall_time = monitor.wall_time;
  hard = crunch(just_below_contact(soft), options, monitor);
  if (hard.status < 0)
    fail(hard.status, "crunch from below: %s", hard.text.empty() ? "out of memory" : hard.text.c_str());
  SoftComparison v;
  if (hard.status != JAM_CANCELLED && hard.status != JAM_LIMIT)
    v = compare_with_jammed(soft.contacts, hard.contacts, hard.report);
  v.seconds = monitor.seconds() - begun;
  return v;
}

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

jam_status jam_relax_options_init(jam_relax_options *o, size_t size) {
  return init_options(o, size, default_relax_options());
}

jam_status jam_relax(jam_system *sys, const jam_relax_options *o, jam_relax_report *report) {
  return guard_reporting(sys, report, [&]() -> Answer {
    jam_relax_options full = default_relax_options();
    take_options(o, full);
    need_soft(sys);
    if (full.strain != JAM_STRAIN_NONE)
      refuse_closed(sys->packing, full.strain & JAM_STRAIN_VOLUME ? 1 : 2,
                    full.strain & JAM_STRAIN_VOLUME ? "a free cell" : "a cell that changes at fixed volume");
    SoftResult result = relax(sys->packing, full, sys->monitor);
    const jam_relax_report made = result.report;
    const jam_status status = result.status;
    refuse_outside(result.packing, pushed_out);
    refuse_wider_than_periods(result.packing, JAM_E_OVERLAP);
    straighten_cell(result.packing, sys->notes);
    sys->commit(result.packing, soft_results(result, made.seconds));
    give_struct(made, report);
    return why_no_minimum(status, made.stop_reason);
  });
}

jam_status jam_decompress_options_init(jam_decompress_options *o, size_t size) {
  return init_options(o, size, default_decompress_options());
}

jam_status jam_decompress(jam_system *sys, const jam_decompress_options *o, jam_decompress_report *report) {
  return guard_reporting(sys, report, [&]() -> Answer {
    jam_decompress_options full = default_decompress_options();
    take_options(o, full);
    need_soft(sys);
    CrunchResult hard;
    std::function<SoftComparison(const SoftResult &)> compare;
    if (full.crunch == 1)
      compare = [&](const SoftResult &soft) { return compare_with_crunch(soft, sys->monitor, hard); };
    DecompressionResult result = decompress(sys->packing, full, sys->monitor, compare);
    const jam_decompress_report made = result.report;
    const jam_status status = result.status;
    refuse_outside(result.soft.packing, pushed_out);
    Results found;
    if (made.same_network == 1) {
      found.contacts = std::move(hard.contacts);
      found.report = hard.report;
      found.report.status = hard.status;
      found.has_report = true;
    } else {
      found = soft_results(result.soft, made.seconds);
    }
    found.soft_history = std::move(result.history);
    sys->commit(made.same_network == 1 ? hard.packing : result.soft.packing, std::move(found));
    give_struct(made, report);
    const bool closed = result.soft.report.mean_overlap < overlap_resolution(result.soft.packing);
    if (status == JAM_PRECISION && closed && full.isostatic == 1 && made.excess_contacts > 0)
      return {status, "overlaps reached the rounding of positions; the packing has " +
                          std::to_string(made.excess_contacts) +
                          " contacts more than one state of self-stress needs, as crystals do, so that it never "
                          "becomes isostatic: set isostatic = 0 and a pressure or a distance to end at"};
    return why_no_minimum(status, made.stop_reason);
  });
}

jam_status jam_decompress_history(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                  size_t *needed) {
  return guard_read(sys, [&]() -> jam_status {
    if (sys->soft_history.empty()) fail(JAM_E_STATE, "there is no history: jam_decompress has found no minimum");
    return give_table(sys->soft_history, columns, table, table_len, needed);
  });
}

jam_status jam_radii_options_init(jam_radii_options *o, size_t size) {
  return init_options(o, size, default_radii_options());
}

jam_status jam_maximise_radii(jam_system *sys, const jam_radii_options *o, const double *weights, size_t weights_len,
                              jam_radii_report *report) {
  return guard_reporting(sys, report, [&]() -> Answer {
    jam_radii_options full = default_radii_options();
    take_options(o, full);
    sys->packing.container.know("jam_maximise_radii");
    check_array_in(weights, weights_len, "weights");
    check_radii(sys->packing, full, weights, weights_len);
    RadiiResult result = maximise_radii(sys->packing, full, weights_len ? weights : nullptr, sys->monitor);
    check_packing(result.packing, JAM_E_SOLVER);  // else all stays as before
    Results found;
    if (result.report.maximum) {
      found.report = network_certificate(result.packing, result.contacts,
                                         test_packing(result.packing, &result.contacts, Jamming::collective),
                                         sys->monitor, full.strain != JAM_STRAIN_NONE);
      if (full.strain == JAM_STRAIN_FREE)
        found.report.strictly_jammed =
            verdict_code(test_packing(result.packing, &result.contacts, Jamming::strict).jammed);
      found.report.status = found.report.jammed ? JAM_OK : JAM_NOT_JAMMED;
      found.contacts = std::move(result.contacts);
      found.has_report = true;
    }
    sys->commit(result.packing, std::move(found));
    if (sys->notes.text().find(result.notes.text()) == std::string::npos) sys->notes.append(result.notes);
    give_struct(result.report, report);
    if (result.status > 0 && !result.text.empty()) return {result.status, result.text};
    return stopped(result.status, result.report.stop_reason);
  });
}

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
    if (sys->shear_history.empty()) fail(JAM_E_STATE, "there is no history of a shear: jam_shear has found no minimum");
    return give_table(sys->shear_history, columns, table, table_len, needed);
  });
}

}  // extern "C"
