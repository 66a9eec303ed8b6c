// libjam leaves the process as it is: signal handlers, signal masks and the host's random numbers are the same before
// and after every verb, and what other threads do with them changes no bit of a result.
#include <jam/jam.h>
#include <pthread.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

#include "test.h"

namespace {

std::atomic<int> caught{0};
void on_signal(int, siginfo_t *, void *) { ++caught; }

struct HostState {
  struct sigaction action[32];
  sigset_t mask;
  HostState() {
    std::memset(static_cast<void *>(this), 0, sizeof *this);
    for (int s = 1; s < 32; ++s) sigaction(s, nullptr, &action[s]);
    pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  }
};

void same(const HostState &a, const HostState &b) {
  for (int s = 1; s < 32; ++s) {
    assert_true(a.action[s].sa_sigaction == b.action[s].sa_sigaction);
    assert_int_equal(a.action[s].sa_flags, b.action[s].sa_flags);
    for (int k = 1; k < 32; ++k)
      assert_int_equal(sigismember(&a.action[s].sa_mask, k), sigismember(&b.action[s].sa_mask, k));
  }
  for (int k = 1; k < 64; ++k) assert_int_equal(sigismember(&a.mask, k), sigismember(&b.mask, k));
}

// Runs one call: the host finds its signals and its random numbers where they were.
void untouched(const char *name, const std::function<jam_status()> &call) {
  const HostState before;
  std::srand(11);
  const int expected = std::rand();
  std::srand(11);
  const jam_status status = call();
  if (status != JAM_OK) fail_msg("%s: status %d, %s", name, status, jam_last_error());
  assert_int_equal(std::rand(), expected);
  same(before, HostState());
}

struct Positions {
  std::vector<double> x;
};

// Every kind of long call, the result's positions for comparison.
Positions life_of_a_packing(bool check) {
  const auto step = [&](const char *name, const std::function<jam_status()> &call) {
    if (check)
      untouched(name, call);
    else
      assert_int_equal(call(), JAM_OK);
  };
  jam_system *sys = nullptr;
  DEFAULTS(create, o);
  o.n = 500, o.packing_fraction = 0.3, o.seed = 4;
  step("jam_create", [&] { return jam_create(&o, nullptr, &sys); });
  DEFAULTS(run, r);
  r.collisions_per_particle = 5.0;
  step("jam_run", [&] { return jam_run(sys, &r, nullptr); });
  DEFAULTS(compress, c);
  c.pressure = 500.0;
  step("jam_compress", [&] { return jam_compress(sys, &c, nullptr); });
  step("jam_crunch", [&] { return jam_crunch(sys, nullptr, nullptr); });
  size_t needed = 0;
  step("jam_gaps", [&] { return jam_gaps(sys, 0.1, 0, nullptr, 0, nullptr, 0, &needed); });
  step("jam_modes",
       [&] { return jam_modes(sys, nullptr, nullptr, JAM_MODE_COLUMNS, nullptr, 0, nullptr, 0, &needed); });
  const double *view = nullptr;
  size_t len = 0;
  assert_int_equal(jam_view(sys, JAM_VIEW_POSITIONS, &view, &len), JAM_OK);
  Positions out{std::vector<double>(view, view + len)};
  jam_destroy(sys);
  return out;
}

CASE(handlers_masks_and_random_numbers_stay) {
  struct sigaction mine, before;
  std::memset(&mine, 0, sizeof mine);
  mine.sa_sigaction = on_signal;
  mine.sa_flags = SA_SIGINFO | SA_RESTART;
  sigaddset(&mine.sa_mask, SIGUSR2);
  for (const int s : {SIGTERM, SIGABRT, SIGUSR1}) sigaction(s, &mine, &before);
  signal(SIGHUP, SIG_IGN);
  const Positions alone = life_of_a_packing(true);
  std::atomic<bool> stop{false};
  std::thread host([&] {
    while (!stop) {
      std::rand();
      raise(SIGTERM);
      raise(SIGHUP);
      std::srand(static_cast<unsigned>(std::rand()));
      std::this_thread::yield();
    }
  });
  const Positions beside = life_of_a_packing(false);
  stop = true;
  host.join();
  assert_true(caught > 0);
  assert_true(alone.x == beside.x);
}

}  // namespace
