#include "verdict/text.hpp"

#include <cctype>
#include <cmath>

#include "core/error.hpp"
#include "core/math.hpp"
#include "core/pairs.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

using Report = jam_check_report;
using Numbers = VerdictNumbers;

long long wide(int64_t x) { return static_cast<long long>(x); }
// Flexes are counted up to a limit, above which states of self-stress are not known; slides without one.
const char *least(int64_t flexes, int64_t self_stresses = -1) {
  return flexes < static_cast<int64_t>(RigidityTuning::most_flexes) || self_stresses >= 0 ? "" : "at least ";
}
const char *plural(int64_t x) { return x == 1 ? "" : "s"; }

bool depends_on_open_pairs(Rule rule) {
  return rule == Rule::doubtful_pairs || rule == Rule::nearly_closed || rule == Rule::open_contacts;
}

int32_t reason_of(const PackingVerdict &v, int64_t closed_pairs, const TestedPacking &tested) {
  if (v.jammed == Verdict::yes) return JAM_CHECK_PROOF;
  if (v.jammed == Verdict::undecided) {
    // Without a step of the digits only overlaps make gaps uncertain.
    if (tested.overlapping) return JAM_CHECK_OVERLAP;
    if (tested.resolution.coarse(tested.packing))
      return tested.resolution.step > 0.0 ? JAM_CHECK_DIGITS : JAM_CHECK_OVERLAP;
    return depends_on_open_pairs(v.rule) ? JAM_CHECK_GAPS : JAM_CHECK_MARGIN;
  }
  if (closed_pairs == 0) return JAM_CHECK_APART;
  if (v.result.stressed != Verdict::yes) return JAM_CHECK_NO_FORCE;
  return v.result.slides > 0 ? JAM_CHECK_SLIDE : JAM_CHECK_FLEX;
}

// "on 12 contacts, with an isotropic stress"
std::string balance_of(const Numbers &v) {
  return sentence("forces balance on %lld contact%s%s to %.1e of their mean", wide(v.contacts), plural(v.contacts),
                  v.kind == Jamming::strict ? ", with an isotropic stress," : "", v.force_residual);
}

std::string no_force(const Numbers &v) {
  const bool one = v.closed_pairs == 1;
  const char *whose = v.n == 1                    ? " of the sphere or a strain of the cell"
                      : v.kind == Jamming::strict ? " of spheres and cell"
                                                  : "";
  return sentence("%lld pair%s touch%s, but no non-negative force%s on %s balance%s%s, so a motion%s opens %s",
                  wide(v.closed_pairs), plural(v.closed_pairs), one ? "es" : "", one ? "" : "s", one ? "it" : "them",
                  one ? "s" : "", v.kind == Jamming::strict ? " with an isotropic stress" : "", whose,
                  one ? "it" : "them all");
}

std::string slide(const Numbers &v) {
  return balance_of(v) + sentence(
                             ", so the diameters cannot grow, but parts of the network slide past each other in "
                             "%s%lld way%s that keep%s all distances",
                             least(v.flexes, v.self_stresses), wide(v.flexes), plural(v.flexes),
                             v.flexes == 1 ? "s" : "");
}

std::string flex(const Numbers &v) {
  const char *whose = v.n == 1 ? " of the cell" : v.kind == Jamming::strict ? " of spheres and cell" : "";
  return balance_of(v) + sentence(", and yet %s%lld independent motion%s%s keep%s all contacts closed: a saddle",
                                  least(v.flexes, v.self_stresses), wide(v.flexes), plural(v.flexes), whose,
                                  v.flexes == 1 ? "s" : "");
}

std::string gaps(const Numbers &v) {
  if (v.undecided_contacts == 0)
    return "contacts with force are open, and what they hold depends on whether they close";
  return sentence("%lld pair%s may touch or not, and the verdict depends on %s", wide(v.undecided_contacts),
                  plural(v.undecided_contacts), v.undecided_contacts == 1 ? "it" : "them");
}

std::string margin(const Numbers &v) {
  if (v.unresolved > 0.0)
    return sentence(
               "a saddle, where contacts with forces of %.1e do not close together with all others, and without "
               "them spheres can move",
               v.unresolved) +
           v.unresolved_because;
  if (v.contacts == 0)
    return sentence(
        "rounding leaves open which of the closed pairs (%lld) carry force: forces are too weak, or a "
        "sphere is as wide as its tube or ball and touches it in every direction",
        wide(v.closed_pairs));
  if (v.spheres == 1 && v.kind == Jamming::collective)
    return "only its own images hold the sphere, and their forces do not balance on the cell";
  if (v.flexes > 0)
    return sentence(
        "%s%lld motion%s keep%s the contacts closed; whether other pairs or the curvature of a round wall "
        "stop them is left open",
        least(v.flexes, v.self_stresses), wide(v.flexes), plural(v.flexes), v.flexes == 1 ? "s" : "");
  return sentence(
      "doubles do not resolve a flex from a soft mode here, or a weak force from none (smallest eigenvalue "
      "%.1e, force residual %.1e)",
      v.rigidity_margin, v.force_residual);
}

