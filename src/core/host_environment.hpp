// The floating-point environment of the thread (rounding, traps, raised flags, treatment of denormal numbers) and its
// decimal point belong to the host. libjam computes in the environment that C programs start with, which new threads
// inherit, and leaves the host's as it was, flags included. The host's callbacks run in the host's.
#pragma once
#include <cfenv>
#include <cstdint>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif
#include "core/decimal_point.hpp"

namespace jam::inside {

// What the host had. enter() notes it and sets the environment of C, leave() brings it back.
#if defined(__x86_64__)
// By hand: fegetenv and fesetenv take longer than a call that only looks something up.
class HostFloatingPoint {
 public:
  void enter() noexcept {
    sse_ = _mm_getcsr();
    if ((sse_ & ~flags) != 0x1f80) _mm_setcsr(0x1f80);
    asm volatile("fnstcw %0\n\tfnstsw %1" : "=m"(x87_control_), "=m"(x87_status_)::"memory");
    const uint16_t control = 0x37f;
    if (x87_control_ != control) asm volatile("fldcw %0" ::"m"(control) : "memory");
  }
  void leave() const noexcept {
    if (_mm_getcsr() != sse_) _mm_setcsr(sse_);
    uint16_t control, status;
    asm volatile("fnstcw %0\n\tfnstsw %1" : "=m"(control), "=m"(status)::"memory");
    if (control == x87_control_ && ((status ^ x87_status_) & flags) == 0) return;
    constexpr uint16_t summary = 0x80;  // some raised flag traps
    struct {
      uint16_t control, unused0, status, unused1;
      uint32_t rest[5];
    } all;
    asm volatile("fnstenv %0" : "=m"(all)::"memory");
    all.control = x87_control_;
    all.status = static_cast<uint16_t>((all.status & ~(flags | summary)) | (x87_status_ & flags));
    asm volatile("fldenv %0" ::"m"(all) : "memory");
  }

 private:
  static constexpr uint16_t flags = 0x3f;
  uint32_t sse_;
  uint16_t x87_control_, x87_status_;
};
#else
class HostFloatingPoint {
 public:
  void enter() noexcept {
    fegetenv(&all_);
    fesetenv(FE_DFL_ENV);
  }
  void leave() const noexcept { fesetenv(&all_); }

 private:
  fenv_t all_;
};
#endif

class HostEnvironment {
 public:
  void enter() noexcept {
    floating_point_.enter();
    decimal_point_.enter();
  }
  void leave() const noexcept {
    decimal_point_.leave();
    floating_point_.leave();
  }

 private:
  HostFloatingPoint floating_point_;
  HostDecimalPoint decimal_point_;
};

// One for each call from the host, on its stack.
class OwnEnvironment {
 public:
  OwnEnvironment() noexcept : before_(current()), of_caller_(true) {
    host_.enter();
    current() = this;
  }
  // On a thread that libjam started for the call.
  explicit OwnEnvironment(const HostEnvironment &host) noexcept : host_(host), before_(current()), of_caller_(false) {
    current() = this;
  }
  ~OwnEnvironment() {
    current() = before_;
    if (of_caller_) host_.leave();
  }
  OwnEnvironment(const OwnEnvironment &) = delete;
  OwnEnvironment &operator=(const OwnEnvironment &) = delete;

  // Of the call that runs on this thread; what the thread has outside of calls.
  static HostEnvironment host() noexcept {
    if (current()) return current()->host_;
    HostEnvironment now;
    now.enter();
    now.leave();
    return now;
  }

  // While the host's callback runs. What it changes is the host's from then on.
  class OfHost {
   public:
    OfHost() noexcept : call_(current()) {
      if (call_) call_->host_.leave();
    }
    ~OfHost() {
      if (call_) call_->host_.enter();
    }
    OfHost(const OfHost &) = delete;
    OfHost &operator=(const OfHost &) = delete;

   private:
    OwnEnvironment *const call_;
  };

 private:
  static OwnEnvironment *&current() noexcept {
    static thread_local OwnEnvironment *call = nullptr;
    return call;
  }
  HostEnvironment host_;
  OwnEnvironment *const before_;
  const bool of_caller_;
};

}  // namespace jam::inside
