// Header section "analysis": density of states, moduli, comparing packings.
#include <algorithm>
#include "analysis/modes.hpp"
#include "analysis/structure.hpp"
#include "capi/analysis.hpp"

using namespace jam::inside;

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
    need_network(sys);
    if (empty_network(sys)) return JAM_NOT_JAMMED;
    const size_t points = full.points > 0 ? static_cast<size_t>(full.points) : 0;
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
    if (needed) *needed = count;
    if (!needed && !affine && !relaxed) fail(JAM_E_NULL, "needed is NULL and there is no output array");
    check_output(affine, affine_len, count, "affine");
    check_output(relaxed, relaxed_len, count, "relaxed");
    if (empty_network(sys)) return JAM_NOT_JAMMED;
    if (!affine && !relaxed) return JAM_OK;
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
    if (!comparison && !out && !needed) fail(JAM_E_NULL, "comparison, out and needed are all NULL");
    check_out_struct(comparison, "comparison");
    check_output(out, out_len, sys->packing.position.size(), "out");
    if (sys->packing.container.kind() != other->packing.container.kind() ||
        sys->packing.container.flat() != other->packing.container.flat())
      fail(JAM_E_ARGUMENT, "the two systems have different walls");
    const Comparison c = compare_packings(sys->packing, sys->known_contacts(), other->packing, other->known_contacts());
    if (needed) *needed = c.displacement.size();
    put_output(c.displacement, out, c.displacement.size());
    give_struct(c.numbers, comparison);
    if (c.doubts.empty()) return JAM_OK;
    return {JAM_AMBIGUOUS, c.doubts};
  });
}

}  // extern "C"
