// Header section "molecular dynamics".
#include <memory>
#include <utility>

#include "capi/guard.hpp"
#include "core/create.hpp"
#include "edmd/glass.hpp"
#include "edmd/md.hpp"
#include "io/checkpoint.hpp"

using namespace jam;

namespace {
// Runs `work` on a copy of the packing; the handle changes only when it does not throw.
template <class F>
jam_status run_md(jam_system *sys, jam_md_report *report, F &&work) {
  Packing p = sys->packing;
  jam_md_report full{};
  const jam_status status = work(p, full);
  sys->commit(p);
  sys->drop_results();
  give_struct(full, report);
  return status;
}
}  // namespace

extern "C" {

jam_status jam_run_options_init(jam_run_options *o, size_t size) { return init_options(o, size, default_run_options()); }
jam_status jam_compress_options_init(jam_compress_options *o, size_t size) { return init_options(o, size, default_compress_options()); }

jam_status jam_run(jam_system *sys, const jam_run_options *o, jam_md_report *report) {
  return guard_verb(sys, [&]() -> jam_status {
    check_out_struct(report, "report");
    jam_run_options full = default_run_options();
    take_options(o, full);
    check_run_options(full);
    const MdStage stage{0.0, 0.0, 0.0, full.collisions_per_particle, full.wall_time};
    return run_md(sys, report, [&](Packing &p, jam_md_report &r) { return run_stage(p, stage, sys->monitor, r); });
  });
}

jam_status jam_compress(jam_system *sys, const jam_compress_options *o, jam_md_report *report) {
  return guard_verb(sys, [&]() -> jam_status {
    check_out_struct(report, "report");
    if (!o) return run_md(sys, report, [&](Packing &p, jam_md_report &r) { return run_default_protocol(p, sys->monitor, r); });
    jam_compress_options full = default_compress_options();
    take_options(o, full);
    check_compress_options(full);
    const MdStage stage{full.growth_rate, full.pressure, full.packing_fraction, full.collisions_per_particle, full.wall_time};
    return run_md(sys, report, [&](Packing &p, jam_md_report &r) { return run_stage(p, stage, sys->monitor, r); });
  });
}

jam_status jam_checkpoint_write(const jam_system *sys, const char *path) {
  return guard_const(sys, [&]() -> jam_status {
    need(path, "path");
    write_checkpoint(sys->packing, path);
    return JAM_OK;
  });
}

jam_status jam_checkpoint_read(const char *path, jam_system **out) {
  return guard([&]() -> jam_status {
    need(path, "path");
    need(out, "out");
    auto sys = std::make_unique<jam_system>();
    sys->packing = read_checkpoint(path);
    settle_overlaps(sys->packing, JAM_OVERLAP_REFUSE);
    *out = sys.release();
    return JAM_OK;
  });
}

jam_status jam_eos(int32_t form, int32_t dim, double packing_fraction, double jammed_fraction, double *pressure) {
  return guard([&]() -> jam_status {
    need(pressure, "pressure");
    *pressure = equation_of_state(form, dim, packing_fraction, jammed_fraction);
    return JAM_OK;
  });
}

jam_status jam_glass_fit(const double *fraction, size_t fraction_len, const double *pressure, size_t pressure_len, jam_glass *fit) {
  return guard([&]() -> jam_status {
    need(fraction, "fraction");
    need(pressure, "pressure");
    need(fit, "fit");
    check_out_struct(fit, "fit");
    if (fraction_len != pressure_len) fail(JAM_E_ARGUMENT, "fraction_len is %zu, pressure_len is %zu", fraction_len, pressure_len);
    give_struct(fit_glass(fraction, pressure, fraction_len), fit);
    return JAM_OK;
  });
}

}  // extern "C"
