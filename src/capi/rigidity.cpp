// Header section "jammed or not".
#include <cstdio>

#include "analysis/modes.hpp"
#include "capi/analysis.hpp"
#include "capi/proof.hpp"
#include "core/limits.hpp"
#include "crunch/crunch.hpp"

using namespace jam::inside;

namespace {

Jamming take_kind(int32_t kind) {
  check_enum(kind, JAM_RIGIDITY_COLLECTIVE, JAM_RIGIDITY_STRICT, "kind", "jam_rigidity_kind");
  return kind == JAM_RIGIDITY_STRICT ? Jamming::strict : Jamming::collective;
}

// The status of a verdict, why, and what to do. What is not strictly jammed may be so in its fixed cell.
Answer answer_of(JammingTest &test, const TestedPacking &tested, Jamming kind) {
  const PackingVerdict &v = test.verdict(kind);
  if (v.jammed == Verdict::yes) return JAM_OK;
  const VerdictNumbers numbers = numbers_of(v, tested, kind);
  const bool strict = kind == Jamming::strict;
  const std::string why = (strict ? "strictly jammed: " : "collectively jammed: ") + why_not_jammed(numbers);
  if (v.jammed == Verdict::no) {
    const bool held = strict && test.verdict(Jamming::collective).jammed == Verdict::yes;
    std::string next = "; jam_flex gives a motion";
    if (numbers.n == 1 && v.result.contacts == 0)
      next = "; one sphere can be crunched only in a free cell without walls";
    else if (strict && !tested.packing.container && (held || v.result.contacts == 0))
      next += ", jam_crunch with a free cell (strain=free) makes a strictly jammed packing";
    else if (v.result.contacts == 0 && !held)
      next += ", jam_crunch makes a jammed packing";
    return {JAM_NOT_JAMMED, (held ? "collectively jammed, but not " : "not ") + why + next};
  }
  const bool open = numbers.reason == JAM_CHECK_GAPS || numbers.reason == JAM_CHECK_DIGITS;
  return {JAM_AMBIGUOUS, "undecided whether the packing is " + why + (open ? "; jam_crunch closes contacts" : "")};
}

jam_check_options default_check_options() {
  jam_check_options o{};
  o.struct_size = sizeof o;
  o.crunch = 1;
  o.wall_time = std::numeric_limits<double>::infinity();
  return o;
}

// What a crunch does to an undecided packing. Where it fails, or does not end in time, the report says that no crunch
// ran.
void crunch_copy(const Packing &tested, double wall_time, Monitor &monitor, jam_check_report &r) {
  jam_crunch_options o = default_crunch_options();
  o.wall_time = monitor.seconds() + wall_time;
  try {
    const CrunchResult c = crunch(tested, o, monitor);
    if (monitor.cancelled()) throw Cancelled();
    if (c.status < 0 || c.report.stop_reason == JAM_STOP_WALL_TIME) return;
    r.crunch_jammed = c.report.jammed ? JAM_VERDICT_YES : JAM_VERDICT_UNDECIDED;
    r.crunch_contacts = c.report.contacts;
    r.crunch_packing_fraction = c.report.packing_fraction;
    r.crunch_displacement_max = c.report.displacement_max_stable;
    r.crunch_displacement_rms = c.report.displacement_rms_stable;
  } catch (const Cancelled &) {  // by the limit of the crunch, which is over
    if (monitor.cancelled()) throw;
  } catch (const Error &e) {
    monitor.log(JAM_LOG_WARNING, "check: no crunch of the copy: %s", e.what());
  }
}

// Mari-Kurchan shifts are no cell vectors: there nothing is proved.
void prove_tested(const CheckResult &result, jam_check_report &r) {
  if (r.jammed == JAM_VERDICT_YES && result.tested.packing.model == JAM_MODEL_EUCLID)
    take_proof(result.tested.packing, result.carrying, r);
}

std::string paragraph(const jam_check_report &r) {
  const bool tried = r.theorem != JAM_THEOREM_NONE || r.proof_cause != JAM_CAUSE_NONE;
  if (!tried) return text_of(r);
  return text_of(r) +
         (r.strictly_jammed == JAM_VERDICT_YES ? " Despite rounding, in the fixed cell: " : " Despite rounding: ") +
         proof_text(r.theorem, r.proof_cause, r.proof_radius, r.proof_value, r.proof_bound) + ".";
}

}  // namespace

