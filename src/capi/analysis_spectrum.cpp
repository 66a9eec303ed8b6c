// Header section "analysis": the network from geometry, states of self-stress, density of states, moduli, comparing.
#include <algorithm>

#include "analysis/modes.hpp"
#include "analysis/structure.hpp"
#include "capi/analysis.hpp"
#include "network/contacts_from_geometry.hpp"

using namespace jam::inside;

namespace {

// Why the network of a geometry is not the only one, or not rigid.
Answer answer_of(const GeometryResult &found, jam_status status, const PackingVerdict &as_it_is,
                 const TestedPacking &tested, const jam_geometry_options &o) {
  const jam_geometry_report &r = found.report;
  const auto n = [](int64_t x) { return static_cast<long long>(x); };
  if (status == JAM_NOT_JAMMED && r.contacts == 0)
    return {JAM_NOT_JAMMED, sentence("no set of contacts with gaps up to %.2g carries balanced forces without friction "
                                     "and weight: jam_contacts_by_distance takes pairs by their distance alone; "
                                     "jam_crunch moves spheres until contacts balance",
                                     o.tolerance > 0.0 ? o.tolerance : o.window)};
  if (status == JAM_NOT_JAMMED)
    return {JAM_NOT_JAMMED,
            sentence("not collectively jammed even if these %lld contacts are closed: excess %lld, %lld zero "
                     "modes including translations; jam_flex gives a motion",
                     n(r.contacts), n(r.excess_contacts), n(r.zero_modes))};
  if (status != JAM_AMBIGUOUS) return status;
  std::string why;
  const auto add = [&why](const std::string &reason) { why += (why.empty() ? "" : "; ") + reason; };
  const bool clear = o.tolerance > 0.0 || (r.jump > 100.0 && r.jump > r.second_jump * r.second_jump);
  if (!clear && r.second_contacts >= 0)
    add(sentence("%lld contacts with gaps up to %.2g were taken, but %lld up to %.2g fit too: set tolerance to choose",
                 n(r.contacts), r.tolerance, n(r.second_contacts), r.second_tolerance));
  else if (!clear)
    add(sentence("%lld contacts were taken, but beyond them gaps rise only by a factor of %.3g, from %.2g to %.2g",
                 n(r.contacts), r.jump, r.gap_below, r.gap_above));
  if (r.self_stresses > 1)
    add(
        sentence("%lld states of self-stress, so forces are not unique: their analytic centre was taken, where the "
                 "product of the forces is largest",
                 n(r.self_stresses)));
  if (tested.overlapping && as_it_is.jammed == Verdict::undecided)
    add(why_not_jammed(numbers_of(as_it_is, tested, Jamming::collective)));
  else if (as_it_is.jammed != Verdict::yes)
    add(sentence("contacts have gaps of up to %.1e, and open ones prove nothing: jam_crunch closes the gaps",
                 r.gap_below));
  return {JAM_AMBIGUOUS, why};
}

}  // namespace