void add(std::string &text, const std::string &more) { text += (text.empty() ? "" : " ") + more; }

void add_sentence(std::string &text, std::string more) {
  more[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(more[0])));
  add(text, more + ".");
}

const char *headline(const Report &r) {
  if (r.jammed == JAM_VERDICT_NO) return "Not jammed.";
  if (r.jammed != JAM_VERDICT_YES) return "Undecided.";
  if (r.strictly_jammed == JAM_VERDICT_YES) return "Strictly jammed.";
  if (r.strictly_jammed == JAM_VERDICT_NO) return "Collectively jammed, but not strictly.";
  if (r.strictly_jammed == JAM_VERDICT_UNTESTED) return "Collectively jammed.";
  return "Collectively jammed; undecided whether strictly.";
}

// "excess 5 = d (d + 1) / 2 - 1: isostatic for a cell that deforms"
std::string excess_of(const Report &r) {
  const std::string excess = sentence("excess %lld", wide(r.excess_contacts));
  if (r.strictly_jammed != JAM_VERDICT_YES || r.strict_excess_contacts == r.excess_contacts)
    return excess + " over one state of self-stress";
  if (r.strict_excess_contacts != 0)
    return excess +
           sentence(", %lld over one state of self-stress of a cell that deforms", wide(r.strict_excess_contacts));
  return excess + (r.excess_contacts == r.dim * (r.dim + 1) / 2 - 1 ? " = d (d + 1) / 2 - 1" : "") +
         ": isostatic for a cell that deforms";
}

void add_network(const Report &r, std::string &out) {
  if (r.contacts == 0) return;
  std::string held = sentence("%lld contact%s hold%s %lld sphere%s", wide(r.contacts), plural(r.contacts),
                              r.contacts == 1 ? "s" : "", wide(r.n - r.rattlers), plural(r.n - r.rattlers));
  // Forces of own images cancel on a single sphere: no number of contacts is isostatic.
  if (r.n > 1) held += " (" + excess_of(r) + sentence("), %lld rattler%s", wide(r.rattlers), plural(r.rattlers));
  add_sentence(out, held);
  if (r.self_stresses <= 1) return;
  const bool unique = r.strictly_jammed == JAM_VERDICT_YES && r.strict_excess_contacts == 0;
  add(out, sentence("Forces are not unique%s: %lld states of self-stress%s.", unique ? " in a fixed cell" : "",
                    wide(r.self_stresses), unique ? ", one of them with an isotropic stress" : ""));
}

void add_proof(const Report &r, std::string &out) {
  add(out,
      sentence("Proof: positive forces on all these contacts balance to %.1e of their mean, and", r.force_residual));
  if (r.flexes == 0)
    add(out, sentence("no motion keeps the contacts closed (flexes 0, smallest eigenvalue %.1e).", r.rigidity_margin));
  else
    add(out,
        sentence("the curvature of the round wall stabilises the %lld motion%s that would keep the contacts closed "
                 "(by %.1e of the mean force times curvature).",
                 wide(r.flexes), plural(r.flexes), r.curvature_margin));
  if (r.strictly_jammed == JAM_VERDICT_NO && r.strict_flexes == 0)
    add(out, "In a cell that changes its shape no forces balance with an isotropic stress.");
  else if (r.strictly_jammed == JAM_VERDICT_NO)
    add(out, sentence("With a cell that changes its shape there %s %s%lld flex%s.", r.strict_flexes == 1 ? "is" : "are",
                      least(r.strict_flexes), wide(r.strict_flexes), r.strict_flexes == 1 ? "" : "es"));
  if (r.strictly_jammed == JAM_VERDICT_NO)
    add(out, "Where two axes have no walls, a crunch with a free cell (strain=free) makes a strictly jammed packing.");
  add(out, sentence("Contacts are closed to %.1e.", r.max_contact_gap));
  if (std::isfinite(r.min_gap))
    add(out, sentence("The smallest gap of no contact is %.2e, 10^%.1f times wider.", r.min_gap,
                      math::log(r.min_gap / std::fmax(r.max_contact_gap, 1e-15)) / math::log(10.0)));
  if (r.undecided_contacts > 0)
    add(out, sentence("%lld more pairs may touch, which does not change the verdict.", wide(r.undecided_contacts)));
}

void add_resolution(const Report &r, std::string &out) {
  if (r.digits > 0)
    add(out,
        sentence("The coordinates, diameters or cell seem to have %d digit%s (multiples of %.2g), which leaves gaps "
                 "wrong by up to %.1e.",
                 r.digits, plural(r.digits), r.coordinate_step, r.resolution));
  if (r.diameter_factor < 1.0)
    add(out, sentence("Spheres overlap by up to %.1e; all diameters were tested times %.12g, where no pair overlaps.",
                      -r.nearest_gap, r.diameter_factor));
}

