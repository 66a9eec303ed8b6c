// Header section "proof".
#include <cstdio>

#include "capi/analysis.hpp"
#include "io/files.hpp"
#include "proof/newton.hpp"
#include "proof/theorem.hpp"

using namespace jam;

namespace {

constexpr char dependent[] = "the rows of the contacts are dependent, so positions are not refined";

ProofScene take_scene(const jam_system *sys, const double *ratio, size_t ratio_len) {
  need_network(sys);
  const Packing &p = sys->packing;
  if (p.model != JAM_MODEL_EUCLID) fail(JAM_E_UNSUPPORTED, "proofs are for spheres without Mari-Kurchan shifts");
  check_array_in(ratio, ratio_len, "ratio");
  if (ratio_len != 0 && ratio_len != p.n())
    fail(JAM_E_ARGUMENT, "ratio_len is %zu, it must be 0 or n = %zu", ratio_len, p.n());
  for (size_t i = 0; i < ratio_len; ++i) {
    const double now = p.diameter[i] * ratio[0] / (p.diameter[0] * ratio[i]);
    if (!(ratio[i] > 0.0) || !(std::fabs(now - 1.0) < 1e-9))
      fail(JAM_E_ARGUMENT, "ratio[%zu] is %g: to that of sphere 0 it is not as the diameters are", i, ratio[i]);
  }
  return make_proof_scene(p, sys->contacts, std::vector<double>(ratio, ratio + ratio_len));
}

// Lengths in the unit of the packing, forces over their mean.
jam_proof_report report_of(const ProofScene &s, const Proof &proof) {
  jam_proof_report r{};
  r.theorem = proof.exact ? JAM_THEOREM_EXACT : proof.trapped ? JAM_THEOREM_TRAPPED : JAM_THEOREM_NONE;
  r.cause = static_cast<int32_t>(proof.cause);
  r.cause_value = proof.cause_value, r.cause_bound = proof.cause_bound;
  r.stable = static_cast<int64_t>(s.nodes()), r.contacts = static_cast<int64_t>(s.contacts());
  r.radius = proof.exact ? proof.radius * s.unit : std::nan("");
  const double gamma_up = proof.gamma_radius / s.gamma;
  r.fraction_error = proof.exact ? 0.5 * s.dim * gamma_up * (1.0 + 1e-9) : std::nan("");
  r.least_force = proof.least_force, r.force_error = proof.exact ? proof.force_radius : std::nan("");
  r.least_gap = proof.least_gap;
  r.inner = proof.trapped ? proof.inner * s.unit : std::nan("");
  r.outer = proof.trapped ? proof.outer * s.unit : std::nan("");
  r.singular = proof.bound.singular, r.eigenvalue = proof.bound.eigenvalue, r.rounding = proof.bound.rounding;
  DoubleDouble volume;
  for (const double ratio : s.ratio) {
    DoubleDouble power(1.0);
    for (int c = 0; c < s.dim; ++c) power = power * DoubleDouble(ratio);
    volume = volume + power;
  }
  r.gamma = s.gamma, r.gamma_low = s.gamma_low;
  r.packing_fraction = unit_sphere_volume(s.dim) * volume.high / s.cell.volume();
  for (int c = 0; c < s.dim; ++c) r.packing_fraction *= std::sqrt(s.gamma);
  return r;
}

const char *cause_text(ProofCause cause) {
  switch (cause) {
    case ProofCause::none:
      return "";
    case ProofCause::excess:
      return "excess: contacts are not those of one state of self-stress (contacts, needed)";
    case ProofCause::force:
      return "force: the least force is not above its error (over the mean force)";
    case ProofCause::gap:
      return "gap: a pair that is no contact is not open (least gap, radius)";
    case ProofCause::singular:
      return "singular: the rows are dependent, or too nearly so";
    case ProofCause::rattler:
      return "rattler: a rattler is not clear of its neighbours (least gap, radius)";
    case ProofCause::images:
      return "images: a sphere touches its own image";
  }
  return "";
}

}  // namespace

extern "C" {

jam_status jam_prove(const jam_system *sys, const double *ratio, size_t ratio_len, jam_proof_report *report) {
  return guard_const(sys, [&]() -> Answer {
    check_out_struct(report, "report");
    ProofScene scene = take_scene(sys, ratio, ratio_len);
    ProofEquations equations;
    Proof proof;
    if (refine(scene, equations))
      proof = prove(scene, equations);
    else
      proof.cause = ProofCause::singular;
    give_struct(report_of(scene, proof), report);
    if (proof.exact || proof.trapped) return JAM_OK;
    char text[300];
    std::snprintf(text, sizeof text, "not proved: %s: %.3g, %.3g", cause_text(proof.cause), proof.cause_value,
                  proof.cause_bound);
    return {JAM_AMBIGUOUS, text};
  });
}

jam_status jam_write_proof(const jam_system *sys, const char *path, const double *ratio, size_t ratio_len) {
  return guard_const(sys, [&]() -> Answer {
    need(path, "path");
    ProofScene scene = take_scene(sys, ratio, ratio_len);
    ProofEquations equations;
    const bool refined = refine(scene, equations);
    write_proof(scene, path);
    return refined ? Answer(JAM_OK) : Answer(JAM_AMBIGUOUS, dependent);
  });
}

jam_status jam_refined_positions(const jam_system *sys, const double *ratio, size_t ratio_len, double *high,
                                 size_t high_len, double *low, size_t low_len, size_t *needed) {
  return guard_const(sys, [&]() -> Answer {
    const size_t size = sys->packing.position.size();
    if (!needed && !high && !low) fail(JAM_E_NULL, "needed is NULL and there is no output array");
    check_output(high, high_len, size, "high");
    check_output(low, low_len, size, "low");
    if (needed) *needed = size;
    if (!high && !low) return JAM_OK;
    ProofScene scene = take_scene(sys, ratio, ratio_len);
    ProofEquations equations;
    if (!refine(scene, equations)) {
      return {JAM_AMBIGUOUS, dependent};
    }
    for (double &x : scene.high) x *= scene.unit;
    for (double &x : scene.low) x *= scene.unit;
    put_output(scene.high, high, size);
    put_output(scene.low, low, size);
    return JAM_OK;
  });
}

}  // extern "C"
