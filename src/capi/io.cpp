// Header section "files".
#include <cmath>
#include <cstring>

#include "analysis/structure.hpp"
#include "capi/analysis.hpp"
#include "capi/make_system.hpp"
#include "capi/proof.hpp"
#include "core/create.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "io/formats.hpp"
#include "io/page.hpp"

using namespace jam::inside;

namespace {

// An option that the file answers must be the default or say the same: it is not dropped in silence.
template <class T>
void settle(const char *path, const char *name, T &option, T standard, T of_file) {
  if (option != standard && option != of_file)
    fail(JAM_E_ARGUMENT, "%s: the option %s is %.17g, but the file has %.17g: leave the option out", path, name,
         static_cast<double>(option), static_cast<double>(of_file));
  option = of_file;
}

void settle_options(const char *path, const FileContent &file, jam_create_options &o) {
  const jam_create_options standard = default_create_options();
  settle<int32_t>(path, "dim", o.dim, standard.dim, file.dim);
  settle<int64_t>(path, "n", o.n, 0, static_cast<int64_t>(file.position.size() / static_cast<size_t>(file.dim)));
  if (file.box > 0.0) settle(path, "box", o.box, standard.box, file.box);
  if (!file.cell.empty() && o.box != standard.box)
    fail(JAM_E_ARGUMENT, "%s: the option box is %.17g, but the file has a cell of its own: leave the option out", path,
         o.box);
  o.container = file.enclosure.container, o.walls = file.enclosure.walls;
  if (file.has_non_additivity)
    settle(path, "non_additivity", o.non_additivity, standard.non_additivity, file.non_additivity);
  if (std::memcmp(&o.packing_fraction, &standard.packing_fraction, sizeof o.packing_fraction) != 0)
    fail(JAM_E_ARGUMENT,
         "packing_fraction is %g, but a file has its own: leave the option out; jam_scale_diameters changes it",
         o.packing_fraction);
}

// What was assumed may be why the packing is refused: the error repeats it.
[[noreturn]] void refuse(const char *path, const Error &e, const Notes &notes) {
  const size_t at = notes.text().find(Notes::warning);
  if (at == std::string::npos) fail(e.code(), "%s: %s", path, e.what());
  const std::string line = notes.text().substr(at, notes.text().find('\n', at) - at);
  fail(e.code(), "%s: %s; %s", path, e.what(), line.c_str());
}

// What the page of jam_write_page shows.

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

extern "C" {

const char *jam_formats(void) { return formats_text(); }

jam_status jam_read(const char *path, const jam_create_options *o, jam_progress_fn callback, void *user,
                    jam_system **out) {
  return jam_read_as(path, "", o, callback, user, out);
}

jam_status jam_read_as(const char *path, const char *layout, const jam_create_options *o, jam_progress_fn callback,
                       void *user, jam_system **out) {
  return guard([&]() -> Answer {
    need(path, "path");
    need(layout, "layout");
    need(out, "out");
    jam_create_options full = default_create_options();
    take_options(o, full);
    check_create_limits(full);
    const ReadOptions options{full.dim, full.box, full.frame, {full.container, full.walls}, layout_of(layout)};
    return make_system(full, callback, user, out, [&](jam_system &sys) {
      const FileContent file = read_file(path, options);
      const std::string shown = shown_path(path);
      settle_options(shown.c_str(), file, full);
      sys.notes = file.notes;
      try {
        sys.packing = make_packing(full, file.position.data(), file.position.size(), file.diameter.data(),
                                   file.diameter.size(), file.cell.empty() ? nullptr : file.cell.data(), &sys.notes);
        sys.packing.given.take(file.given());
      } catch (const Error &e) {
        refuse(shown.c_str(), e, file.notes);
      }
    });
  });
}

const char *jam_notes(const jam_system *sys) { return sys ? sys->notes.text().c_str() : ""; }

jam_status jam_add_note(jam_system *sys, const char *text) {
  return guard_set(sys, [&]() -> jam_status {
    need(text, "text");
    if (!*text || std::strpbrk(text, "\r\n")) fail(JAM_E_ARGUMENT, "a note must be one line that is not empty");
    sys->notes.append(Notes(text));
    return JAM_OK;
  });
}

jam_status jam_write(const jam_system *sys, const char *path, int32_t format) {
  return jam_write_scaled(sys, path, format, 1.0, 1.0);
}

jam_status jam_write_scaled(const jam_system *sys, const char *path, int32_t format, double scale, double density) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    check_range("scale", scale, 1e-12, 1e12);
    check_positive_finite(density, "density");
    Beside beside{sys->known_contacts() ? &sys->contacts.coordination : nullptr, density};
    if (sys->known_contacts() && !sys->by_distance() && sys->contacts.size() > 0) {
      beside.stress = stress_tensor(sys->packing, sys->contacts);
      const bool absolute = !sys->contacts.prestress.empty();  // in epsilon / length^d
      for (double &x : beside.stress) x *= absolute ? math::pow(scale, -sys->packing.dim) : 1.0;
    }
    write_file(scale == 1.0 ? sys->packing : scaled(sys->packing, scale), beside, path, format);
    return JAM_OK;
  });
}

jam_status jam_write_contacts(const jam_system *sys, const char *path, int32_t format) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    need_contacts(sys);
    write_contacts(sys->packing, sys->contacts, path, format);
    return JAM_OK;
  });
}

jam_status jam_write_page(const jam_system *sys, const char *path, const char *title, int32_t small, const char *names,
                          const double *values, size_t values_len) {
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

}  // extern "C"
