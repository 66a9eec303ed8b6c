// Work in two parts, side by side when the host allowed two threads.
#pragma once
#include <system_error>
#include <thread>

namespace jam {

// work(0) and work(1), which must not throw and must not write to the same places. Where the system has no second
// thread to give, one after the other: the parts are the same, so are the bits.
template <class Work>
void on_two_threads(const Work &work) {
  std::thread other;
  try {
    other = std::thread([&work] { work(1); });
  } catch (const std::system_error &) {
    work(1);
  }
  work(0);
  if (other.joinable()) other.join();
}

}  // namespace jam
