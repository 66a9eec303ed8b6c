// Watching a long call, stopping it by the callback and from another thread; exceptions pass through the library.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include <jam/jam.hpp>

int main() try {
  jam::System packing = jam::System::random(500, 3, 1);
  int reports = 0;
  packing.on_progress([&](const jam_progress &p) {
    std::printf("  LP or step %lld, phi %.6f, gain %.1e\n", static_cast<long long>(p.steps), p.packing_fraction,
                p.gain);
    return ++reports == 3;  // true stops the call; the state reached is valid
  });
  packing.crunch();
  std::printf("stopped by the callback: %s\n", jam_status_string(packing.status()));
  if (packing.status() != JAM_CANCELLED) return 1;

  std::atomic<bool> begun{false};
  packing.on_progress([&](const jam_progress &) { return begun = true, false; });
  std::thread other([&] {
    while (!begun) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    packing.cancel();  // the one call that any thread, or a signal handler, may make
  });
  packing.crunch();
  begun = true;
  other.join();
  std::printf("stopped by another thread: %s\n", jam_status_string(packing.status()));

  packing.on_progress([](const jam_progress &) -> bool { throw std::runtime_error("from the callback"); });
  try {
    packing.crunch();
    packing.crunch();  // the cancel above may have come too late for its call; it then ends the next one
  } catch (const std::runtime_error &e) {
    std::printf("caught: %s\n", e.what());
    return 0;
  }
  return 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
