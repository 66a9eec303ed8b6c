// Who may enter a handle: any number of const calls together, or one call that changes it. The thread of that call may
// also make const calls, from its callbacks.
#pragma once
#include <atomic>
#include <thread>

namespace jam::inside {

class CallGate {
 public:
  // Each try returns false when the handle is taken; after true the matching leave must follow.
  bool enter_alone() {
    int nobody = 0;
    if (!calls_.compare_exchange_strong(nobody, alone, std::memory_order_acquire)) return false;
    owner_.store(std::this_thread::get_id(), std::memory_order_relaxed);
    return true;
  }
  void leave_alone() {
    owner_.store(std::thread::id(), std::memory_order_relaxed);
    calls_.store(0, std::memory_order_release);
  }
  bool enter_const() {
    int count = calls_.load(std::memory_order_relaxed);
    do {
      if (count == alone) return false;
    } while (!calls_.compare_exchange_weak(count, count + 1, std::memory_order_acquire));
    return true;
  }
  void leave_const() { calls_.fetch_sub(1, std::memory_order_release); }
  // This thread runs the call that has the handle alone.
  bool owned() const { return owner_.load(std::memory_order_relaxed) == std::this_thread::get_id(); }

 private:
  static constexpr int alone = -1;
  std::atomic<int> calls_{0};  // const calls inside, or `alone`
  std::atomic<std::thread::id> owner_{std::thread::id()};
};

}  // namespace jam::inside
