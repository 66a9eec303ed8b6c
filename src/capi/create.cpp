// Header sections "the system", "sizes", and "progress, log, cancel": create, copy, destroy, info, views, setters.
#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "capi/make_system.hpp"
#include "core/create.hpp"
#include "core/decimal.hpp"
#include "core/limits.hpp"
#include "core/pairs.hpp"
#include "core/size_laws.hpp"
#include "io/files.hpp"

using namespace jam::inside;

void jam_system::update_diameters() noexcept {
  packing_fraction = jam::inside::packing_fraction(packing);
  const double first = packing.diameter[0];
  monodisperse =
      std::all_of(packing.diameter.begin(), packing.diameter.end(), [first](double s) { return s == first; });
  diameter_mean = monodisperse ? first : jam::inside::diameter_mean(packing);
}

void jam_system::commit(const Packing &result, Results &&found) noexcept {
  commit_measured(result, std::move(found));
  packing.wall_pressure.clear();
  packing.pressure = std::numeric_limits<double>::quiet_NaN();
}

void jam_system::commit_measured(const Packing &result, Results &&found) noexcept {
  show(result);
  paused.reset();
  crunch_paused.reset();
  results() = std::move(found);
}

void jam_system::show(const Packing &result) noexcept {
  if (result.position != packing.position) packing.given = {};
  std::copy(result.position.begin(), result.position.end(), packing.position.begin());
  std::copy(result.diameter.begin(), result.diameter.end(), packing.diameter.begin());
  std::copy(result.velocity.begin(), result.velocity.end(), packing.velocity.begin());
  packing.cell = result.cell;
  packing.container = result.container;
  packing.wall_pressure = result.wall_pressure;
  packing.pressure = result.pressure;
  packing.has_velocity = result.has_velocity;
  packing.overlap_allowed = result.overlap_allowed;
  update_diameters();
}

