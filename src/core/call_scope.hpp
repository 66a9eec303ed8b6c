// What the call that runs on this thread may use: memory, and time until it is cancelled. Searches for pairs are made
// from every layer, and ask here, so that no function in between has to pass both on.
#pragma once
#include <unistd.h>

#include "core/cancellation.hpp"

namespace jam {

// Half the machine's memory.
inline double default_memory_limit() {
  return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Made at the boundary for each call; calls that callbacks make nest. A monitor is given by those who catch Cancelled.
class CallScope {
 public:
  explicit CallScope(double memory_limit, Monitor *monitor = nullptr)
      : memory_limit_(memory_limit), monitor_(monitor), before_(current()) {
    current() = this;
  }
  ~CallScope() { current() = before_; }
  CallScope(const CallScope &) = delete;
  CallScope &operator=(const CallScope &) = delete;

  // Bytes that one call may take.
  static double memory_limit() { return current() ? current()->memory_limit_ : default_memory_limit(); }
  // Tells the progress callback; throws Cancelled when the call has been cancelled or its time is over.
  static void look() {
    if (current() && current()->monitor_ && current()->monitor_->look()) throw Cancelled();
  }
  // The same with a record of its own.
  static void report(const jam_progress &p) {
    Monitor *const monitor = current() ? current()->monitor_ : nullptr;
    if (monitor && (monitor->report(p) || monitor->interrupted())) throw Cancelled();
  }

 private:
  static CallScope *&current() {
    static thread_local CallScope *scope = nullptr;
    return scope;
  }
  double memory_limit_;
  Monitor *monitor_;
  CallScope *before_;
};

}  // namespace jam
