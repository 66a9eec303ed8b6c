// The end of a chain: which contacts, their last digits, the report.
#include <algorithm>
#include <new>

#include "crunch/sequential_lp.hpp"

namespace jam {

// Where LPs gain nothing that counts but still move spheres, the answer may be at the end all the same: the contacts
// close at once, and forces that balance and push then bound the gain by nothing, which is what an LP that moves
// nothing would say. True: the crunch is at its end.
bool SequentialLp::closes() {
  constexpr int patience = 2;
  if (!o_.polish || idle_ < patience || out_.report.gain > o_.gain_tolerance || held_ > 0 || moved_ > settled ||
      network_.active.empty())
    return false;
  out_.contacts = make_contacts(out_.packing, pairs_, answer_, network_);
  const PolishEnd end = polished();
  closed_ = end == PolishEnd::done;
  if (closed_) stop(JAM_STOP_CONVERGED, JAM_OK);
  if (end == PolishEnd::interrupted) cut_off();
  return out_.report.stop_reason != JAM_STOP_NONE;
}

// Contacts of the last LP and their last digits. Where polish refuses, an LP that lists fewer pairs that nearly touch
// decides once more which of them carry force; after that its answer stays.
bool SequentialLp::wants_another_lp() {
  if (closed_ || answer_.y.empty() || network_.stable.empty()) return false;
  out_.contacts = make_contacts(out_.packing, pairs_, answer_, network_);
  if (out_.report.stop_reason != JAM_STOP_CONVERGED || !o_.polish || last_digits() || retried_) return false;
  if (out_.report.lp_solves >= o_.max_lps || out_.report.stop_reason != JAM_STOP_CONVERGED) return false;
  retried_ = true;
  bound_ = std::max(0.03 * lp_.bound, 1e-9), last_gain_ = 0.0;
  moved_ = 1.0;    // a cold start: the warm one leads to a corner of the multipliers where they are not unique
  pairs_.clear();  // polish left another graph in system_
  stop(JAM_STOP_NONE, JAM_OK);
  return true;
}

// False when polish refused.
bool SequentialLp::last_digits() {
  if (show(JAM_PHASE_POLISH, out_.report.gain, out_.report.max_step, false))
    return stop(JAM_STOP_CANCELLED, JAM_CANCELLED), true;
  PolishEnd end = polished();
  ContactNetwork fewer = out_.contacts;
  while (end != PolishEnd::done && end != PolishEnd::interrupted && drop_idle_contact(fewer, lp_.dim)) {
    end = polish(out_.packing, fewer, system_, o_.threads, &monitor_);
    if (end == PolishEnd::done) out_.contacts = std::move(fewer), polish_step();
  }
  const char *why = end == PolishEnd::open_contact     ? "a contact does not close"
                    : end == PolishEnd::too_few        ? "contacts are too few to balance"
                    : end == PolishEnd::negative_force ? "a force turns negative"
                    : end == PolishEnd::overlap        ? "another pair would overlap"
                                                       : nullptr;
  if (why)
    monitor_.log(JAM_LOG_WARNING, "polish refused: %s; %s", why, retried_ ? "the LP's answer stays" : "one more LP");
  if (end == PolishEnd::interrupted) cut_off();
  return !why;
}

// The contacts at hand, and what that changed in the history.
PolishEnd SequentialLp::polished() {
  if (seams_.before_polish) seams_.before_polish(out_.packing, out_.contacts);
  const PolishEnd end = polish(out_.packing, out_.contacts, system_, o_.threads, &monitor_);
  if (end == PolishEnd::done) polish_step();
  return end;
}

void SequentialLp::polish_step() {
  HistoryRow &row = history_.moved(out_.packing, JAM_STEP_POLISH, monitor_.seconds(), system_.factorisations);
  for (const auto column : {JAM_HISTORY_CONTACTS, JAM_HISTORY_EXCESS, JAM_HISTORY_RATTLERS})
    row[column] = history_.rows().end()[-2][column];
  const double idle = row[JAM_HISTORY_CONTACTS] - static_cast<double>(out_.contacts.size());
  row[JAM_HISTORY_CONTACTS] -= idle, row[JAM_HISTORY_EXCESS] -= idle;
  if (history_.details()) show(JAM_PHASE_POLISH, row[JAM_HISTORY_GAIN], row[JAM_HISTORY_STEP_MAX]);
}

void SequentialLp::finish() {
  jam_crunch_report &r = out_.report;
  r.method = paths_ ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP;
  certify(out_.packing, out_.contacts, r);
  r.jammed = r.stop_reason == JAM_STOP_CONVERGED && r.excess_contacts >= 0 &&
             r.force_residual < (o_.polish ? 1e-6 : 1e-5) && r.min_force > 0.0;
  if (r.stop_reason == JAM_STOP_CONVERGED && !r.jammed) stop(JAM_STOP_UNJAMMED, JAM_NOT_JAMMED);
  r.factorisations = system_.factorisations;
  r.seconds = monitor_.seconds();
  r.seconds_factor = system_.seconds_factor;
  r.seconds_assemble = system_.seconds_assemble;
  r.seconds_solve = system_.seconds_solve;
}

// Out of memory, or no LP solved: the state is the last good one, without contacts. Allocates nothing that it cannot do
// without.
void SequentialLp::finish_failed() {
  for (double &x : out_.packing.position) x = wrap(x, out_.packing.box);
  ContactNetwork &c = out_.contacts;
  c.pairs.clear(), c.vector.clear(), c.gap.clear(), c.force.clear();
  std::fill(c.coordination.begin(), c.coordination.end(), 0);
  try {
    certify(out_.packing, c, out_.report);
  } catch (const std::bad_alloc &) {
    out_.report.packing_fraction = packing_fraction(out_.packing);
  }
  out_.report.method = paths_ ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP;
  out_.report.factorisations = system_.factorisations;
  out_.report.seconds = monitor_.seconds();
}

}  // namespace jam
