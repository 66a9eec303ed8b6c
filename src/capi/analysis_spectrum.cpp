// Header section "analysis": density of states, moduli, projections, comparing packings.
#include "analysis/spectrum.hpp"
#include "capi/analysis.hpp"

using namespace jam;

extern "C" {

jam_status jam_dos_options_init(jam_dos_options *o, size_t size) { return init_options(o, size, default_dos_options()); }

jam_status jam_density_of_states(jam_system *sys, const jam_hessian_options *h, const jam_dos_options *o, double *omega, size_t omega_len,
                                 double *density, size_t density_len, double *error, size_t error_len, size_t *needed) {
  return guard_verb(sys, [&]() -> jam_status {
    const jam_hessian_options options = take_hessian_options(h);
    if (options.prestress > 0.0) fail(JAM_E_ARGUMENT, "prestress is %g; the density of states needs 0", options.prestress);
    jam_dos_options full = default_dos_options();
    take_options(o, full);
    need_network(sys);
    if (empty_network(sys)) return JAM_NOT_JAMMED;
    const size_t points = full.points > 0 ? static_cast<size_t>(full.points) : 0;
    if (!needed && !omega && !density && !error) fail(JAM_E_NULL, "needed is NULL and there is no output array");
    if (needed) *needed = points;
    check_output(omega, omega_len, points, "omega");
    check_output(density, density_len, points, "density");
    check_output(error, error_len, points, "error");
    if (!omega && !density && !error) return JAM_OK;
    const StableGraph g = make_graph(sys->packing, sys->contacts);
    DensityOfStates dos;
    const BlockMatrix m = make_hessian(g, contact_weights(g, diameter_mean(sys->packing), options));
    const jam_status status = density_of_states(g, m, full, sys->monitor, dos);
    if (status == JAM_CANCELLED) return status;
    put_output(dos.omega, omega, points);
    put_output(dos.density, density, points);
    put_output(dos.error, error, points);
    return status;
  });
}

jam_status jam_curvature(const jam_system *sys, const jam_hessian_options *h, const double *u, size_t u_len, double *value) {
  return guard_const(sys, [&]() -> jam_status {
    const jam_hessian_options options = take_hessian_options(h);
    need(value, "value");
    check_array_in(u, u_len, "u");
    need_network(sys);
    const StableGraph g = make_graph(sys->packing, sys->contacts);
    if (u_len != g.unknowns()) fail(JAM_E_ARGUMENT, "u_len is %zu, it must be d N' = %zu", u_len, g.unknowns());
    *value = curvature(g, contact_weights(g, diameter_mean(sys->packing), options), u);
    return JAM_OK;
  });
}

jam_status jam_moduli_get(jam_system *sys, const jam_hessian_options *h, jam_moduli *moduli) {
  return guard_verb(sys, [&]() -> jam_status {
    const jam_hessian_options options = take_hessian_options(h);
    if (options.prestress > 0.0) fail(JAM_E_ARGUMENT, "prestress is %g; the moduli need 0", options.prestress);
    need(moduli, "moduli");
    check_out_struct(moduli, "moduli");
    need_network(sys);
    if (empty_network(sys)) return JAM_NOT_JAMMED;
    const StableGraph g = make_graph(sys->packing, sys->contacts);
    give_struct(elastic_moduli(sys->packing, g, contact_weights(g, diameter_mean(sys->packing), options)), moduli);
    return JAM_OK;
  });
}

jam_status jam_compare(const jam_system *sys, const jam_system *other, jam_comparison *comparison, double *out, size_t out_len, size_t *needed) {
  return guard_const(sys, [&]() -> jam_status {
    need(other, "other");
    if (!comparison && !out && !needed) fail(JAM_E_NULL, "comparison, out and needed are all NULL");
    check_out_struct(comparison, "comparison");
    check_output(out, out_len, sys->packing.position.size(), "out");
    std::vector<double> displacement;
    const jam_comparison c = compare_packings(sys->packing, sys->has_report ? &sys->contacts : nullptr, other->packing,
                                              other->has_report ? &other->contacts : nullptr, displacement);
    if (needed) *needed = displacement.size();
    put_output(displacement, out, displacement.size());
    give_struct(c, comparison);
    return JAM_OK;
  });
}

}  // extern "C"
