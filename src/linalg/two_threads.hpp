// Work in two parts, side by side when the host allowed two threads; and long work during which a callback is called.
#pragma once
#include <chrono>
#include <future>
#include <system_error>
#include <thread>

#include "core/call_scope.hpp"
#include "core/host_environment.hpp"

namespace jam {

// work(0) and work(1), which must not write to the same places. Where the system has no second thread to give, one
// after the other: the parts are the same, so are the bits. Only work(0) may throw, on this thread; it waits for the
// other.
template <class Work>
void on_two_threads(const Work &work) {
  std::thread other;
  struct Join {
    std::thread &thread;
    ~Join() {
      if (thread.joinable()) thread.join();
    }
  } join{other};
  try {
    other = std::thread([&work, host = OwnEnvironment::host()] {
      const OwnEnvironment of_call(host);
      work(1);
    });
  } catch (const std::system_error &) {
    work(1);
  }
  work(0);
}

// Runs work(), which must not throw and cannot ask the monitor by itself, on another thread, while this one calls the
// callback. The work is the same, so are the bits. A call that is cancelled is left when the work has ended.
template <class Work>
void while_telling(const Work &work) {
  constexpr std::chrono::milliseconds between_looks(20);
  if (!CallScope::can_tell()) return work();
  std::future<void> done;
  try {
    done = std::async(std::launch::async, [&work, host = OwnEnvironment::host()] {
      const OwnEnvironment of_call(host);
      work();
    });
  } catch (const std::system_error &) {
    return work();
  }
  while (done.wait_for(between_looks) != std::future_status::ready) CallScope::look();
}

}  // namespace jam
