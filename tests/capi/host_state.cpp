// The process is the host's. No rounding mode, trap or treatment of denormal numbers, no signal handler and no random
// number of the host changes a bit of a result; no call leaves a flag, a mode, a handler or a mask behind or draws a
// random number; and callbacks find the host's environment. Meant for ThreadSanitizer too.
#include <jam/jam.h>
#include <pthread.h>

#include <atomic>
#include <cfenv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <thread>
#include <vector>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "steps.h"

namespace {

struct Environment {
  int rounding, raised, traps;
  unsigned control = 0;  // of SSE: flags, masks, rounding, denormal numbers
  unsigned short x87 = 0;
  struct sigaction action[32];
  sigset_t mask;
  Environment() : rounding(fegetround()), raised(fetestexcept(FE_ALL_EXCEPT)), traps(fegetexcept()) {
#if defined(__x86_64__)
    control = _mm_getcsr();
    asm volatile("fnstcw %0" : "=m"(x87));
#endif
    for (int s = 1; s < 32; ++s) sigaction(s, nullptr, &action[s]);
    pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  }
  bool operator==(const Environment &o) const {
    return rounding == o.rounding && raised == o.raised && traps == o.traps && control == o.control && x87 == o.x87 &&
           same_signals(o);
  }
  bool same_signals(const Environment &o) const {
    for (int k = 1; k < 64; ++k)
      if (sigismember(&mask, k) != sigismember(&o.mask, k)) return false;
    for (int s = 1; s < 32; ++s) {
      if (action[s].sa_sigaction != o.action[s].sa_sigaction || action[s].sa_flags != o.action[s].sa_flags)
        return false;
      for (int k = 1; k < 32; ++k)
        if (sigismember(&action[s].sa_mask, k) != sigismember(&o.action[s].sa_mask, k)) return false;
    }
    return true;
  }
};

std::atomic<int> caught{0};
void on_signal(int, siginfo_t *, void *) { ++caught; }

void set_handlers() {
  struct sigaction mine;
  std::memset(&mine, 0, sizeof mine);
  mine.sa_sigaction = on_signal;
  mine.sa_flags = SA_SIGINFO | SA_RESTART;
  sigaddset(&mine.sa_mask, SIGUSR2);
  for (const int s : {SIGTERM, SIGABRT, SIGUSR1}) sigaction(s, &mine, nullptr);
  signal(SIGHUP, SIG_IGN);
}

// What the host has set, and what its callbacks must find.
struct Host {
  const char *name = "";
  std::function<void()> set;
};
std::vector<Host> hosts() {
  std::vector<Host> all = {
      {"nothing", [] {}},
      {"upward", [] { fesetround(FE_UPWARD); }},
      {"downward", [] { fesetround(FE_DOWNWARD); }},
      {"towards zero", [] { fesetround(FE_TOWARDZERO); }},
      {"traps", [] { feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW); }},
      {"all traps", [] { feenableexcept(FE_ALL_EXCEPT); }},
      {"raised flags", [] { feraiseexcept(FE_ALL_EXCEPT); }},
      {"handlers of signals", set_handlers},
  };
#if defined(__x86_64__)
  all.push_back({"denormal numbers are zero", [] { _mm_setcsr(_mm_getcsr() | 0x8040); }});
  all.push_back({"x87 with 53 bits", [] {
                   const unsigned short word = 0x27f;
                   asm volatile("fldcw %0" ::"m"(word));
                 }});
#endif
  return all;
}

struct Seen {
  Environment expected;
  int calls = 0, wrong = 0;
};
int on_progress(const jam_progress *, void *user) {
  Seen &seen = *static_cast<Seen *>(user);
  ++seen.calls;
  seen.wrong += !(Environment() == seen.expected);
  return 0;
}
void on_log(int32_t, const char *, void *user) { on_progress(nullptr, user); }

