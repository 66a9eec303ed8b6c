// Cancel flag, time limit, progress and log callbacks, and clock of a long call.
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "core/host_environment.hpp"
#include "core/math.hpp"
#include "core/tuning.hpp"
#include "jam/jam.h"

namespace jam::inside {

// The record that callbacks get, empty, and the time that is left of a call.

// The one place that makes a record: what a phase does not know is NaN.
inline jam_progress progress_of(int32_t phase) {
  jam_progress p{};
  p.struct_size = sizeof p;
  p.phase = phase;
  p.packing_fraction = p.pressure = p.gain = p.max_step = p.fraction = p.seconds_left = p.seconds_left_spread =
      std::numeric_limits<double>::quiet_NaN();
  return p;
}

// log(first / now) / log(first / end) of a number that goes from `first` to `end`, up or down; NaN where one of them is
// no number yet.
inline double log_share(double first, double now, double end) {
  if (!(first > 0.0 && now > 0.0 && end > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(end)) return 0.0;
  const double whole = math::log(first / end);
  return whole == 0.0 ? 1.0 : std::min(1.0, std::max(0.0, math::log(first / now) / whole));
}

// Keeps how the fraction of a call grew, and extrapolates it.
class TimeLeft {
 public:
  void begin() { count_ = 0, least_gap_ = 0.0, largest_ = std::numeric_limits<double>::quiet_NaN(); }
  // Completes p, whose `seconds` are set: its fraction never falls, and the time left follows from the rates at which
  // it grew over all the time, over the last half and over the last quarter of it. Their range is the spread.
  void complete(jam_progress &p) {
    if (largest_ > p.fraction || std::isnan(p.fraction)) p.fraction = largest_;
    if (std::isnan(p.fraction)) return;
    largest_ = p.fraction = std::min(1.0, std::max(0.0, p.fraction));
    keep(p.seconds, p.fraction);
    double least = std::numeric_limits<double>::infinity(), most = 0.0, recent = 0.0;
    const double first = seconds_[0], whole = p.seconds - first;
    if (count_ < TimeLeftTuning::fewest) return;
    for (const double part : {1.0, 0.5, 0.25}) {
      const size_t k = at(p.seconds - part * whole);
      const double gained = p.fraction - fraction_[k];
      if (!(gained > 0.0)) continue;
      const double left = (1.0 - p.fraction) * (p.seconds - seconds_[k]) / gained;
      least = std::min(least, left), most = std::max(most, left);
      if (part >= 0.5) recent = left;
    }
    if (!(most > 0.0)) return;
    p.seconds_left = recent > 0.0 ? recent : most;
    const bool unsteady = p.phase == JAM_PHASE_CRUNCH || p.phase == JAM_PHASE_POLISH;
    p.seconds_left_spread = (unsteady ? TimeLeftTuning::crunch : TimeLeftTuning::steady) *
                            std::max(most / p.seconds_left, p.seconds_left / least);
  }

 private:
  static constexpr size_t most_kept = TimeLeftTuning::most_kept;
  // The last record that is no later; the first one where none is.
  size_t at(double seconds) const {
    size_t k = 0;
    while (k + 1 < count_ && seconds_[k + 1] <= seconds) ++k;
    return k;
  }
  void keep(double seconds, double fraction) {
    if (count_ > 0 && seconds - seconds_[count_ - 1] < least_gap_) return;
    if (count_ == most_kept) {  // every second one stays
      for (size_t k = 0; k < most_kept / 2; ++k) seconds_[k] = seconds_[2 * k], fraction_[k] = fraction_[2 * k];
      count_ = most_kept / 2;
      least_gap_ = 2.0 * (seconds_[count_ - 1] - seconds_[0]) / most_kept;
    }
    seconds_[count_] = seconds, fraction_[count_++] = fraction;
  }
  std::array<double, most_kept> seconds_{}, fraction_{};
  size_t count_ = 0;
  double least_gap_ = 0.0, largest_ = std::numeric_limits<double>::quiet_NaN();
};

// Bytes of a sentence that says why, for jam_last_error and the log: a paragraph of jam_check_text fits.
constexpr size_t sentence_max = 2048;

inline double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// One per handle, and one for each short call beside it. cancel() is safe from signal handlers: it only adds to a
// lock-free number.
class Monitor {
 public:
  void cancel() { asked_.fetch_add(1, std::memory_order_relaxed); }
  bool cancelled() const {
    return asked() != answered_.load(std::memory_order_relaxed) || (of_ && of_->asked() != at_);
  }
  // Called by capi at the start of a verb; a cancel that came before still stops that verb.
  void begin() {
    start_ = now_seconds();
    last_ = start_ - 1.0;
    wall_time = std::numeric_limits<double>::infinity();
    last_report_ = progress_of(JAM_PHASE_ANALYSE);
    time_left_.begin();
    span(0.0, 1.0);
  }
  // Called by capi at the end of a verb.
  void end() { answered_.store(asked(), std::memory_order_relaxed); }
  // The same for a short call on `handle`, several of which may run at once. It hears the cancels that come while it
  // runs; one that came before waits for the next verb. calls_back: the handle's callback is called.
  void begin_beside(const Monitor &handle, bool calls_back) {
    begin();
    of_ = &handle;
    at_ = handle.asked();
    if (calls_back) progress = handle.progress, progress_user = handle.progress_user;
  }
  // A cancel that ended this short call is answered with it, and no longer waits for the next verb.
  void end_beside(Monitor &handle) const {
    if (handle.asked() != at_) handle.end();
  }
  // This short call is one on that handle.
  bool beside(const Monitor &handle) const { return of_ == &handle; }
  double seconds() const { return now_seconds() - start_; }
  // The call must stop, by the flag or by its limit.
  bool interrupted() const { return cancelled() || seconds() > wall_time; }
  // Why: the flag comes first.
  int32_t why_interrupted() const { return cancelled() ? JAM_STOP_CANCELLED : JAM_STOP_WALL_TIME; }
  // The call may take so many seconds from now on.
  void limit_time(double left) { wall_time = seconds() + left; }

  // The fractions that are reported from here on are of this part of the call.
  void span(double first, double last) { first_ = first, last_part_ = last; }
  // Returns true when the call must stop. Calls the callback at most every shortest_interval, or at once if forced.
  bool report(jam_progress p, bool force = false) {
    if (cancelled()) return true;
    if (!progress) return false;
    const double t = now_seconds();
    if (!force && t - last_ < ReportTuning::shortest_interval) return false;
    last_ = t;
    p.struct_size = sizeof p;
    p.seconds = t - start_;
    last_report_ = p;
    p.fraction = first_ + (last_part_ - first_) * p.fraction;
    time_left_.complete(p);
    const OwnEnvironment::OfHost its_own;
    if (progress(&p, progress_user) != 0) cancel();
    return cancelled();
  }
  // In a long loop between reports: repeats the last one after a silence, so that Ctrl-C is heard. Returns true when
  // the call must stop.
  bool look() {
    if (interrupted()) return true;
    if (now_seconds() - std::max(last_, start_) < ReportTuning::longest_silence) return false;
    jam_progress again = last_report_;
    again.snapshot = 0;
    return report(again);
  }
  // How far an analysis is. Inside a verb that reports a phase of its own this is look(). Returns true when the call
  // must stop.
  bool report_share(int64_t items, double share) {
    if (last_report_.phase != JAM_PHASE_ANALYSE) return look();
    jam_progress p = progress_of(JAM_PHASE_ANALYSE);
    p.steps = items;
    p.fraction = share;
    return report(p) || interrupted();
  }
  // What look() reports before the first report, and how far a long LP is.
  void expect(const jam_progress &p) { last_report_ = p; }
  void expect_factorisations(int64_t so_far) { last_report_.factorisations = so_far; }
  __attribute__((format(printf, 3, 4))) void log(int level, const char *format, ...) const {
    if (!log_fn || level > log_level) return;
    char line[sentence_max];
    va_list args;
    va_start(args, format);
    std::vsnprintf(line, sizeof line, format, args);
    va_end(args);
    const OwnEnvironment::OfHost its_own;
    log_fn(level, line, log_user);
  }

  double wall_time = std::numeric_limits<double>::infinity();  // of the verb at hand, which sets it after begin()
  jam_progress_fn progress = nullptr;
  void *progress_user = nullptr;
  jam_log_fn log_fn = nullptr;
  void *log_user = nullptr;
  int log_level = JAM_LOG_NONE;

 private:
  uint32_t asked() const { return asked_.load(std::memory_order_relaxed); }
  std::atomic<uint32_t> asked_{0}, answered_{0};  // cancels so far, and those that a call has ended for
  const Monitor *of_ = nullptr;                   // of the handle, for a short call
  uint32_t at_ = 0;                               // its cancels when the call began
  double start_ = 0.0, last_ = 0.0;
  double first_ = 0.0, last_part_ = 1.0;
  TimeLeft time_left_;
  jam_progress last_report_ = progress_of(JAM_PHASE_ANALYSE);
};

// The limit of one part of a call: what comes after that part has the limit of before.
class TimeLimit {
 public:
  TimeLimit(Monitor &monitor, double wall_time) : monitor_(monitor), before_(monitor.wall_time) {
    monitor.wall_time = wall_time;
  }
  ~TimeLimit() { monitor_.wall_time = before_; }
  TimeLimit(const TimeLimit &) = delete;
  TimeLimit &operator=(const TimeLimit &) = delete;

 private:
  Monitor &monitor_;
  double before_;
};

}  // namespace jam::inside
