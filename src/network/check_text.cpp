// The report of a check as one paragraph that can be quoted. See check.hpp.
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "core/math.hpp"
#include "network/check.hpp"

namespace jam::inside {
namespace {

using Report = jam_check_report;

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void add(std::string &text, const char *format, ...) {
  char line[512];
  va_list args;
  va_start(args, format);
  std::vsnprintf(line, sizeof line, format, args);
  va_end(args);
  if (!text.empty()) text += " ";
  text += line;
}

long long wide(int64_t x) { return static_cast<long long>(x); }
const char *plural(int64_t x) { return x == 1 ? "" : "s"; }

const char *headline(const Report &r) {
  if (r.jammed == JAM_VERDICT_NO) return "Not jammed.";
  if (r.jammed != JAM_VERDICT_YES) return "Undecided.";
  if (r.strictly_jammed == JAM_VERDICT_YES) return "Strictly jammed.";
  if (r.strictly_jammed == JAM_VERDICT_NO) return "Collectively jammed, but not strictly.";
  if (r.strictly_jammed == JAM_VERDICT_UNTESTED) return "Collectively jammed.";
  return "Collectively jammed; undecided whether strictly.";
}

void add_network(const Report &r, std::string &out) {
  if (r.contacts == 0) return;
  add(out, "%lld contact%s hold%s %lld sphere%s", wide(r.contacts), plural(r.contacts), r.contacts == 1 ? "s" : "",
      wide(r.n - r.rattlers), plural(r.n - r.rattlers));
  if (r.n == 1) {  // forces of own images cancel on the sphere: no number of contacts is isostatic
    out += ".";
  } else {
    add(out, "(excess %lld over one state of self-stress), %lld rattler%s.", wide(r.excess_contacts), wide(r.rattlers),
        plural(r.rattlers));
  }
  if (r.self_stresses > 1) add(out, "Forces are not unique: %lld states of self-stress.", wide(r.self_stresses));
}

void add_proof(const Report &r, std::string &out) {
  add(out, "Proof: positive forces on all these contacts balance to %.1e of their mean, and", r.force_residual);
  if (r.flexes == 0)
    add(out, "no motion keeps the contacts closed (flexes 0, smallest eigenvalue %.1e).", r.rigidity_margin);
  else
    add(out,
        "the curvature of the round wall stabilises the %lld motion%s that would keep the contacts closed (by %.1e of "
        "the mean force times curvature).",
        wide(r.flexes), plural(r.flexes), r.curvature_margin);
  if (r.strictly_jammed == JAM_VERDICT_NO && r.strict_flexes == 0)
    add(out, "In a cell that changes its shape no forces balance with an isotropic stress.");
  else if (r.strictly_jammed == JAM_VERDICT_NO)
    add(out, "With a cell that changes its shape there %s %lld flex%s.", r.strict_flexes == 1 ? "is" : "are",
        wide(r.strict_flexes), r.strict_flexes == 1 ? "" : "es");
  add(out, "Contacts are closed to %.1e.", r.max_contact_gap);
  if (std::isfinite(r.min_gap))
    add(out, "The smallest gap of no contact is %.2e, 10^%.1f times wider.", r.min_gap,
        math::log(r.min_gap / std::fmax(r.max_contact_gap, 1e-15)) / math::log(10.0));
  if (r.undecided_contacts > 0)
    add(out, "%lld more pairs may touch, which does not change the verdict.", wide(r.undecided_contacts));
}

void add_no(const Report &r, std::string &out) {
  if (r.reason == JAM_CHECK_APART) {
    add(out, "No pair touches");
    if (std::isfinite(r.nearest_gap)) out.append(": the smallest gap is"), add(out, "%.2e", r.nearest_gap);
  } else if (r.reason == JAM_CHECK_NO_FORCE) {
    const bool one = r.closed_pairs == 1;
    add(out, "%lld pair%s touch%s, but no non-negative force%s on %s balance%s, so a motion%s opens %s",
        wide(r.closed_pairs), plural(r.closed_pairs), one ? "es" : "", one ? "" : "s", one ? "it" : "them",
        one ? "s" : "", r.n == 1 ? " of the sphere or a strain of the cell" : "", one ? "it" : "them all");
  } else if (r.reason == JAM_CHECK_SLIDE) {
    add(out,
        "Forces balance to %.1e of their mean, so the diameters cannot grow, but parts of the network slide past each "
        "other in %lld way%s that keep%s all distances",
        r.force_residual, wide(r.flexes), plural(r.flexes), r.flexes == 1 ? "s" : "");
  } else {
    add(out,
        "Forces balance to %.1e of their mean, and yet %lld independent motion%s%s keep%s all contacts closed: a "
        "saddle",
        r.force_residual, wide(r.flexes), plural(r.flexes), r.n == 1 ? " of the cell" : "", r.flexes == 1 ? "s" : "");
  }
  out += ".";
  add(out, "Sure: gaps are known to %.1e, and with all pairs closed that this leaves open it is not jammed either.",
      r.resolution);
}

void add_resolution(const Report &r, std::string &out) {
  if (r.digits > 0)
    add(out,
        "The coordinates, diameters or cell seem to have %d digit%s (multiples of %.2g), which leaves gaps wrong by up "
        "to %.1e.",
        r.digits, plural(r.digits), r.coordinate_step, r.resolution);
  if (r.diameter_factor < 1.0)
    add(out, "Spheres overlap by up to %.1e; all diameters were tested times %.12g, where no pair overlaps.",
        -r.nearest_gap, r.diameter_factor);
}

void add_undecided(const Report &r, std::string &out) {
  if (std::isfinite(r.nearest_gap)) add(out, "The nearest pair has a gap of %.2e.", r.nearest_gap);
  if (r.reason == JAM_CHECK_MARGIN && r.contacts == 0)
    add(out,
        "Rounding leaves open which of the closed pairs (%lld) carry force: forces are too weak, or a sphere is as "
        "wide as its tube or ball and touches it in every direction.",
        wide(r.closed_pairs));
  else if (r.reason == JAM_CHECK_MARGIN && r.flexes > 0)
    add(out,
        "%lld motion%s keep the contacts closed; whether other pairs or the curvature of a round wall stop them is "
        "left open.",
        wide(r.flexes), plural(r.flexes));
  else if (r.reason == JAM_CHECK_MARGIN)
    add(out,
        "Doubles do not resolve a flex from a soft mode here, or a weak force from none (smallest eigenvalue %.1e, "
        "force "
        "residual %.1e).",
        r.rigidity_margin, r.force_residual);
  else if (r.reason == JAM_CHECK_OVERLAP)
    add(out, "Gaps are known no better than that, and the verdict on the reduced diameters is none on the packing.");
  else if (r.undecided_contacts > 0)
    add(out, "%lld pair%s may touch or not, and the verdict depends on %s.", wide(r.undecided_contacts),
        plural(r.undecided_contacts), r.undecided_contacts == 1 ? "it" : "them");
  if (r.crunch_jammed == JAM_VERDICT_UNTESTED) {
    if (r.n > 1) add(out, "A crunch closes the contacts and decides.");
    return;
  }
  const bool jammed = r.crunch_jammed == JAM_VERDICT_YES;
  if (!std::isfinite(r.crunch_displacement_max)) {  // no sphere has contacts
    add(out, "A crunch of a copy ends at packing fraction %.9f without a contact between two spheres.",
        r.crunch_packing_fraction);
    return;
  }
  add(out,
      "A crunch of a copy moves the spheres with contacts by up to %.1e diameters (rms %.1e) to packing fraction %.9f "
      "and finds %lld contacts, %s.",
      r.crunch_displacement_max, r.crunch_displacement_rms, r.crunch_packing_fraction, wide(r.crunch_contacts),
      jammed ? "jammed" : "not shown to be jammed");
}

}  // namespace

std::string text_of(const Report &r) {
  if (r.jammed == JAM_VERDICT_UNTESTED) return "Not tested: the call was stopped before it had a verdict.";
  std::string out = headline(r);
  add(out, "%lld sphere%s in d = %d at packing fraction %.9f.", wide(r.n), plural(r.n), r.dim, r.packing_fraction);
  add_network(r, out);
  add_resolution(r, out);
  if (r.jammed == JAM_VERDICT_YES)
    add_proof(r, out);
  else if (r.jammed == JAM_VERDICT_NO)
    add_no(r, out);
  else
    add_undecided(r, out);
  return out;
}

}  // namespace jam::inside
