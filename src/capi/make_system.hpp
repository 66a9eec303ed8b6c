// A new handle that make(sys) fills, within the limits of the options.
#pragma once
#include <memory>

#include "capi/guard.hpp"

namespace jam::inside {

template <class Make>
Answer make_system(const jam_create_options &o, jam_progress_fn callback, void *user, jam_system **out, Make &&make) {
  auto sys = std::make_unique<jam_system>();
  if (o.memory_limit > 0.0) sys->memory_limit = o.memory_limit;
  Monitor monitor;
  monitor.begin();
  monitor.wall_time = o.wall_time;
  monitor.progress = callback;
  monitor.progress_user = user;
  jam_progress begun = progress_of(JAM_PHASE_CREATE);
  begun.packing_fraction = 0.0;
  monitor.expect(begun);
  const CancellableScope scope(sys->memory_limit, &monitor);
  try {
    make(*sys);
  } catch (const Cancelled &) {
    *out = nullptr;
    if (monitor.cancelled()) return {JAM_CANCELLED, "the callback stopped the call before the system was made"};
    return {JAM_LIMIT, "wall_time ended before the system was made: raise wall_time"};
  }
  check_packing(sys->packing, JAM_E_INTERNAL);
  sys->update_diameters();
  *out = sys.release();
  return JAM_OK;
}

}  // namespace jam::inside
