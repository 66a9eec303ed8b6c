// Header section "files": jam_formats, jam_read, jam_read_as, jam_notes, jam_add_note, jam_write,
// jam_write_scaled, jam_write_contacts.
#include <cstring>

#include "capi/analysis.hpp"
#include "capi/make_system.hpp"
#include "core/create.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "io/formats.hpp"

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
      settle_options(path, file, full);
      sys.notes = file.notes;
      try {
        sys.packing = make_packing(full, file.position.data(), file.position.size(), file.diameter.data(),
                                   file.diameter.size(), file.cell.empty() ? nullptr : file.cell.data(), &sys.notes);
        sys.packing.given.take(file.given());
      } catch (const Error &e) {
        refuse(path, e, file.notes);
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

}  // extern "C"