extern "C" {

jam_status jam_rigidity(jam_system *sys, int32_t kind, jam_rigidity_report *report) {
  jam_rigidity_report untested{};
  untested.kind = kind;
  untested.jammed = untested.stationary = JAM_VERDICT_UNTESTED;
  untested.rigidity_margin = untested.force_residual = std::numeric_limits<double>::quiet_NaN();
  return guard_cancellable(sys, untested, report, [&]() -> Answer {
    const Jamming jamming = take_kind(kind);
    const TestedPacking tested = without_overlaps(sys->packing);
    JammingTest test(tested, sys->known_contacts());
    const PackingVerdict &v = test.verdict(jamming);
    if (sys->has_report && jamming == Jamming::strict) sys->report.strictly_jammed = verdict_code(v.jammed);
    jam_rigidity_report r{};
    r.kind = kind;
    r.jammed = verdict_code(v.jammed);
    r.stationary = verdict_code(v.result.stressed);
    report_counts(v, r);
    r.stable = v.result.spheres;
    r.contacts = v.result.contacts;
    r.contacts_needed = v.result.contacts > 0 ? v.result.contacts_needed : -1;  // of no spheres it is unknown
    r.self_stresses = v.result.self_stresses;
    r.undercoordinated = v.result.undercoordinated;
    r.curvature_margin = v.result.curvature;
    r.force_residual = v.result.force_residual;
    give_struct(r, report);
    return answer_of(test, tested, jamming);
  });
}

jam_status jam_flex(jam_system *sys, int32_t kind, double *out, size_t out_len, double *strain, size_t strain_len,
                    size_t *needed) {
  return guard_cancellable(sys, [&]() -> jam_status {
    const Jamming jamming = take_kind(kind);
    const size_t d = static_cast<size_t>(sys->packing.dim), size = sys->packing.position.size();
    if (!outputs_wanted(size, needed, {{out, out_len, size, "out"}, {strain, strain_len, d * d, "strain"}}))
      return JAM_OK;
    const TestedPacking tested = without_overlaps(sys->packing);
    const PackingVerdict v = verdict_of(tested, sys->known_contacts(), jamming);
    if (v.contacts.size() > 0 && v.result.flex.empty())
      fail(JAM_E_STATE, v.jammed == Verdict::yes ? "the packing is jammed: it has no flex"
                                                 : "no flex was found; the verdict is undecided");
    const double fraction = v.contacts.size() > 0 ? unblocked_fraction(tested.packing, v) : 1.0;
    if (fraction == 0.0)
      fail(JAM_E_STATE,
           "no flex is known that keeps all contacts closed, though the test finds motions that nearly do");
    const double unit = fraction * sys->diameter_mean;
    std::vector<double> motion(size, 0.0), eps(d * d, 0.0);
    if (v.contacts.size() == 0) {  // no pair is near: any motion will do
      const uint32_t closed = sys->packing.container.closed();
      const bool alone = sys->packing.n() == 1, strains = alone && closed == 0;
      size_t axis = 0;  // one sphere moves against walls, or its cell does
      while (alone && axis + 1 < d && !(closed >> axis & 1)) ++axis;
      if (strains && jamming == Jamming::collective)
        fail(JAM_E_STATE, "one sphere in a fixed cell has no motion but a translation");
      (strains ? eps[0] : motion[axis]) = strains ? -unit : unit;
    }
    for (size_t k = 0; k < v.sphere.size(); ++k)
      for (size_t c = 0; c < d; ++c) motion[static_cast<size_t>(v.sphere[k]) * d + c] = unit * v.result.flex[k * d + c];
    for (size_t k = 0; k < v.result.strain.size(); ++k) eps[k] = unit * v.result.strain[k];
    put_output(motion, out, size);
    put_output(eps, strain, d * d);
    return JAM_OK;
  });
}

jam_status jam_bloch_rigidity(jam_system *sys, const int32_t *count, size_t count_len, double *wave, size_t wave_len,
                              int32_t columns, double *table, size_t table_len, size_t *rows) {
  return guard_cancellable(sys, [&]() -> Answer {
    const Packing &p = sys->packing;
    need(count, "count");
    if (count_len != static_cast<size_t>(p.dim))
      fail(JAM_E_ARGUMENT, "count has %zu numbers, it must have dim = %d", count_len, p.dim);
    if (p.container.curved() != 0)
      fail(JAM_E_UNSUPPORTED, "the curvature of a round wall may stabilise flexes: tile the packing, then test it");
    if (p.model == JAM_MODEL_MK)
      fail(JAM_E_UNSUPPORTED, "Mari-Kurchan spheres have no copies: shifts are drawn for each pair");
    const Copies copies(p, count);
    const auto m = static_cast<size_t>(copies.number());
    const Table<JAM_BLOCH_COLUMNS> made(columns, table, table_len);
    if (!outputs_wanted(m, rows, {{wave, wave_len, m * count_len, "wave"}, made.output(m)})) return JAM_OK;
    const TestedPacking tested = without_overlaps(p);
    const PackingVerdict v = verdict_of(tested, sys->known_contacts(), Jamming::collective);
    const BlochFlexes found = bloch_flexes(tested.packing, v, copies);
    put_output(found.wave, wave, m * count_len);
    made.give(m, [&](size_t k, auto &row) {
      row[JAM_BLOCH_FLEXES] = static_cast<double>(found.flexes[k]);
      row[JAM_BLOCH_MARGIN] = found.margin[k];
    });
    if (found.jammed == Verdict::yes) return JAM_OK;
    if (found.jammed == Verdict::undecided)
      return {JAM_AMBIGUOUS,
              std::string("undecided whether the copies are collectively jammed: ") +
                  (tested.overlapping ? "spheres that overlap" : "doubles or the digits of the coordinates") +
                  " do not resolve it; jam_crunch closes contacts"};
    return {
        JAM_NOT_JAMMED,
        found.total > 0
            ? sentence("the copies are not collectively jammed: %lld motion%s at these wave vectors keep%s "
                       "all contacts with force closed",
                       static_cast<long long>(found.total), found.total == 1 ? "" : "s", found.total == 1 ? "s" : "")
            : "the copies are not jammed: no set of non-negative contact forces is in balance"};
  });
}

jam_status jam_check_options_init(jam_check_options *o, size_t size) {
  return init_options(o, size, default_check_options());
}

jam_status jam_check_packing(jam_system *sys, const jam_check_options *o, jam_check_report *report) {
  return guard_cancellable(sys, blank_report(), report, [&]() -> Answer {
    jam_check_options full = default_check_options();
    take_options(o, full);
    check_flag(full.crunch, "crunch");
    check_flag(full.prove, "prove");
    if (full.prove) sys->packing.container.know("a proof");
    if (!(full.wall_time > 0.0)) fail(JAM_E_ARGUMENT, "wall_time is %g, it must be > 0", full.wall_time);
    CheckResult result = check_as_it_is(sys->packing, sys->known_contacts());
    jam_check_report &r = result.report;
    r.struct_size = sizeof r;
    without_proof(r);
    if (full.prove) prove_tested(result, r);
    if (full.crunch && r.jammed == JAM_VERDICT_UNDECIDED)
      crunch_copy(result.tested.packing, full.wall_time, sys->monitor, r);
    give_struct(r, report);
    if (r.jammed == JAM_VERDICT_YES) return JAM_OK;
    return {r.jammed == JAM_VERDICT_NO ? JAM_NOT_JAMMED : JAM_AMBIGUOUS, paragraph(r)};
  });
}

const char *jam_check_text(const jam_check_report *report) {
  static thread_local char text[sentence_max];
  text[0] = '\0';
  guard([&]() -> jam_status {
    if (!report) return JAM_OK;
    check_out_struct(report, "report");
    jam_check_report full = blank_report();  // what an older program does not know
    std::memcpy(&full, report, std::min<size_t>(report->struct_size, sizeof full));
    std::snprintf(text, sizeof text, "%s", paragraph(full).c_str());
    return JAM_OK;
  });
  return text;
}

}  // extern "C"