namespace {
// A line each, at the level of what it says.
void log_notes(const jam_system &sys) {
  std::string_view text = sys.notes.text();
  while (!text.empty()) {
    const std::string line(text.substr(0, text.find('\n')));
    const bool warns = line.rfind(Notes::warning, 0) == 0;
    const char *const said = line.c_str() + (warns ? std::strlen(Notes::warning) : 0);
    sys.monitor.log(warns ? JAM_LOG_WARNING : JAM_LOG_INFO, "%s", said);
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
}
}  // namespace

extern "C" {

jam_status jam_create_options_init(jam_create_options *o, size_t size) {
  return init_options(o, size, default_create_options());
}

jam_status jam_create(const jam_create_options *o, const jam_start *start, jam_system **out) {
  return guard([&]() -> Answer {
    need(out, "out");
    jam_create_options full = default_create_options();
    take_options(o, full);
    jam_start from{};
    take_options(start, from);
    if (from.cell) {
      check_dim(full.dim);
      check_matrix_len("cell", from.cell_len, full.dim);
      if (full.box != default_create_options().box)
        fail(JAM_E_ARGUMENT, "box is %g beside cell vectors, which give the box: leave box at 1", full.box);
    } else if (from.cell_len != 0) {
      fail(JAM_E_NULL, "cell is NULL, but has %zu numbers by its length", from.cell_len);
    }
    return make_system(full, from.progress, from.user, out, [&](jam_system &sys) {
      sys.packing = make_packing(full, from.positions, from.positions_len, from.diameters, from.diameters_len,
                                 from.cell, &sys.notes);
    });
  });
}

jam_status jam_copy(const jam_system *src, jam_system **out) {
  const auto copy = [&]() -> jam_status {
    need(out, "out");
    *out = std::make_unique<jam_system>(*static_cast<const SystemState *>(src)).release();
    return JAM_OK;
  };
  return guard_const(src, copy, "src");
}

void jam_destroy(jam_system *sys) { delete sys; }

jam_status jam_get_info(const jam_system *sys, jam_info *info) {
  return guard_read(sys, [&]() -> jam_status {
    need(info, "info");
    check_out_struct(info, "info");
    const Packing &p = sys->packing;
    jam_info full{};
    full.dim = p.dim;
    full.n = static_cast<int64_t>(p.n());
    full.seed = p.seed;
    full.box = p.cell.side();
    full.packing_fraction = sys->packing_fraction;
    full.diameter_mean = sys->diameter_mean;
    full.pressure = p.pressure;
    full.model = p.model;
    full.monodisperse = sys->monodisperse;
    full.masses = p.masses;
    full.non_additivity = p.non_additivity;
    full.container = p.container.kind();
    full.walls = p.container.flat();
    full.volume = scene_volume(p);
    full.contact_gap = sys->contact_gap;
    full.paused = sys->paused ? sys->paused->phase() : sys->crunch_paused ? JAM_PHASE_CRUNCH : 0;
    give_struct(full, info);
    return JAM_OK;
  });
}

jam_status jam_view(const jam_system *sys, int32_t array, const double **view, size_t *view_len) {
  return guard_read(sys, [&]() -> jam_status {
    check_enum(array, JAM_VIEW_POSITIONS, JAM_VIEW_VELOCITIES, "array", "jam_view_array");
    need(view, "view");
    need(view_len, "view_len");
    const Packing &p = sys->packing;
    const std::vector<double> &shown = array == JAM_VIEW_POSITIONS   ? p.position
                                       : array == JAM_VIEW_DIAMETERS ? p.diameter
                                                                     : p.velocity;
    *view = shown.data();
    *view_len = shown.size();
    return JAM_OK;
  });
}

jam_status jam_set_positions(jam_system *sys, const double *positions, size_t positions_len) {
  return guard_set(sys, [&]() -> jam_status {
    Packing p = sys->packing;
    need(positions, "positions");
    if (positions_len != p.position.size())
      fail(JAM_E_ARGUMENT, "positions has %zu numbers, n * dim is %zu", positions_len, p.position.size());
    check_array_in(positions, positions_len, "positions");
    p.position.assign(positions, positions + positions_len);
    p.given.take(digits_of(p.dim, p.position, p.diameter, p.cell.rows()));
    wrap_positions(p);
    apply_overlap_policy(p, p.overlap_allowed ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
    sys->commit(p);
    sys->packing.given = p.given;
    return JAM_OK;
  });
}

jam_status jam_set_velocities(jam_system *sys, const double *velocities, size_t velocities_len) {
  return guard_set(sys, [&]() -> jam_status {
    std::vector<double> &v = sys->packing.velocity;
    need(velocities, "velocities");
    if (velocities_len != v.size())
      fail(JAM_E_ARGUMENT, "velocities has %zu numbers, n * dim is %zu", velocities_len, v.size());
    check_array_in(velocities, velocities_len, "velocities");
    check_velocities(sys->packing, std::vector<double>(velocities, velocities + velocities_len), JAM_E_ARGUMENT);
    std::copy(velocities, velocities + velocities_len, v.begin());
    sys->packing.has_velocity = true;
    sys->paused.reset();
    return JAM_OK;
  });
}

jam_status jam_scale_diameters(jam_system *sys, double factor) {
  return guard_set(sys, [&]() -> jam_status {
    if (!(factor > 0.0) || !std::isfinite(factor))
      fail(JAM_E_ARGUMENT, "factor is %g, it must be positive and finite", factor);
    Packing p = sys->packing;
    for (double &s : p.diameter) s *= factor;
    check_diameters(p.diameter, p.cell);
    if (factor > 1.0) apply_overlap_policy(p, p.overlap_allowed ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
    sys->commit(p);
    return JAM_OK;
  });
}

jam_status jam_set_progress(jam_system *sys, jam_progress_fn callback, void *user) {
  return guard_set(sys, [&]() -> jam_status {
    sys->monitor.progress = callback;
    sys->monitor.progress_user = user;
    return JAM_OK;
  });
}

jam_status jam_set_log(jam_system *sys, jam_log_fn callback, int32_t level, void *user) {
  return guard_set(sys, [&]() -> jam_status {
    check_enum(level, JAM_LOG_NONE, JAM_LOG_DEBUG, "level", "jam_log_level");
    sys->monitor.log_fn = callback;
    sys->monitor.log_level = level;
    sys->monitor.log_user = user;
    log_notes(*sys);
    return JAM_OK;
  });
}

jam_status jam_set_memory_limit(jam_system *sys, double bytes) {
  return guard_set(sys, [&]() -> jam_status {
    check_positive(bytes, "bytes");
    sys->memory_limit = bytes;
    return JAM_OK;
  });
}

// From any thread at any time, also while a verb runs: that is what it is for.
jam_status jam_cancel(jam_system *sys) {
  return guard([&]() -> jam_status {
    need(sys, "sys");
    sys->monitor.cancel();
    return JAM_OK;
  });
}

jam_status jam_diameters_options_init(jam_diameters_options *o, size_t size) {
  return init_options(o, size, default_diameters_options());
}

jam_status jam_diameters(const jam_diameters_options *o, const double *curve, size_t curve_len, double *out,
                         size_t out_len, size_t *needed) {
  return guard([&]() -> jam_status {
    jam_diameters_options full = default_diameters_options();
    take_options(o, full);
    if (curve_len && !curve) fail(JAM_E_NULL, "curve is NULL but its length is %zu", curve_len);
    const std::vector<double> s = draw_diameters(full, curve, curve_len);
    return give_array(s.data(), s.size(), out, out_len, needed);
  });
}

jam_status jam_parse_diameters(const char *text, jam_diameters_options *o, double *curve, size_t curve_len,
                               size_t *needed) {
  return guard([&]() -> jam_status {
    need(text, "text");
    need(o, "o");
    jam_diameters_options full = default_diameters_options();
    take_options(o, full);
    std::vector<double> rows;
    for (const std::string &file : parse_size_law(text, full, rows)) read_curve(file.c_str(), rows);
    const jam_status status = give_array(rows.data(), rows.size(), curve, curve_len, needed);
    give_struct(full, o);
    return status;
  });
}

jam_status jam_get_size_report(int32_t dim, const double *diameters, size_t diameters_len, jam_size_report *report) {
  return guard([&]() -> jam_status {
    need(report, "report");
    check_out_struct(report, "report");
    if (diameters_len && !diameters) fail(JAM_E_NULL, "diameters is NULL but its length is %zu", diameters_len);
    give_struct(size_report(dim, std::vector<double>(diameters, diameters + diameters_len)), report);
    return JAM_OK;
  });
}

}  // extern "C"
