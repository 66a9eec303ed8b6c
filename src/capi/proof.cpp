// Header section "proof".
#include "capi/proof.hpp"

#include <cstdio>

#include "capi/analysis.hpp"
#include "core/limits.hpp"
#include "io/files.hpp"
#include "proof/newton.hpp"

using namespace jam::inside;

namespace {

constexpr char dependent[] = "the rows of the contacts are dependent, so positions are not refined";

ProofScene take_scene(const jam_system *sys, const double *ratio, size_t ratio_len) {
  sys->packing.container.know("a proof");
  need_network(sys);
  const Packing &p = sys->packing;
  if (p.model != JAM_MODEL_EUCLID) fail(JAM_E_UNSUPPORTED, "proofs are for spheres without Mari-Kurchan shifts");
  check_array_in(ratio, ratio_len, "ratio");
  if (ratio_len != 0 && ratio_len != p.n())
    fail(JAM_E_ARGUMENT, "ratio has %zu numbers, it must have 0 or n = %zu", ratio_len, p.n());
  // Only ratios count: by a power of two, which is exact, the unit is that of a number near 1.
  std::vector<double> exact(ratio, ratio + ratio_len);
  for (double &x : exact)
    if (ratio[0] > 0.0) x = std::ldexp(x, -std::ilogb(ratio[0]));
  for (size_t i = 0; i < ratio_len; ++i) {
    const double now = p.diameter[i] * exact[0] / (p.diameter[0] * exact[i]);
    if (!(exact[i] > 0.0) || !(std::fabs(now - 1.0) < 1e-9))
      fail(JAM_E_ARGUMENT, "ratio[%zu] is %g: to that of sphere 0 it is not as the diameters are", i, ratio[i]);
  }
  return make_proof_scene(p, sys->contacts, exact);
}

// Of a jam_rigidity_kind. Where the cell deforms too, the diameters are as they are.
ProofScene take_scene(const jam_system *sys, int32_t kind, const double *ratio, size_t ratio_len) {
  check_enum(kind, JAM_RIGIDITY_COLLECTIVE, JAM_RIGIDITY_STRICT, "kind", "jam_rigidity_kind");
  const bool strict = kind == JAM_RIGIDITY_STRICT;
  if (strict && (ratio || ratio_len != 0))
    fail(JAM_E_ARGUMENT, "ratio must be NULL: a strict proof takes the diameters as they are");
  if (strict) refuse_walls(sys->packing, "proved strictly jammed");
  ProofScene scene = take_scene(sys, ratio, ratio_len);
  if (strict) scene.strict = true, scene.implied.clear();
  return scene;
}

// Lengths in the unit of the packing, forces over their mean.
jam_proof_report report_of(const ProofScene &s, const Proof &proof) {
  jam_proof_report r{};
  r.theorem = proof.exact ? JAM_THEOREM_EXACT : proof.trapped ? JAM_THEOREM_TRAPPED : JAM_THEOREM_NONE;
  r.cause = static_cast<int32_t>(proof.cause);
  r.cause_value = proof.cause_value, r.cause_bound = proof.cause_bound;
  r.stable = static_cast<int64_t>(s.nodes()), r.contacts = static_cast<int64_t>(s.contacts());
  r.radius = proof.exact ? proof.radius * s.unit : std::nan("");
  double fraction_up = 0.5 * s.dim * proof.gamma_radius / s.gamma();
  if (s.strict)  // of the volume, by its edges
    for (int c = 0; c < s.dim; ++c) fraction_up += proof.radius / s.cell.row(c)[c];
  r.fraction_error = proof.exact ? fraction_up * (1.0 + 1e-6) : std::nan("");
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
  r.gamma = s.growth, r.gamma_low = s.growth_low;
  if (s.rooted()) {
    Expansion gamma = s.exact_gamma();
    r.gamma = gamma.value();
    gamma.add(-r.gamma);
    r.gamma_low = gamma.value();
  }
  r.packing_fraction = unit_sphere_volume(s.dim) * volume.high / (s.rooted() ? s.container.volume() : s.cell.volume());
  for (int c = 0; c < s.dim; ++c) r.packing_fraction *= std::sqrt(s.gamma());
  return r;
}

// The scene's centres are refined on the way.
jam_proof_report prove_scene(ProofScene &scene) {
  ProofEquations equations;
  Proof proof;
  find_proof(scene, equations, proof);
  return report_of(scene, proof);
}

Answer give_proof(ProofScene &scene, jam_proof_report *report) {
  const jam_proof_report r = prove_scene(scene);
  give_struct(r, report);
  if (r.theorem != JAM_THEOREM_NONE) return JAM_OK;
  return {JAM_AMBIGUOUS, proof_text(r.theorem, r.cause, r.radius, r.cause_value, r.cause_bound)};
}

Answer write_scene(ProofScene scene, const char *path) {
  if (scene.nodes() == 0) fail(JAM_E_STATE, "no sphere is stable: a proof file lists the contacts of stable spheres");
  ProofEquations equations;
  Proof proof;
  const bool refined = find_proof(scene, equations, proof);
  write_proof(scene, path);
  return refined ? Answer(JAM_OK) : Answer(JAM_AMBIGUOUS, dependent);
}

}  // namespace

