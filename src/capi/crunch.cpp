// Header section "crunch to the jamming point" and the arrays of the contact network.
#include "crunch/crunch.hpp"
#include "capi/analysis.hpp"
#include "capi/proof.hpp"
#include "core/limits.hpp"

using namespace jam::inside;

namespace {
template <class F>
jam_status with_contacts(const jam_system *sys, F &&f) noexcept {
  return guard_read(sys, [&]() -> jam_status {
    need_contacts(sys);
    return f(sys->contacts);
  });
}

// The proof has what the crunch has left of the time of the call. A crunch is not lost where its proof ends early.
void prove_end(CrunchResult &result, double wall_time, Monitor &monitor) {
  if (!result.report.jammed || result.packing.model != JAM_MODEL_EUCLID) return;
  const TimeLimit limit(monitor, wall_time);
  const CancellableScope scope;
  monitor.log(JAM_LOG_INFO, "proof of %zu contacts", result.contacts.size());
  try {
    take_proof(result.packing, result.contacts, result.report);
  } catch (const Cancelled &) {
    result.report.stop_reason = monitor.why_interrupted();
    const bool cancelled = result.report.stop_reason == JAM_STOP_CANCELLED;
    result.status = cancelled ? JAM_CANCELLED : JAM_LIMIT;
    result.text = std::string(cancelled ? "jam_cancel or a callback stopped" : "wall_time came before the end of") +
                  " the proof; the packing and its verdict are kept: crunch again to prove it";
  } catch (const std::exception &e) {
    monitor.log(JAM_LOG_WARNING, "crunch: no proof: %s", e.what());
  }
  result.report.seconds = monitor.seconds();
}

[[noreturn]] void fail_crunch(const CrunchResult &result) {
  fail(result.status, "%s", result.text.empty() ? "out of memory; the last good state is kept" : result.text.c_str());
}
}  // namespace

extern "C" {

jam_status jam_crunch_options_init(jam_crunch_options *o, size_t size) {
  return init_options(o, size, default_crunch_options());
}

jam_status jam_crunch(jam_system *sys, const jam_crunch_options *o, jam_crunch_report *report) {
  return guard_verb(sys, [&]() -> Answer {
    check_out_struct(report, "report");
    jam_crunch_options full = default_crunch_options();
    take_options(o, full);
    if (full.strain != JAM_STRAIN_NONE)
      refuse_closed(sys->packing, 2, "a crunch that changes the cell at fixed volume");
    if (full.prove) sys->packing.container.know("a proof");
    History history;
    struct Show {  // callbacks see the steps while crunch runs
      const History *&shown;
      ~Show() { shown = nullptr; }
    } show{sys->crunching};
    sys->crunching = &history;
    if (sys->crunch_paused) history.stage = *sys->crunch_paused;
    CrunchResult result = crunch(sys->packing, full, sys->monitor, &history);
    if (result.status < 0 && !history.left_start(result.packing)) fail_crunch(result);
    check_packing(result.packing, JAM_E_SOLVER);  // else all stays as before
    without_proof(result.report);
    if (full.prove) prove_end(result, full.wall_time, sys->monitor);
    Results found;
    found.contacts = std::move(result.contacts);
    found.report = result.report;
    found.report.status = result.status;
    found.history = std::move(history).rows();
    found.kept_steps = std::move(history).kept();
    found.has_report = found.has_history = true;
    // Also after a failure amid the work: the state reached is valid and nothing is lost.
    sys->commit(result.packing, std::move(found));
    if (sys->notes.text().find(result.notes.text()) == std::string::npos) sys->notes.append(result.notes);
    if (result.status < 0 || result.status == JAM_CANCELLED || result.status == JAM_LIMIT ||
        result.report.stop_reason == JAM_STOP_DUALITY_GAP)
      sys->crunch_paused = history.stage;
    give_struct(sys->report, report);
    if (result.status < 0) fail_crunch(result);
    if (result.status > 0 && !result.text.empty()) return {result.status, result.text};
    return stopped(result.status, result.report.stop_reason);
  });
}

jam_status jam_estimate_crunch(const jam_system *sys, const jam_crunch_options *o, jam_estimate_report *report) {
  return guard_const(sys, [&]() -> jam_status {
    need(report, "report");
    check_out_struct(report, "report");
    jam_crunch_options full = default_crunch_options();
    take_options(o, full);
    give_struct(estimate(sys->packing, full), report);
    return JAM_OK;
  });
}

jam_status jam_get_crunch_report(const jam_system *sys, jam_crunch_report *report) {
  return guard_read(sys, [&]() -> jam_status {
    if (!sys->has_report) need_network(sys);
    need(report, "report");
    check_out_struct(report, "report");
    give_struct(sys->report, report);
    return JAM_OK;
  });
}

jam_status jam_crunch_history(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t *needed) {
  return guard_read(sys, [&]() -> jam_status {
    if (!sys->has_history) fail(JAM_E_STATE, "there is no history: call jam_crunch first");
    return give_table(sys->history, columns, table, table_len, needed);
  });
}
jam_status jam_crunch_step(const jam_system *sys, double *displacement, size_t displacement_len, int32_t *pair,
                           size_t pair_len, double *vector, size_t vector_len, double *dual, size_t dual_len,
                           size_t *rows) {
  return guard_read(sys, [&]() -> jam_status {
    if (!sys->crunching || !sys->crunching->step().shown)
      fail(JAM_E_STATE, "no step to return: call this from the progress callback of jam_crunch with steps = 1");
    const CrunchStep &s = sys->crunching->step();
    outputs_wanted(s.multiplier.size(), rows,
                   {{displacement, displacement_len, s.displacement.size(), "displacement"},
                    {pair, pair_len, s.pair.size(), "pair"},
                    {vector, vector_len, s.vector.size(), "vector"},
                    {dual, dual_len, s.multiplier.size(), "dual"}});
    put_output(s.displacement, displacement, s.displacement.size());
    put_output(s.pair, pair, s.pair.size());
    put_output(s.vector, vector, s.vector.size());
    put_output(s.multiplier, dual, s.multiplier.size());
    return JAM_OK;
  });
}

jam_status jam_contacts(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed) {
  return with_contacts(sys, [&](const ContactNetwork &c) {
    std::vector<int32_t> flat;
    flat.reserve(2 * c.size());
    for (size_t k = 0; k < c.size(); ++k) flat.push_back(c.pairs.i[k]), flat.push_back(c.pairs.j[k]);
    return give_array(flat.data(), flat.size(), out, out_len, needed);
  });
}
jam_status jam_contact_vectors(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return with_contacts(
      sys, [&](const ContactNetwork &c) { return give_array(c.vector.data(), c.vector.size(), out, out_len, needed); });
}
jam_status jam_contact_gaps(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return with_contacts(
      sys, [&](const ContactNetwork &c) { return give_array(c.gap.data(), c.gap.size(), out, out_len, needed); });
}
jam_status jam_forces(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return with_contacts(
      sys, [&](const ContactNetwork &c) { return give_array(c.force.data(), c.force.size(), out, out_len, needed); });
}
jam_status jam_coordination(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed) {
  return with_contacts(sys, [&](const ContactNetwork &c) {
    return give_array(c.coordination.data(), c.coordination.size(), out, out_len, needed);
  });
}

}  // extern "C"
