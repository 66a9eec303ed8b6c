// The one barrier between C++ and C: every entry point runs guard(lambda).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#if __has_include(<cxxabi.h>)
#include <cxxabi.h>
#endif
#include "capi/system.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "core/host_environment.hpp"
#include "core/host_thread.hpp"

namespace jam::inside {

// libjam's environment while one call runs. Out of line, as each of some 200 functions enters it.
class OwnEnvironmentOfCall {
 public:
  OwnEnvironmentOfCall() noexcept;
  ~OwnEnvironmentOfCall();

 private:
  const HostThread thread_;
  const OwnEnvironment own_;
};

// Thread-local text of jam_last_error; set_last_error never allocates.
void set_last_error(const char *text) noexcept;

// Of the exception that is being handled: its status, and its text as that of jam_last_error.
jam_status status_of_exception() noexcept;

inline const char *why(const Answer &answer) {
  return answer.text.empty() ? text_of_status(answer.status) : answer.text.c_str();
}

// Not inlined, so that the compiler moves no computation of f out of the environment that guard sets.
template <class F>
[[gnu::noinline]] Answer compute(F &f) {
  return f();
}

// Runs f() in libjam's environment and maps what it throws to a status and text. f returns jam_status
// or Answer. Nothing leaves it but the unwinding of a thread that its host has cancelled (core/host_thread.hpp).
template <class F>
jam_status guard(F &&f) {
  const OwnEnvironmentOfCall own;
  try {
    const Answer answer = compute(f);
    if (answer.status != JAM_OK) set_last_error(why(answer));
    return answer.status;
#ifdef __GLIBCXX__
  } catch (abi::__forced_unwind &) {
    throw;
#endif
  } catch (...) {
    return status_of_exception();
  }
}

// A const call that runs on a handle. No gate is needed inside a callback of the call that has the handle alone.
class Reading {
 public:
  explicit Reading(const jam_system *sys, const char *name = "sys") {
    if (!sys) fail(JAM_E_NULL, "%s is NULL", name);
    if (sys->gate.owned()) return;
    if (!sys->gate.enter_const()) fail(JAM_E_BUSY, "another thread is in a call on this handle");
    gate_ = &sys->gate;
  }
  ~Reading() {
    if (gate_) gate_->leave_const();
  }
  Reading(const Reading &) = delete;
  Reading &operator=(const Reading &) = delete;

 private:
  CallGate *gate_ = nullptr;
};

// The work of a short call. Most take no time, some take hours for large systems: a cancel and the callback of the
// handle end them too. f throws Cancelled before it has changed or written anything, but to a pipe or a device. A call
// that the callback makes does not call it again.
template <class F>
Answer run_short(const jam_system *sys, F &&f) {
  const bool inside = CallScope::inside(sys->monitor);
  Monitor monitor;
  monitor.begin_beside(sys->monitor, !inside);
  const CancellableScope scope(sys->memory_limit, &monitor);
  try {
    return f();
  } catch (const Cancelled &) {
    if (!inside) monitor.end_beside(sys->monitor);
    return {JAM_CANCELLED, std::string("jam_cancel or the callback stopped the call: ") +
                               (scope.part_written() ? "the pipe or device has a part of the file, nothing was changed"
                                                     : "nothing was changed or written")};
  }
}

// A const call on a handle that computes: checks the handle inside the try.
template <class F>
jam_status guard_const(const jam_system *sys, F &&f, const char *name = "sys") {
  return guard([&] {
    const Reading reading(sys, name);
    return run_short(sys, f);
  });
}

// A const call that copies what the handle holds: nothing in it is long enough to be stopped, and a monitor of its own
// would take ten times as long as a view.
template <class F>
jam_status guard_read(const jam_system *sys, F &&f) {
  return guard([&] {
    const Reading reading(sys);
    return f();
  });
}

// In builds of the tests: what a call leaves behind is a packing that could be read back. n is bounded, as the search
// for overlaps takes as long as some verbs.
inline void check_state_left([[maybe_unused]] const jam_system *sys) {
#ifdef JAM_CHECK_PAIRS
  const CallScope unlimited(std::numeric_limits<double>::infinity());
  check_packing(sys->packing, JAM_E_INTERNAL);
  if (!sys->packing.overlap_allowed && sys->packing.n() <= 2000) refuse_overlaps(sys->packing, overlap_tolerance);
#endif
}

// A call that has the handle alone.
class Busy {
 public:
  explicit Busy(jam_system *sys) : sys_(sys) {
    if (!sys) fail(JAM_E_NULL, "sys is NULL");
    if (!sys->gate.enter_alone()) fail(JAM_E_BUSY, "another call is running on this handle");
  }
  ~Busy() { sys_->gate.leave_alone(); }
  Busy(const Busy &) = delete;
  Busy &operator=(const Busy &) = delete;

 private:
  jam_system *sys_;
};

// A short call that changes the handle. It must be the only call; a pending jam_cancel stays for the next long call.
template <class F>
jam_status guard_set(jam_system *sys, F &&f) {
  return guard([&] {
    const Busy busy(sys);
    const Answer answer = run_short(sys, f);
    check_state_left(sys);
    return answer;
  });
}

// A verb on a handle. jam_cancel stops it,
// also if it was called before;
// the cancel flag is cleared when the verb returns.
template <class F>
jam_status guard_verb(jam_system *sys, F &&f) {
  return guard([&] {
    const Busy busy(sys);
    struct Release {
      Monitor &monitor;
      ~Release() { monitor.end(); }
    } release{sys->monitor};
    sys->monitor.begin();
    const CallScope scope(sys->memory_limit, &sys->monitor);
    try {
      const Answer answer = f();
      check_state_left(sys);
      if (answer.status != JAM_OK) sys->monitor.log(JAM_LOG_WARNING, "%s", why(answer));
      return answer;
    } catch (const Error &e) {
      sys->monitor.log(JAM_LOG_WARNING, "%s", e.what());
      throw;
    }
  });
}

// Shows a simulation to callbacks (jam_write_checkpoint) while it runs.
class Running {
 public:
  Running(jam_system *sys, const Dynamics *dynamics) : sys_(sys) { sys->live = dynamics; }
  ~Running() { sys_->live = nullptr; }
  Running(const Running &) = delete;
  Running &operator=(const Running &) = delete;