// Every kind of work, on one thread and on two; the numbers that came out.
struct Work {
  std::vector<double> numbers;
  Environment host;
  std::vector<const char *> changed;

  void call(const char *name, const std::function<jam_status()> &f) {
    std::srand(11);
    const int drawn = std::rand();
    std::srand(11);
    const jam_status status = f();
    numbers.push_back(status);
    if (!(Environment() == host) || std::rand() != drawn) changed.push_back(name);
  }
  void keep(jam_system *sys) {
    const double *view = nullptr;
    size_t len = 0;
    call("jam_view", [&] { return jam_view(sys, JAM_VIEW_POSITIONS, &view, &len); });
    numbers.insert(numbers.end(), view, view + len);
  }
};

constexpr int spheres = 32;
constexpr size_t room = 20000;

void life(Work &w, Seen &seen, int dim, int model) {
  OWNED jam_system *sys = nullptr;
  jam_create_options o;
  w.call("jam_create_options_init", [&] { return jam_create_options_init(&o, sizeof o); });
  o.dim = dim, o.n = spheres, o.seed = 3, o.model = model, o.packing_fraction = dim == 2 ? 0.3 : 0.2;
  w.call("jam_create", [&] { return jam_create(&o, nullptr, &sys); });
  w.keep(sys);
  jam_set_progress(sys, on_progress, &seen);
  jam_set_log(sys, on_log, JAM_LOG_DEBUG, &seen);
  DEFAULTS(compress, grow);
  grow.pressure = 1e3;
  w.call("jam_compress", [&] { return jam_compress(sys, &grow, nullptr); });
  w.keep(sys);
  for (const int threads : {1, 2}) {
    DEFAULTS(crunch, crunch);
    crunch.threads = threads;
    OWNED jam_system *copy = nullptr;
    w.call("jam_copy", [&] { return jam_copy(sys, &copy); });
    jam_set_progress(copy, on_progress, &seen);
    jam_set_log(copy, on_log, JAM_LOG_DEBUG, &seen);
    w.call("jam_crunch", [&] { return jam_crunch(copy, &crunch, nullptr); });
    w.keep(copy);
    size_t needed = 0;
    std::vector<double> table(room);
    w.call("jam_modes", [&] {
      return jam_modes(copy, nullptr, nullptr, JAM_MODE_COLUMNS, table.data(), room, nullptr, 0, &needed);
    });
    w.call("jam_rigidity", [&] { return jam_rigidity(copy, JAM_RIGIDITY_STRICT, nullptr); });
    SIZED(jam_proof_report, proof);
    w.call("jam_prove", [&] { return jam_prove(copy, JAM_RIGIDITY_COLLECTIVE, nullptr, 0, &proof); });
    w.numbers.insert(w.numbers.end(), {proof.radius, proof.least_force, proof.fraction_error});
    const size_t len = static_cast<size_t>(spheres * dim);
    std::vector<double> parts(2 * len);
    w.call("jam_refined_positions", [&] {
      return jam_refined_positions(copy, nullptr, 0, parts.data(), len, parts.data() + len, len, nullptr);
    });
    w.numbers.insert(w.numbers.end(), parts.begin(), parts.end());
  }
  DEFAULTS(isoconf, runs);
  runs.runs = 4, runs.threads = 2, runs.density_ratio = 0.9;
  const double instant = 2.0;
  w.call("jam_isoconf", [&] { return jam_isoconf(sys, &runs, nullptr, &instant, 1, nullptr, 0, nullptr); });
  DEFAULTS(monte_carlo, mc);
  mc.sweeps = 10;
  if (model == JAM_MODEL_EUCLID) w.call("jam_monte_carlo", [&] { return jam_monte_carlo(sys, &mc, nullptr); });
  w.keep(sys);
  w.call("jam_scale_diameters", [&] { return jam_scale_diameters(sys, std::numeric_limits<double>::quiet_NaN()); });
}

