// What two and four threads could gain for one dynamics, from the events of a real run: md_threads [N...]: JSON to
// stdout. Per packing fraction: the longest chain of events that need each other; slabs that wait for each other at
// every event which reads or writes spheres of another slab; predictions made ahead for the next events of the
// calendar. With times of this machine: of an event, of a prediction, of a flag and of lines of the cache that pass
// from one processor to another.
#include <array>
#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

#include "engine_parts.hpp"

using namespace jam::inside;

// Seconds for a flag to pass from one thread to another with so many lines of data, which the one writes and the other
// reads and writes, at random places of 4 MB. Of many short rounds the quantile of a tenth, as other jobs interrupt.
static double hand_over(size_t lines) {
  constexpr uint64_t rounds = 400, passes = 100, places = 1 << 16;
  struct alignas(64) Line {
    std::atomic<uint64_t> word{0};
  };
  std::vector<Line> data(places), flag(1);
  const auto play = [&](uint64_t me, std::vector<double> *times) {
    pin(static_cast<int>(me));
    for (uint64_t r = 0, turn = me; r < rounds; ++r) {
      const double t = wall_seconds();
      for (uint64_t k = 0; k < passes; ++k, turn += 2) {
        for (int spin = 0; flag[0].word.load(std::memory_order_acquire) != turn; ++spin)
          if (spin > 100000) std::this_thread::yield();
        for (size_t l = 0; l < lines; ++l)
          data[(l + 1) * 40503 % places].word.store(turn + data[(l + 1) * 40503 % places].word,
                                                    std::memory_order_relaxed);
        flag[0].word.store(turn + 1, std::memory_order_release);
      }
      if (times) times->push_back((wall_seconds() - t) / static_cast<double>(2 * passes));
    }
  };
  std::vector<double> times;
  std::thread other([&] { play(1, nullptr); });
  std::thread first([&] { play(0, &times); });
  first.join();
  other.join();
  return quantile(times, 0.1);
}

// Slabs along the first axis by the place of the list. An event that reads or writes in another slab begins when both
// have done all earlier events, and the other goes on after it.
struct Slabs {
  int count;
  double cost, synchronise;
  std::vector<double> clock;
  int64_t across = 0;
  Slabs(int n, double event, double s) : count(n), cost(event), synchronise(s), clock(static_cast<size_t>(n), 0.0) {}
  size_t of(uint64_t x) const { return static_cast<size_t>((x >> 32) * static_cast<uint64_t>(count) >> 32); }
  void event(size_t own, uint64_t touched) {
    touched |= uint64_t{1} << own;
    if (touched == uint64_t{1} << own) {
      clock[own] += cost;
      return;
    }
    ++across;
    double start = 0.0;
    for (size_t k = 0; k < clock.size(); ++k)
      if (touched >> k & 1) start = std::max(start, clock[k]);
    for (size_t k = 0; k < clock.size(); ++k)
      if (touched >> k & 1) clock[k] = start + synchronise + cost;
  }
  double gain(int64_t events) const {
    return static_cast<double>(events) * cost / *std::max_element(clock.begin(), clock.end());
  }
};

struct Trace {
  static constexpr std::array<int64_t, 6> ahead{1, 2, 4, 8, 16, 32};
  int64_t events = 0, collisions = 0, exits = 0, stale = 0, reads = 0;
  int64_t chain = 0;               // longest
  std::array<int64_t, 6> valid{};  // predictions made so many events ahead that no later event spoils
  std::vector<Slabs> slabs;
};

// Events one by one, as Engine::advance makes them.
template <class F>
static void each_event(Parts &p, int64_t events, F &&f) {
  for (int64_t done = 0; done < events;) {
    ++p.engine.sums.events;
    const int32_t i = p.calendar.top();
    if (i < 0 || p.engine.sums.events > p.pace.rebase_at) {
      p.rebase();
      continue;
    }
    f(i);
    ++done;
  }
}