jam_proof_report jam::inside::prove_network(const Packing &p, const ContactNetwork &network) {
  ProofScene scene = make_proof_scene(p, network, {});
  return prove_scene(scene);
}

std::string jam::inside::proof_text(int32_t theorem, int32_t cause, double radius, double value, double bound) {
  static const char *const causes[] = {"", "excess", "force", "gap", "singular", "rattler", "images", "saddle"};
  if (theorem < JAM_THEOREM_NONE || theorem > JAM_THEOREM_EXACT || cause < 0 || cause > JAM_CAUSE_SADDLE) return "";
  char start[64] = "not proved", why[96] = "";
  if (theorem == JAM_THEOREM_EXACT) std::snprintf(start, sizeof start, "proved, radius %.2g", radius);
  if (theorem == JAM_THEOREM_TRAPPED) std::snprintf(start, sizeof start, "trapped within %.2g", radius);
  if (cause == JAM_CAUSE_EXCESS)  // two counts
    std::snprintf(why, sizeof why, ", excess %.0f, %.0f", value, bound);
  else if (cause != JAM_CAUSE_NONE)
    std::snprintf(why, sizeof why, ", %s %.2g, %.2g", causes[cause], value, bound);
  return std::string(start) + why;
}

extern "C" {

jam_status jam_prove(const jam_system *sys, int32_t kind, const double *ratio, size_t ratio_len,
                     jam_proof_report *report) {
  return guard_const(sys, [&]() -> Answer {
    check_out_struct(report, "report");
    ProofScene scene = take_scene(sys, kind, ratio, ratio_len);
    return give_proof(scene, report);
  });
}

const char *jam_proof_text(int32_t theorem, int32_t cause, double radius, double value, double bound) {
  static thread_local char text[192];
  text[0] = '\0';
  guard([&]() -> jam_status {
    std::snprintf(text, sizeof text, "%s", proof_text(theorem, cause, radius, value, bound).c_str());
    return JAM_OK;
  });
  return text;
}

jam_status jam_write_proof(const jam_system *sys, const char *path, int32_t kind, const double *ratio,
                           size_t ratio_len) {
  return guard_const(sys, [&]() -> Answer {
    need(path, "path");
    return write_scene(take_scene(sys, kind, ratio, ratio_len), path);
  });
}

jam_status jam_refined_positions(const jam_system *sys, const double *ratio, size_t ratio_len, double *high,
                                 size_t high_len, double *low, size_t low_len, size_t *needed) {
  return guard_const(sys, [&]() -> Answer {
    const size_t size = sys->packing.position.size();
    ProofScene scene = take_scene(sys, ratio, ratio_len);
    if (!outputs_wanted(size, needed, {{high, high_len, size, "high"}, {low, low_len, size, "low"}})) return JAM_OK;
    ProofEquations equations;
    Proof proof;
    if (!find_proof(scene, equations, proof)) {
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
