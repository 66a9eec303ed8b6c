// The private parts of the engine of equal spheres in d = 3, for benchmarks that do its steps in another order. An
// explicit instantiation may name private members (C++17, [temp.spec] 6), so the engine needs no hook.
#pragma once
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>
#include <vector>

#include "core/create.hpp"
#include "dynamics/event_driven/engine_of.hpp"
#include "dynamics/event_driven/options.hpp"

namespace jam::inside {

using Engine3 = EngineOf<3, Offsets::wrapped>;

template <class Name, auto Member>
struct Reach {
  friend constexpr auto reach(Name) { return Member; }
};
#define JAM_REACH(name)                     \
  struct name##_of {                        \
    friend constexpr auto reach(name##_of); \
  };                                        \
  template struct Reach<name##_of, &Engine3::name>
JAM_REACH(spheres_);
JAM_REACH(clock_);
JAM_REACH(kinetic_);
JAM_REACH(calendar_);
JAM_REACH(lists_);
JAM_REACH(levels_);
JAM_REACH(pace_);
JAM_REACH(found_);
JAM_REACH(turn_);
JAM_REACH(predict);
JAM_REACH(collide);
JAM_REACH(recentre);
JAM_REACH(next_event);
JAM_REACH(rebase);
JAM_REACH(prefetch_lists);
JAM_REACH(prefetch_neighbours);
JAM_REACH(prefetch_search);
#undef JAM_REACH

// References to them.
struct Parts {
  Engine3 &engine;
  Spheres<3> &spheres = engine.*reach(spheres__of{});
  Clock &clock = engine.*reach(clock__of{});
  Kinetic &kinetic = engine.*reach(kinetic__of{});
  Calendar &calendar = engine.*reach(calendar__of{});
  Lists<3, Offsets::wrapped> &lists = engine.*reach(lists__of{});
  Levels<3, Offsets::wrapped> &levels = engine.*reach(levels__of{});
  Pace &pace = engine.*reach(pace__of{});

  explicit Parts(Engine3 &e) : engine(e) {}
  void predict(int32_t i) { (engine.*reach(predict_of{}))(i); }
  void collide(int32_t i, int32_t k) { (engine.*reach(collide_of{}))(i, k); }
  void recentre(int32_t i) { (engine.*reach(recentre_of{}))(i); }
  void next_event(int32_t i) { (engine.*reach(next_event_of{}))(i); }
  void rebase() { (engine.*reach(rebase_of{}))(); }
  void prefetch_lists(int32_t i) const { (engine.*reach(prefetch_lists_of{}))(i); }
  void prefetch_neighbours(int32_t i) const { (engine.*reach(prefetch_neighbours_of{}))(i); }
  void prefetch_search(int32_t i) const { (engine.*reach(prefetch_search_of{}))(i); }
  void move(int32_t i) {  // as in engine_of.hpp
    Body<3> &b = spheres.body[i];
    const double dt = clock.now - b.time;
    for (int c = 0; c < 3; ++c) b.x[c] += static_cast<uint64_t>(std::llrint(b.v[c] * dt));
    b.time = clock.now;
  }
  bool stale(int32_t i) const {
    const Event &e = calendar[i];
    return e.partner >= 0 && calendar[e.partner].count != e.partner_count;
  }
  // The state of another engine of the same packing.
  void copy(const Parts &from) {
    spheres = from.spheres;
    clock = from.clock;
    kinetic = from.kinetic;
    calendar = from.calendar;
    lists = from.lists;
    levels = from.levels;
    pace = from.pace;
    engine.sums = from.engine.sums;
    engine.max_overlap = from.engine.max_overlap;
  }
};

// The engine once more for a second thread: spheres, events, lists and cells are those of the first, the present, the
// sums and scratch its own. Nothing may grow while it lives, and it is never destroyed.
class alignas(128) Twin {
 public:
  explicit Twin(Engine3 &first) {
    std::memcpy(static_cast<void *>(raw_), static_cast<const void *>(&first), sizeof raw_);
    Parts mine(engine()), other(first);
    new (&(engine().*reach(found__of{}))) std::vector<int32_t>(mine.spheres.body.size());
    new (&(engine().*reach(turn__of{}))) std::vector<int32_t>();
    auto *levels = new (&mine.levels) Levels<3, Offsets::wrapped>(other.levels);
    for (size_t k = 0; k < levels->all().size(); ++k) {
      const auto &cells = levels->all()[k].cells;
      std::memcpy(const_cast<void *>(static_cast<const void *>(&cells)), &other.levels.all()[k].cells, sizeof cells);
    }
  }
  Twin(const Twin &) = delete;
  Twin &operator=(const Twin &) = delete;
  Engine3 &engine() { return *reinterpret_cast<Engine3 *>(raw_); }

 private:
  alignas(Engine3) unsigned char raw_[sizeof(Engine3)];
};

inline double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline double wall_seconds() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
inline double quantile(std::vector<double> x, double q) {
  std::sort(x.begin(), x.end());
  return x[static_cast<size_t>(q * static_cast<double>(x.size() - 1))];
}
// To a processor: while other jobs run, the system puts two threads on one.
inline void pin(int processor) {
#ifdef __linux__
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(processor, &set);
  pthread_setaffinity_np(pthread_self(), sizeof set, &set);
#else
  (void)processor;
#endif
}

inline Packing fluid(int64_t n, double fraction) {
  Monitor monitor;
  monitor.begin();
  jam_create_options o = default_create_options();
  o.n = n;
  o.dim = 3;
  o.packing_fraction = 0.25;
  Packing p = make_packing(o, nullptr, 0, nullptr, 0);
  jam_md_report report{};
  run_stage(p, {0.1, 1e12, fraction, never, never}, monitor, report);
  return p;
}

}  // namespace jam::inside
