// Header section "files": jam_read, jam_write.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "capi/guard.hpp"
#include "core/create.hpp"
#include "io/files.hpp"

using namespace jam;

namespace {

// Spheres that cannot fit wherever they are: one wider than the box, or more volume than the box has. The search for
// the worst pair would list all their images (a diameter of 1e9 boxes: no end), so they are refused, or shrunk to
// the largest that could fit, before it. (In the Mari-Kurchan model spheres share room: only their width counts.)
void limit_diameters(const jam_create_options &o, FileContent &file) {
  double widest = 0.0, volume = 0.0;
  const double copies = file.diameter.size() == 1 ? static_cast<double>(o.n) : 1.0;
  for (double s : file.diameter) {
    widest = std::max(widest, s / o.box);
    volume += copies * unit_sphere_volume(o.dim) * std::pow(s / o.box, o.dim);
  }
  const double scale = o.model == JAM_MODEL_MK ? widest : std::max(widest, std::pow(volume, 1.0 / o.dim));
  if (scale <= 1.0 + overlap_tolerance) return;
  if (o.overlap != JAM_OVERLAP_SHRINK)
    fail(JAM_E_OVERLAP, "the spheres cannot fit into the box %g: largest diameter %g, packing fraction %g", o.box,
         widest * o.box, volume);
  for (double &s : file.diameter) s /= scale;
}

}  // namespace

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
    limit_diameters(full, file);
    auto sys = std::make_unique<jam_system>();
    sys->packing =
        make_packing(full, file.position.data(), file.position.size(), file.diameter.data(), file.diameter.size());
    sys->note_diameters();
    *out = sys.release();
    return JAM_OK;
  });
}

jam_status jam_write(const jam_system *sys, const char *path, int32_t format) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    write_file(sys->packing, sys->has_report ? &sys->contacts.coordination : nullptr, path, format);
    return JAM_OK;
  });
}

}  // extern "C"
