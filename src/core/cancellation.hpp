// Progress and cancelling inside the analysis: long loops call a CancellationPoint, which throws Cancelled to stop.
#pragma once
#include <cmath>
#include "core/monitor.hpp"

namespace jam {

struct Cancelled {};  // thrown by CancellationPoint; the entry points turn it into JAM_CANCELLED

class CancellationPoint {
 public:
  CancellationPoint() = default;
  explicit CancellationPoint(Monitor &monitor) : monitor_(&monitor) {}
  void operator()(int64_t items = 0, double fraction = std::nan("")) const {
    if (!monitor_) return;
    jam_progress p = progress_of(JAM_PHASE_ANALYSE);
    p.steps = items;
    p.fraction = fraction;
    if (monitor_->report(p)) throw Cancelled();
  }

 private:
  Monitor *monitor_ = nullptr;
};

}  // namespace jam