static void trace(Parts &p, int64_t events, Trace &t) {
  const size_t n = p.spheres.body.size();
  struct Last {
    int64_t level = 0, read = 0, written = -1000000, list = 0;  // of the last event that did it
  };
  std::vector<Last> last(n);
  each_event(p, events, [&](int32_t i) {
    const bool stale = p.stale(i), exit = p.calendar[i].partner < 0;
    const int32_t k = exit || stale ? -1 : p.calendar[i].partner;
    int64_t level = std::max({last[i].level, last[i].read, last[i].list}), written = last[i].written;
    std::vector<uint64_t> touched(t.slabs.size(), 0);
    const auto read = [&](int32_t l) {
      level = std::max(level, last[l].level);
      written = std::max(written, last[l].written);
      for (size_t s = 0; s < touched.size(); ++s) touched[s] |= uint64_t{1} << t.slabs[s].of(p.lists.centre[l][0]);
      ++t.reads;
    };
    const auto each = [&](auto &&f) {
      for (const int32_t a : {i, k})
        for (int32_t e = 0; a >= 0 && e < p.lists.count[a]; ++e) f(p.lists.of(a)[e]);
    };
    std::vector<size_t> own;
    for (const Slabs &s : t.slabs) own.push_back(s.of(p.lists.centre[i][0]));
    each(read);
    if (k >= 0) level = std::max({level, last[k].read, last[k].list});
    if (exit) each([&](int32_t l) { level = std::max(level, last[l].list); });
    p.next_event(i);
    if (exit) each(read);
    ++level;
    each([&](int32_t l) {
      last[l].read = std::max(last[l].read, level);
      if (exit) last[l].list = level;
    });
    for (const int32_t a : {i, k})
      if (a >= 0) last[a].level = level, last[a].written = t.events;
    for (size_t s = 0; s < t.slabs.size(); ++s) t.slabs[s].event(own[s], touched[s]);
    for (size_t m = 0; m < t.ahead.size(); ++m) t.valid[m] += written < t.events - t.ahead[m];
    t.chain = std::max(t.chain, level);
    t.exits += exit;
    t.stale += stale;
    t.collisions += k >= 0;
    ++t.events;
  });
}

// Seconds of thread time: of an event as it is, and of the prediction of a sphere whose neighbours are in the cache.
static std::array<double, 2> times(Parts &p, const Monitor &monitor) {
  std::vector<double> event, prediction;
  for (int round = 0; round < 9; ++round) {
    const int64_t before = p.engine.sums.events;
    double t = thread_seconds();
    p.engine.advance(40000, monitor);
    event.push_back((thread_seconds() - t) / static_cast<double>(p.engine.sums.events - before));
    double sum = 0.0;
    int64_t made = 0;
    each_event(p, 2000, [&](int32_t i) {
      p.next_event(i);
      // Of a later state of the partner the same sphere may get another event, so its own is put back.
      const Event own = p.calendar[i];
      const double when = p.calendar.time(i);
      p.predict(i);
      t = thread_seconds();
      for (int k = 0; k < 20; ++k) p.predict(i);
      sum += thread_seconds() - t;
      p.calendar[i] = own;
      p.calendar.time(i) = when;
      made += 20;
    });
    prediction.push_back(sum / static_cast<double>(made));
  }
  return {quantile(event, 0.5), quantile(prediction, 0.5)};
}

int main(int argc, char **argv) {
  std::vector<int64_t> sizes;
  for (int k = 1; k < argc; ++k) sizes.push_back(std::atoll(argv[k]));
  if (sizes.empty()) sizes = {10000, 100000};
  Monitor monitor;
  monitor.begin();
  const double flag = hand_over(0), line = (hand_over(16) - flag) / 16.0;
  std::printf("{\"flag_ns\": %.1f, \"line_ns\": %.1f, \"runs\": [", 1e9 * flag, 1e9 * line);
  const char *comma = "";
  for (const int64_t n : sizes)
    for (const double fraction : {0.48, 0.6}) {
      const Packing packing = fluid(n, fraction);
      Engine3 engine(packing, EngineOptions{});
      Parts p(engine);
      engine.advance(20 * n, monitor);
      const auto [event, prediction] = times(p, monitor);
      Trace t;
      for (const int slabs : {2, 4}) t.slabs.emplace_back(slabs, event, flag);
      for (const int slabs : {2, 4}) t.slabs.emplace_back(slabs, event, 0.0);
      trace(p, 400000, t);
      const auto share = [&](int64_t count) { return static_cast<double>(count) / static_cast<double>(t.events); };
      std::printf(
          "%s\n {\"n\": %lld, \"packing_fraction\": %g, \"event_ns\": %.1f, \"prediction_ns\": %.1f, \"exits\": %.4f, "
          "\"stale\": %.4f, \"reads\": %.1f, \"chain\": %lld, \"parallel\": %.1f, \"slabs\": [",
          comma, static_cast<long long>(n), fraction, 1e9 * event, 1e9 * prediction, share(t.exits), share(t.stale),
          share(t.reads), static_cast<long long>(t.chain),
          static_cast<double>(t.events) / static_cast<double>(t.chain));
      for (size_t s = 0; s < t.slabs.size(); ++s)
        std::printf("%s{\"threads\": %d, \"synchronise_ns\": %.1f, \"across\": %.4f, \"gain\": %.3f}", s ? ", " : "",
                    t.slabs[s].count, 1e9 * t.slabs[s].synchronise, share(t.slabs[s].across),
                    t.slabs[s].gain(t.events));
      std::printf("], \"valid\": {");
      for (size_t m = 0; m < t.ahead.size(); ++m)
        std::printf("%s\"%lld\": %.4f", m ? ", " : "", static_cast<long long>(t.ahead[m]), share(t.valid[m]));
      std::printf("}}");
      comma = ",";
      std::fflush(stdout);
    }
  std::printf("]}\n");
  return 0;
}
