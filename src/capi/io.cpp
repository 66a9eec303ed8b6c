// Header section "files": jam_read, jam_write, jam_write_contacts.
#include "capi/analysis.hpp"
#include "capi/guard.hpp"
#include "capi/make_system.hpp"
#include "core/create.hpp"
#include "io/files.hpp"

using namespace jam;

extern "C" {

jam_status jam_read(const char *path, const jam_create_options *o, jam_system **out) {
  return guard([&]() -> jam_status {
    need(path, "path");
    need(out, "out");
    jam_create_options full = default_create_options();
    take_options(o, full);
    FileContent file = read_file(path);
    full.dim = file.dim;
    full.n = static_cast<int64_t>(file.position.size() / static_cast<size_t>(file.dim));
    if (file.box > 0.0) full.box = file.box;
    if (file.has_non_additivity) full.non_additivity = file.non_additivity;
    return make_system(full, nullptr, nullptr, out, [&] {
      return make_packing(full, file.position.data(), file.position.size(), file.diameter.data(), file.diameter.size(),
                          file.cell.empty() ? nullptr : file.cell.data());
    });
  });
}

jam_status jam_write(const jam_system *sys, const char *path, int32_t format) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    write_file(sys->packing, sys->has_report ? &sys->contacts.coordination : nullptr, path, format);
    return JAM_OK;
  });
}

jam_status jam_write_contacts(const jam_system *sys, const char *path, int32_t format) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    need_network(sys);
    write_contacts(sys->packing, sys->contacts, path, format);
    return JAM_OK;
  });
}

}  // extern "C"
