// What the call that runs on this thread may use: memory, and time until it is cancelled. Loops over pairs are in every
// layer, and ask here, so that no function in between has to pass both on.
#pragma once
#include <mutex>

#include "core/error.hpp"
#include "core/monitor.hpp"

namespace jam::inside {

// Half the machine's memory: memory_posix.cpp, memory_windows.cpp.
double default_memory_limit();

struct Cancelled {};  // thrown by CallScope::look; the entry points turn it into JAM_CANCELLED

// Made at the boundary for each call; calls that callbacks make nest. look() is how work learns that it must stop.
class CallScope {
 public:
  // With a monitor look() calls its callback, so that Ctrl-C is heard; the work continues until it asks the monitor.
  // quiet: held while the callback runs, where other threads work for the same call.
  explicit CallScope(double memory_limit, Monitor *monitor = nullptr, std::mutex *quiet = nullptr)
      : CallScope(memory_limit, monitor, quiet, false) {}
  ~CallScope() { current() = before_; }
  CallScope(const CallScope &) = delete;
  CallScope &operator=(const CallScope &) = delete;

  // Bytes that one call may take.
  static double memory_limit() { return current() ? current()->memory_limit_ : default_memory_limit(); }
  static void need_memory(double bytes, const char *what) {
    if (bytes > memory_limit())
      fail(JAM_E_MEMORY, "%s need %s, this call may have %s", what, bytes_text(bytes).c_str(),
           bytes_text(memory_limit()).c_str());
  }
  // In long loops. In a CancellableScope it throws Cancelled when the call has been cancelled or its time is over.
  static void look() {
    ask([](Monitor &monitor) { return monitor.look(); });
  }
  // A pipe or device has taken a part of a file that will not be whole: the call cannot say that nothing was written.
  static void note_part_written() {
    if (current()) current()->part_written_ = true;
  }
  bool part_written() const { return part_written_; }
  // A call on this handle runs on this thread: the one that asks is made by its callback.
  static bool inside(const Monitor &handle) {
    for (const CallScope *scope = current(); scope; scope = scope->before_)
      if (scope->monitor_ && (scope->monitor_ == &handle || scope->monitor_->beside(handle))) return true;
    return false;
  }
  static bool has_callback() { return current() && current()->monitor_ && current()->monitor_->progress; }
  // look() of an analysis, which reports where it begins and, if it knows, how far it is: items done, and their share
  // of all.
  static void report_share(int64_t items = 0, double share = std::numeric_limits<double>::quiet_NaN()) {
    ask([&](Monitor &monitor) { return monitor.report_share(items, share); });
  }
  // look() with a record of its own.
  static void report(const jam_progress &p) {
    ask([&](Monitor &monitor) { return monitor.report(p) || monitor.interrupted(); });
  }

 protected:
  CallScope(double memory_limit, Monitor *monitor, std::mutex *quiet, bool leaves)
      : memory_limit_(memory_limit), monitor_(monitor), quiet_(quiet), leaves_(leaves), before_(current()) {
    current() = this;
  }
  static Monitor *monitor() { return current() ? current()->monitor_ : nullptr; }
  static std::mutex *quiet() { return current() ? current()->quiet_ : nullptr; }

 private:
  template <class Question>
  static void ask(Question &&must_stop) {
    const CallScope *const scope = current();
    if (!scope || !scope->monitor_) return;
    std::unique_lock<std::mutex> lock;
    if (scope->quiet_) lock = std::unique_lock<std::mutex>(*scope->quiet_);
    const bool stop = must_stop(*scope->monitor_);
    if (stop && scope->leaves_) throw Cancelled();
  }
  static CallScope *&current() {
    static thread_local CallScope *scope = nullptr;
    return scope;
  }
  double memory_limit_;
  Monitor *monitor_;
  std::mutex *quiet_;
  bool leaves_, part_written_ = false;
  CallScope *before_;
};

// look() in loops of short steps: at every 2^16th.
class SparseLook {
 public:
  void operator()() {
    if (++steps_ % 65536 == 0) CallScope::look();
  }

 private:
  uint32_t steps_ = 0;
};

// In this scope look() throws Cancelled. The code that makes the scope catches it, or ends with it.
class CancellableScope : public CallScope {
 public:
  CancellableScope(double memory_limit, Monitor *monitor) : CallScope(memory_limit, monitor, nullptr, true) {}
  CancellableScope() : CallScope(memory_limit(), monitor(), quiet(), true) {}  // in the scope of now
};

// Runs f(); false when look() has left it.
template <class F>
bool ends_before_cancel(F &&f) {
  const CancellableScope scope;
  try {
    f();
    return true;
  } catch (const Cancelled &) {
    return false;
  }
}

}  // namespace jam::inside
