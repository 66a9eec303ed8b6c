// Header section "molecular dynamics".
#include "capi/guard.hpp"
#include "edmd/md.hpp"

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

}  // extern "C"