extern "C" {

jam_status jam_dos_options_init(jam_dos_options *o, size_t size) {
  return init_options(o, size, default_dos_options());
}

jam_status jam_density_of_states(jam_system *sys, const jam_hessian_options *h, const jam_dos_options *o,
                                 int32_t columns, double *table, size_t table_len, size_t *needed) {
  return guard_cancellable(sys, [&]() -> jam_status {
    const Table<JAM_DOS_COLUMNS> made(columns, table, table_len);
    const jam_hessian_options options = take_hessian_options(h);
    jam_dos_options full = default_dos_options();
    take_options(o, full);
    check_dos_options(full);
    need_network(sys);
    if (empty_network(sys)) return JAM_NOT_JAMMED;
    const auto points = static_cast<size_t>(full.points);
    if (!made.wanted(points, needed)) return JAM_OK;
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    const DensityOfStates dos = density_of_states(g, contact_weights(g, diameter_mean(sys->packing), options), full);
    made.give(points, [&](size_t k, auto &row) {
      row[JAM_DOS_OMEGA] = dos.omega[k];
      row[JAM_DOS_DENSITY] = dos.density[k];
      row[JAM_DOS_ERROR] = dos.density_error[k];
      row[JAM_DOS_EDGE] = dos.omega[k] + 0.5 * dos.step;
      row[JAM_DOS_CUMULATIVE] = dos.cumulative[k];
      row[JAM_DOS_CUMULATIVE_ERROR] = dos.cumulative_error[k];
    });
    return JAM_OK;
  });
}

jam_status jam_moduli(jam_system *sys, const jam_hessian_options *h, jam_moduli_report *report) {
  return guard_cancellable(sys, [&]() -> jam_status {
    const jam_hessian_options options = take_hessian_options(h);
    need(report, "report");
    check_out_struct(report, "report");
    refuse_closed(sys->packing, 2, "elastic moduli");
    need_network(sys);
    refuse_own_images(unlisted_own_images(sys->packing, sys->contacts), "elastic moduli");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    give_struct(jam_moduli_report{sizeof(jam_moduli_report), 0, nan, nan, nan, nan, nan, nan}, report);
    if (empty_network(sys)) return JAM_NOT_JAMMED;
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    give_struct(elastic_moduli(sys->packing, g, contact_weights(g, diameter_mean(sys->packing), options)), report);
    return JAM_OK;
  });
}

jam_status jam_elastic_tensor(jam_system *sys, const jam_hessian_options *h, double *affine, size_t affine_len,
                              double *relaxed, size_t relaxed_len, size_t *needed) {
  return guard_cancellable(sys, [&]() -> jam_status {
    const jam_hessian_options options = take_hessian_options(h);
    refuse_closed(sys->packing, 1, "elastic tensor");
    need_network(sys);
    refuse_own_images(unlisted_own_images(sys->packing, sys->contacts), "an elastic tensor");
    const size_t d = static_cast<size_t>(sys->packing.dim), count = d * d * d * d;
    const bool wanted = outputs_wanted(
        count, needed, {{affine, affine_len, count, "affine"}, {relaxed, relaxed_len, count, "relaxed"}});
    if (empty_network(sys)) return JAM_NOT_JAMMED;
    if (!wanted) return JAM_OK;
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    const ElasticTensor c = elastic_tensor(sys->packing, g, contact_weights(g, diameter_mean(sys->packing), options));
    put_output(c.affine, affine, count);
    put_output(c.relaxed, relaxed, count);
    return JAM_OK;
  });
}

jam_status jam_compare(const jam_system *sys, const jam_system *other, jam_comparison_report *comparison, double *out,
                       size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> Answer {
    const Reading reading(other, "other");
    check_out_struct(comparison, "comparison");
    const size_t size = sys->packing.position.size();
    outputs_wanted(size, needed, {{out, out_len, size, "out"}}, comparison);
    if (sys->packing.container.kind() != other->packing.container.kind() ||
        sys->packing.container.flat() != other->packing.container.flat())
      fail(JAM_E_ARGUMENT, "the two systems have different walls");
    const Comparison c = compare_packings(sys->packing, sys->known_contacts(), other->packing, other->known_contacts());
    put_output(c.displacement, out, c.displacement.size());
    give_struct(c.numbers, comparison);
    if (c.doubts.empty()) return JAM_OK;
    return {JAM_AMBIGUOUS, c.doubts};
  });
}

jam_status jam_geometry_options_init(jam_geometry_options *o, size_t size) {
  return init_options(o, size, default_geometry_options());
}

jam_status jam_contacts_from_geometry(jam_system *sys, const jam_geometry_options *o, jam_geometry_report *report) {
  return guard_cancellable(sys, [&]() -> Answer {
    check_out_struct(report, "report");
    jam_geometry_options full = default_geometry_options();
    take_options(o, full);
    const Packing &p = sys->packing;
    GeometryResult result = contacts_from_geometry(p, full);
    const TestedPacking tested = without_overlaps(p);
    const PackingVerdict verdict = verdict_of(tested, &result.network, Jamming::collective);
    jam_crunch_report r = network_certificate(p, result.network, verdict, sys->monitor);
    r.status = status_of(result, verdict.jammed, gap_resolution(p), p);
    const Answer answer = answer_of(result, r.status, verdict, tested, full);
    sys->contacts = std::move(result.network);
    sys->contact_gap = std::numeric_limits<double>::quiet_NaN();
    sys->report = r;
    sys->has_report = true;
    give_struct(result.report, report);
    return answer;
  });
}

jam_status jam_contacts_by_distance(jam_system *sys, double gap) {
  return guard_verb(sys, [&]() -> Answer {
    sys->take_contacts_by_distance(contacts_by_distance(sys->packing, gap), gap);
    if (empty_network(sys))
      return {JAM_NOT_JAMMED, sentence("no pair of spheres, and no sphere and wall, has a gap below %g", gap)};
    return JAM_OK;
  });
}

jam_status jam_stress_states(jam_system *sys, double *force, size_t force_len, double *basis, size_t basis_len,
                             double *residual, size_t *needed) {
  return guard_cancellable(sys, [&]() -> Answer {
    need_network(sys);
    const RigidityMatrix g = make_rigidity_matrix(sys->packing, sys->contacts);
    const StressStates s = find_stress(g, basis != nullptr);
    outputs_wanted(static_cast<size_t>(s.dimension), needed,
                   {{force, force_len, g.contacts(), "force"}, {basis, basis_len, s.basis.size(), "basis"}}, residual);
    put_output(s.force, force, s.force.size());
    put_output(s.basis, basis, s.basis.size());
    if (residual) *residual = s.residual;
    const auto states = static_cast<long long>(s.dimension);
    if (!s.positive)
      return {JAM_NOT_JAMMED,
              sentence("%lld states of self-stress, and no combination of them has forces of one sign on all contacts",
                       states)};
    if (states > 1)
      return {
          JAM_AMBIGUOUS,
          sentence(
              "%lld states of self-stress: force is their analytic centre, where the product of the forces is largest",
              states)};
    return JAM_OK;
  });
}

}  // extern "C"