void add_crunch(const Report &r, std::string &out) {
  const char *strictly = r.strictly_jammed == JAM_VERDICT_UNTESTED
                             ? ""
                             : "Whether it is strictly jammed, a crunch with a free cell decides (strain=free).";
  if (r.crunch_jammed == JAM_VERDICT_UNTESTED) {
    if (r.n > 1) out += " A crunch closes the contacts and decides." + std::string(strictly[0] ? " " : "") + strictly;
    return;
  }
  if (!std::isfinite(r.crunch_displacement_max))  // no sphere has contacts
    return add(out, sentence("A crunch of a copy ends at packing fraction %.9f without a contact between two spheres.",
                             r.crunch_packing_fraction));
  add(out, sentence("A crunch of a copy moves the spheres with contacts by up to %.1e diameters (rms %.1e) to packing "
                    "fraction %.9f and finds %lld contacts, %s.",
                    r.crunch_displacement_max, r.crunch_displacement_rms, r.crunch_packing_fraction,
                    wide(r.crunch_contacts), r.crunch_jammed == JAM_VERDICT_YES ? "jammed" : "not shown to be jammed"));
  if (strictly[0]) add(out, strictly);
}

Numbers numbers_of(const Report &r) {
  Numbers v;
  v.jammed = r.jammed, v.reason = r.reason, v.n = r.n;
  v.spheres = r.n - r.rattlers, v.contacts = r.contacts, v.closed_pairs = r.closed_pairs, v.flexes = r.flexes;
  v.undecided_contacts = r.undecided_contacts, v.self_stresses = r.self_stresses;
  v.force_residual = r.force_residual, v.rigidity_margin = r.rigidity_margin;
  return v;
}

}  // namespace

int32_t verdict_code(Verdict verdict) {
  return verdict == Verdict::yes ? JAM_VERDICT_YES : verdict == Verdict::no ? JAM_VERDICT_NO : JAM_VERDICT_UNDECIDED;
}

VerdictNumbers numbers_of(const PackingVerdict &v, const TestedPacking &tested, Jamming kind) {
  const Packing &p = tested.packing;
  Numbers out;
  out.kind = kind, out.jammed = verdict_code(v.jammed), out.n = static_cast<int64_t>(p.n());
  out.closed_pairs = static_cast<int64_t>(find_pairs(p, 0.0, 1.0 + contact_gap_limit).size());
  out.reason = reason_of(v, out.closed_pairs, tested);
  out.spheres = v.result.spheres, out.contacts = v.result.contacts, out.flexes = v.result.flexes;
  out.undecided_contacts = v.undecided_contacts, out.self_stresses = v.result.self_stresses;
  out.force_residual = v.result.force_residual, out.rigidity_margin = v.result.margin;
  out.unresolved = v.unresolved, out.unresolved_because = v.unresolved_because;
  return out;
}

std::string why_not_jammed(const VerdictNumbers &v) {
  switch (v.reason) {
    case JAM_CHECK_PROOF:
      return "";
    case JAM_CHECK_APART:
      return "no pair touches";
    case JAM_CHECK_NO_FORCE:
      return no_force(v);
    case JAM_CHECK_SLIDE:
      return slide(v);
    case JAM_CHECK_FLEX:
      return flex(v);
    case JAM_CHECK_OVERLAP:
      return "spheres overlap, so gaps are known no better than that, and the verdict on the reduced diameters is none "
             "on the packing";
    case JAM_CHECK_DIGITS:
    case JAM_CHECK_GAPS:
      return gaps(v);
    default:
      return margin(v);
  }
}

std::string why_not_jammed(const PackingVerdict &v, const Packing &p, Jamming kind) {
  const char *start = v.jammed == Verdict::undecided ? "undecided: " : "";
  return v.jammed == Verdict::yes ? "" : start + why_not_jammed(numbers_of(v, without_overlaps(p), kind));
}

void report_verdict(const PackingVerdict &v, jam_crunch_report &r) {
  report_counts(v, r);
  r.jammed = v.jammed == Verdict::yes;
  r.stationary = v.result.stressed == Verdict::yes;
  r.undercoordinated = v.result.undercoordinated;
}

std::string text_of(const Report &r) {
  if (r.jammed == JAM_VERDICT_UNTESTED) return "Not tested: the call was stopped before it had a verdict.";
  std::string out = headline(r);
  add(out,
      sentence("%lld sphere%s in d = %d at packing fraction %.9f.", wide(r.n), plural(r.n), r.dim, r.packing_fraction));
  add_network(r, out);
  add_resolution(r, out);
  if (r.jammed == JAM_VERDICT_YES) {
    add_proof(r, out);
    return out;
  }
  if (r.jammed == JAM_VERDICT_UNDECIDED && std::isfinite(r.nearest_gap))
    add(out, sentence("The nearest pair has a gap of %.2e.", r.nearest_gap));
  std::string why = why_not_jammed(numbers_of(r));
  if (r.reason == JAM_CHECK_APART && std::isfinite(r.nearest_gap))
    why += sentence(": the smallest gap is %.2e", r.nearest_gap);
  add_sentence(out, why);
  if (r.jammed == JAM_VERDICT_NO)
    add(out, sentence("Sure: gaps are known to %.1e, and with all pairs closed that this leaves open it is not jammed "
                      "either.",
                      r.resolution));
  else
    add_crunch(r, out);
  return out;
}

}  // namespace jam::inside
