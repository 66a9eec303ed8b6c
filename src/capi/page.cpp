// Header section "files": jam_write_page gathers what the page shows.
#include "io/page.hpp"
#include <cmath>
#include "analysis/structure.hpp"
#include "capi/guard.hpp"
#include "capi/proof.hpp"
#include "core/limits.hpp"

using namespace jam::inside;

namespace {

constexpr double gap_reach = 1.0;  // gaps up to one diameter are shown, as --gaps of jam-pack writes them

void take_columns(const jam_system *sys, const char *names, const double *values, size_t len, PageContent &content) {
  if (!values && len != 0) fail(JAM_E_NULL, "values is NULL but its length is %zu", len);
  const size_t n = sys->packing.n();
  std::vector<std::string> name;
  for (const char *from = names; *from;) {
    const size_t length = std::strcspn(from, "\n");
    name.emplace_back(from, length);
    from += length + (from[length] == '\n');
  }
  const auto is_motion = [](const std::string &text) {
    return text.size() > 2 && text.substr(text.size() - 2) == "[]";
  };
  size_t rows = 0;
  for (const std::string &text : name) rows += is_motion(text) ? static_cast<size_t>(sys->packing.dim) : 1;
  if (rows * n != len)
    fail(JAM_E_ARGUMENT, "values has %zu numbers, %zu names of %zu spheres need %zu", len, name.size(), n, rows * n);
  for (size_t k = 0; k < len; ++k)
    if (!std::isfinite(values[k])) fail(JAM_E_NONFINITE, "values[%zu] is %g", k, values[k]);
  for (const std::string &text : name) {
    if (is_motion(text)) {
      content.motions.emplace_back(text.substr(0, text.size() - 2), values);
      values += static_cast<size_t>(sys->packing.dim) * n;
    } else {
      content.columns.emplace_back(text, values);
      values += n;
    }
  }
}

// What the slider shows of the step that led to a state: the start has no row.
PageStep make_step(int64_t number, const HistoryRow *row) {
  PageStep step;
  step.number = number;
  const char *const kinds[] = {"start", "barrier path", "linear program", "polish"};  // by jam_step_phase
  step.kind = kinds[row ? static_cast<int>((*row)[JAM_HISTORY_PHASE]) : 0];
  if (!row) return step;
  step.numbers = {{"growth of the diameters", (*row)[JAM_HISTORY_GAIN]},
                  {"duality gap", (*row)[JAM_HISTORY_DUALITY_GAP]},
                  {"largest displacement", (*row)[JAM_HISTORY_STEP_MAX]},
                  {"largest displacement since the start", (*row)[JAM_HISTORY_TOTAL_MAX]},
                  {"contacts", (*row)[JAM_HISTORY_CONTACTS]},
                  {"rattlers", (*row)[JAM_HISTORY_RATTLERS]}};
  return step;
}

void take_steps(const jam_system *sys, PageContent &content) {
  const std::vector<HistoryRow> &rows = sys->history;
  for (const HistoryRow &row : rows) content.history.push_back(row[JAM_HISTORY_GAIN]);
  const int64_t last = static_cast<int64_t>(rows.size());
  const auto row = [&](int64_t step) { return step ? &rows[static_cast<size_t>(step - 1)] : nullptr; };
  for (const KeptStep &kept : sys->kept_steps) {
    if (kept.step == last) break;
    PageStep step = make_step(kept.step, row(kept.step));
    step.packing_fraction = kept.fraction;
    step.growth = kept.diameter / sys->packing.diameter.front();
    step.cell = &kept.cell;
    step.position = &kept.position;
    content.steps.push_back(step);
  }
  if (content.steps.empty()) return;
  content.steps.push_back(make_step(last, row(last)));
  content.steps.back().packing_fraction = packing_fraction(sys->packing);
}

// A search that found no contacts leaves a report of an empty network: nothing in it was computed.
void take_network(const jam_system *sys, bool small, PageContent &content) {
  content.network = sys->contacts_of_any_kind();
  content.by_distance = sys->by_distance();
  content.text_of_network = "No contact network: no crunch has been made.";
  if (content.by_distance)
    content.text_of_network = sentence(
        "Contacts by distance: all pairs with gaps below %g of their contact distance. "
        "Whether forces on them balance was not tested.",
        sys->contact_gap);
  if (sys->has_report && !sys->has_history && sys->soft_history.empty() && sys->contacts.size() == 0) {
    content.network = nullptr;
    content.text_of_network = "No contacts found: no set of contacts carries balanced forces.";
  } else if (sys->has_report) {
    const jam_crunch_report &r = sys->report;
    content.report = &r;
    content.crunched = sys->has_history;
    if (sys->contacts.size() > 0) content.stress = stress_tensor(sys->packing, sys->contacts);
    content.stop_reason = jam_stop_string(r.stop_reason);
    if (r.theorem != JAM_THEOREM_NONE || r.proof_cause != JAM_CAUSE_NONE)
      content.proof = proof_text(r.theorem, r.proof_cause, r.proof_radius, r.proof_value, r.proof_bound);
  }
  if (!small && content.network) content.gaps = find_gaps(sys->packing, content.network, gap_reach, true).gap;
}

}  // namespace

extern "C" jam_status jam_write_page(const jam_system *sys, const char *path, const char *title, int32_t small,
                                     const char *names, const double *values, size_t values_len) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    need(title, "title");
    need(names, "names");
    check_flag(small, "small");
    PageContent content{sys->packing};
    content.title = title;
    content.small = small;
    take_columns(sys, names, values, values_len, content);
    take_network(sys, small, content);
    if (sys->has_history) take_steps(sys, content);
    write_page(content, path);
    return JAM_OK;
  });
}
