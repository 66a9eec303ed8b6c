// Long work during which a callback is called.
#pragma once
#include <chrono>
#include <future>
#include <system_error>

#include "core/call_scope.hpp"
#include "core/host_environment.hpp"

namespace jam::inside {

// Runs work(), which must not throw and cannot ask the monitor by itself, on another thread, while this one calls the
// callback. The work is the same, so are the bits. A call that is cancelled is left when the work has ended.
template <class Work>
void report_while(const Work &work) {
  constexpr std::chrono::milliseconds between_looks(20);
  if (!CallScope::has_callback()) return work();
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

}  // namespace jam::inside