 private:
  jam_system *sys_;
};

// What was observed before a call, given back to the handle where the call fails.
class Observations {
 public:
  explicit Observations(jam_system *sys) : sys_(sys) {
    if (sys->observing) before_ = std::make_unique<Observer>(*sys->observer);
  }
  ~Observations() {
    if (before_) sys_->observer = std::move(before_);
  }
  void keep() { before_.reset(); }
  Observations(const Observations &) = delete;
  Observations &operator=(const Observations &) = delete;

 private:
  jam_system *sys_;
  std::unique_ptr<Observer> before_;
};

inline void need(const void *pointer, const char *name) {
  if (!pointer) fail(JAM_E_NULL, "%s is NULL", name);
}

// How much longer than here a struct of a later version may be. Beyond that struct_size was not set.
constexpr size_t struct_growth_max = 512;

// The size that a caller states for a struct: less than here in an older program, more in one of a later version. It is
// a multiple of the alignment, and such a size never ends inside a field.
template <class T>
void check_struct_size(size_t size, const char *name, const char *member = "") {
  if (size < sizeof(uint32_t) || size > sizeof(T) + struct_growth_max)
    fail(JAM_E_STRUCT_SIZE, "%s%s is %zu, in this library it is %zu", name, member, size, sizeof(T));
  if (size % alignof(T) != 0) fail(JAM_E_STRUCT_SIZE, "%s%s is %zu, which cuts a field in two", name, member, size);
}

template <class T>
auto check_reserved(const T &options, int) -> decltype(options.reserved, void()) {
  if (options.reserved != 0)
    fail(JAM_E_ARGUMENT, "reserved is %lld, it must be 0", static_cast<long long>(options.reserved));
}
template <class T>
void check_reserved(const T &, long) {}  // structs without such a field

// Copies a caller's option struct into a full one: fields the caller's header did not know keep their defaults.
// `full` holds the defaults; NULL options leave it so. Options that this library does not know must be 0, not set.
template <class T>
void take_options(const T *options, T &full) {
  if (!options) return;
  const size_t size = options->struct_size;
  check_struct_size<T>(size, "struct_size");
  const auto *const bytes = reinterpret_cast<const unsigned char *>(options);
  for (size_t k = sizeof(T); k < size; ++k)
    if (bytes[k])
      fail(JAM_E_STRUCT_SIZE,
           "struct_size is %zu, in this library it is %zu, and byte %zu is not 0: libjam %s has "
           "no such option, a later version does",
           size, sizeof(T), k, jam_version());
  std::memcpy(static_cast<void *>(&full), options, std::min(size, sizeof(T)));
  full.struct_size = sizeof(T);
  check_reserved(full, 0);
}

// Writes as much of `full` as the caller's struct holds and leaves the caller's struct_size. Bytes of members that this
// library does not have are set: NaN in a double, -1 in an integer, which is how reports say that a number is not
// known.
template <class T>
void check_out_struct(const T *out, const char *name) {
  if (out) check_struct_size<T>(out->struct_size, name, "->struct_size");
}
template <class T>
void give_struct(const T &full, T *out) {
  if (!out) return;
  const uint32_t size = out->struct_size;
  std::memset(static_cast<void *>(out), 0xff, size);
  std::memcpy(static_cast<void *>(out), &full, std::min<size_t>(size, sizeof(T)));
  out->struct_size = size;
}
// A verb that may be left by Cancelled before it has changed anything; the report then gives the reason and leaves all
// else unknown.
template <class Report, class F>
jam_status guard_reporting(jam_system *sys, Report *report, F &&f) {
  return guard_verb(sys, [&]() -> Answer {
    check_out_struct(report, "report");
    try {
      return f();
    } catch (const Cancelled &) {
      const bool cancelled = sys->monitor.cancelled();
      Report r{};
      set_blank(*sys, r);
      r.stop_reason = cancelled ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME;
      give_struct(r, report);
      return stopped(cancelled ? JAM_CANCELLED : JAM_LIMIT, r.stop_reason);
    }
  });
}

// Body of every jam_X_options_init.
template <class T>
jam_status init_options(T *out, size_t size, T defaults) noexcept {
  return guard([&]() -> jam_status {
    need(out, "o");
    check_struct_size<T>(size, "size");
    defaults.struct_size = static_cast<uint32_t>(size);
    std::memset(static_cast<void *>(out), 0, size);
    std::memcpy(static_cast<void *>(out), &defaults, std::min(size, sizeof(T)));
    return JAM_OK;
  });
}

// A (d, d) matrix in.
inline void check_matrix_len(const char *name, size_t len, int dim) {
  if (len != static_cast<size_t>(dim) * static_cast<size_t>(dim))
    fail(JAM_E_ARGUMENT, "%s_len is %zu, it must be dim * dim = %d", name, len, dim * dim);
}

inline void check_array_in(const double *x, size_t len, const char *name) {
  if (len && !x) fail(JAM_E_NULL, "%s is NULL but its length is %zu", name, len);
  for (size_t k = 0; k < len; ++k)
    if (!std::isfinite(x[k])) fail(JAM_E_NONFINITE, "%s[%zu] is %g", name, k, x[k]);
}

}  // namespace jam::inside