void soft_life(Work &w) {
  OWNED jam_system *sys = nullptr;
  DEFAULTS(create, o);
  o.n = spheres, o.packing_fraction = 0.75, o.overlap = JAM_OVERLAP_ALLOW;
  w.call("jam_create", [&] { return jam_create(&o, nullptr, &sys); });
  w.call("jam_decompress", [&] { return jam_decompress(sys, nullptr, nullptr); });
  w.keep(sys);
}

// Two pairs that overlap, one through the boundary of the box: refused in every rounding mode.
void overlaps(Work &w) {
  const double inside[6] = {.1, .1, .1, .15, .1, .1}, across[6] = {.05, .5, .5, .95, .5, .5}, diameter = 0.2;
  for (const double *x : {inside, across}) {
    jam_system *sys = nullptr;
    const jam_status status = create_from(nullptr, x, 6, &diameter, 1, &sys);
    w.numbers.push_back(status);
    assert_int_equal(status, JAM_E_OVERLAP);
  }
}

Work work_of(const Host &host) {
  fesetenv(FE_DFL_ENV);
  feclearexcept(FE_ALL_EXCEPT);
  host.set();
  Work w;
  w.host = Environment();
  Seen seen;
  seen.expected = w.host;
  overlaps(w);
  life(w, seen, 3, JAM_MODEL_EUCLID);
  life(w, seen, 2, JAM_MODEL_EUCLID);
  life(w, seen, 3, JAM_MODEL_MK);
  soft_life(w);
  const Environment left;
  fesetenv(FE_DFL_ENV);
  for (const char *name : w.changed) print_message("host with %s: %s changed the environment\n", host.name, name);
  if (!(left == w.host) || !w.changed.empty()) fail_msg("host with %s: its environment changed", host.name);
  assert_true(seen.calls > 10);
  if (seen.wrong) fail_msg("host with %s: %d of %d callbacks found another", host.name, seen.wrong, seen.calls);
  return w;
}

// Results beside another thread, which raises signals and draws random numbers.
std::vector<double> results_beside(bool thread) {
  std::atomic<bool> stop{false};
  std::thread host([&] {
    while (thread && !stop) {
      std::rand();
      raise(SIGTERM);
      raise(SIGHUP);
      std::srand(static_cast<unsigned>(std::rand()));
      std::this_thread::yield();
    }
  });
  OWNED jam_system *sys = random_spheres(3, 100, 0.3, 4);
  run(sys, 5.0);
  assert_int_equal(jam_crunch(sys, nullptr, nullptr), JAM_OK);
  stop = true;
  host.join();
  const double *const x = view_of(sys, JAM_VIEW_POSITIONS);
  const std::vector<double> out(x, x + 300);
  return out;
}

CASE(signals_and_random_numbers_of_other_threads_change_no_bit) {
  set_handlers();
  assert_true(results_beside(true) == results_beside(false));
  assert_true(caught > 0);
}

CASE(no_host_changes_a_bit) {
  const std::vector<Host> all = hosts();
  const Work plain = work_of(all[0]);
  for (const Host &host : all) {
    const Work w = work_of(host);
    assert_int_equal(w.numbers.size(), plain.numbers.size());
    if (std::memcmp(w.numbers.data(), plain.numbers.data(), w.numbers.size() * sizeof(double)) != 0)
      fail_msg("host with %s: other results", host.name);
  }
}

// What a callback does to the host's environment stays.
int set_upward(const jam_progress *, void *) {
  fesetround(FE_UPWARD);
  return 0;
}

CASE(callbacks_change_the_environment_of_the_host) {
  DEFAULTS(create, o);
  o.n = 64;
  OWNED jam_system *sys = created(&o);
  jam_set_progress(sys, set_upward, nullptr);
  assert_int_equal(jam_crunch(sys, nullptr, nullptr), JAM_OK);
  const int rounding = fegetround();
  fesetenv(FE_DFL_ENV);
  assert_int_equal(rounding, FE_UPWARD);
}

}  // namespace
