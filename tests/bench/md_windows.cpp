// One dynamics on two threads in windows of time (time_windows.hpp), compared with the engine bit by bit: md_windows N
// PHI WINDOWS EVENTS: JSON to stdout. EVENTS: of a sphere in a window. First the two threads one after the other on one
// processor, then on two, which end with the same bits unless events around the two boundaries meet in the
// middle of a slab, then in turn beside the engine, window by window.
#include <atomic>
#include <cstdio>
#include <thread>

#include "time_windows.hpp"

using namespace jam::inside;

// Whether both engines have the same bits.
static bool same(const Parts &a, const Parts &b) {
  const size_t n = a.spheres.body.size();
  bool equal = a.engine.sums.collisions == b.engine.sums.collisions && a.pace.exits == b.pace.exits &&
               a.engine.sums.of_pressure.virial == b.engine.sums.of_pressure.virial &&
               a.engine.sums.of_pressure.kinetic_integral == b.engine.sums.of_pressure.kinetic_integral &&
               a.kinetic.twice == b.kinetic.twice && a.lists.centre == b.lists.centre;
  for (int32_t i = 0; equal && i < static_cast<int32_t>(n); ++i) {
    const Event &e = a.calendar[i], &f = b.calendar[i];
    equal = std::memcmp(&a.spheres.body[i], &b.spheres.body[i], sizeof(Body<3>)) == 0 &&
            a.calendar.time(i) == b.calendar.time(i) && e.partner == f.partner && e.count == f.count &&
            (e.partner < 0 || e.partner_count == f.partner_count) && a.lists.count[i] == b.lists.count[i] &&
            std::equal(a.lists.of(i), a.lists.of(i) + a.lists.count[i], b.lists.of(i));
  }
  return equal;
}

// What each thread does in a window: its slab, then its boundary.
static void slab_part(Worker *all, int number, double start, double end, size_t index) {
  Worker &w = all[number];
  w.off.clear();
  w.before.clear();
  w.lists_before.clear();
  w.late = 0;
  for (int part : {0, 1}) w.queue[part].begin(), w.made[index % 2][part].clear();
  w.window = index;
  for (int from : {0, 1})
    for (const Entry &e : all[from].future[number][index])
      if (w.p.calendar.time(e.sphere) == e.time) w.queue[0].know(e);
  w.queue[0].sort();
  w.p.clock.now = start;
  w.run(0, end);
}
static void boundary_part(Worker *w, int number, double start, double end) {
  Worker &own = w[number];
  for (int from : {0, 1})
    for (const Entry &e : w[from].off)
      if (own.map->boundary(own.map->of[e.sphere]) == number) own.queue[1].know(e);
  own.queue[1].sort();
  own.p.clock.now = start;
  own.run(1, end);
}
// Pressure and kinetic energy as one thread would have summed them.
struct Sums {
  Kinetic kinetic;
  PressureSums of_pressure;
  explicit Sums(const Parts &p) : kinetic(p.kinetic), of_pressure(p.engine.sums.of_pressure) {}
  void add(const Worker *w, size_t index) {  // the four lists of collisions in order
    const auto &a = w[0].made[index % 2], &b = w[1].made[index % 2];
    const std::vector<Collision> *list[4] = {&a[0], &a[1], &b[0], &b[1]};
    size_t next[4] = {};
    for (;;) {
      const Collision *first = nullptr;
      int from = 0;
      for (int k = 0; k < 4; ++k)
        if (next[k] < list[k]->size() && (!first || (*list[k])[next[k]].time < first->time))
          first = &(*list[k])[next[k]], from = k;
      if (!first) break;
      ++next[from];
      of_pressure.virial += first->virial;
      of_pressure.kinetic_integral += kinetic.integral_to(first->time);
      kinetic.since = first->time;
      kinetic.twice += first->twice;
    }
  }
  void put(Parts &p) const {
    p.kinetic = kinetic;
    p.engine.sums.of_pressure = of_pressure;
  }
};

class Barrier {
 public:
  void wait() {
    const int turn = turn_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) == 1) {
      arrived_.store(0, std::memory_order_relaxed);
      turn_.store(turn + 1, std::memory_order_release);
      return;
    }
    for (int k = 0; turn_.load(std::memory_order_acquire) == turn; ++k)
      if (k > 20000) std::this_thread::yield();
  }

 private:
  alignas(64) std::atomic<int> arrived_{0};
  alignas(64) std::atomic<int> turn_{0};
};

// The windows on two threads. Seconds of thread time of each part in each window, and of the clock on the wall.
struct Raced {
  std::vector<double> part[2][2], wall;
  double longer() const {
    double sum = 0.0;
    for (int k : {0, 1})
      for (size_t i = 0; i < wall.size(); ++i) sum += std::max(part[0][k][i], part[1][k][i]);
    return sum;
  }
};
static Raced race(Worker *w, Map &map, size_t windows, double first, double width) {
  Raced r;
  Sums sums(w[0].p);
  Barrier barrier;
  const auto run = [&](int s) {
    pin(s);
    for (auto &x : r.part[s]) x.reserve(windows);
    for (size_t k = 0; k < windows; ++k) {
      const double start = first + static_cast<double>(k) * width, end = first + static_cast<double>(k + 1) * width;
      const double begun = wall_seconds();
      double at = thread_seconds();
      const auto lap = [&](int part) {
        r.part[s][part].push_back(thread_seconds() - at);
        barrier.wait();
        at = thread_seconds();
      };
      map.window = static_cast<uint32_t>(k + 1);
      if (k > 0 && s == static_cast<int>(k % 2)) sums.add(w, k - 1);
      slab_part(w, s, start, end, k);
      lap(0);
      boundary_part(w, s, start, end);
      lap(1);
      if (s == 0) r.wall.push_back(wall_seconds() - begun);
    }
  };
  std::thread other([&] { run(1); });
  run(0);
  other.join();
  sums.add(w, windows - 1);
  sums.put(w[0].p);
  return r;
}

// What a run of one thread gives, to be repeated in windows.
struct Run {
  const Parts &begin;
  size_t windows;
  double first, width;
  double end(size_t k) const { return first + static_cast<double>(k + 1) * width; }
  void notes(Parts &p, const Map &map, Worker *w, size_t from) const {
    for (int s : {0, 1})
      for (auto &f : w[s].future) f.assign(windows, {}), w[s].first = first, w[s].width = width;
    for (int32_t i = 0; i < p.spheres.n; ++i)
      if (const double t = p.calendar.time(i); from == 0 || t >= end(from - 1)) w[map.slab(i)].note({t, i});
  }
};

// One window on one processor; seconds of the longer of each two parts.
static double window(Worker *w, const Run &run, size_t k) {
  Sums sums(w[0].p);
  const double start = run.first + static_cast<double>(k) * run.width;
  w[0].map->window = static_cast<uint32_t>(k + 1);
  double at = thread_seconds(), part[2][2];
  const auto lap = [&] {
    const double before = at;
    at = thread_seconds();
    return at - before;
  };
  for (int s : {0, 1}) slab_part(w, s, start, run.end(k), k), part[0][s] = lap();
  for (int s : {0, 1}) boundary_part(w, s, start, run.end(k)), part[1][s] = lap();
  sums.add(w, k);
  sums.put(w[0].p);
  return std::max(part[0][0], part[0][1]) + std::max(part[1][0], part[1][1]) + lap();
}

int main(int argc, char **argv) {
  if (argc != 5) return std::fprintf(stderr, "usage: md_windows N PHI WINDOWS EVENTS\n"), 1;
  const int64_t n = std::atoll(argv[1]);
  const double fraction = std::atof(argv[2]), share = std::atof(argv[4]);
  Monitor monitor;
  monitor.begin();
  const Packing packing = fluid(n, fraction);
  Engine3 begin(packing, EngineOptions{}), one(packing, EngineOptions{}), two(packing, EngineOptions{}),
      kept(packing, EngineOptions{});
  begin.advance(20 * n, monitor);
  for (const double t = begin.sums.time; begin.sums.time == t;) begin.advance(1000, monitor);
  Parts b(begin), p(one), q(two), in_turn_end(kept);
  const Run run{b, static_cast<size_t>(std::atoll(argv[3])), b.clock.now,
                b.pace.bucket_width * share * static_cast<double>(n)};
  const auto alone = [&](size_t k) {
    p.clock.time_end = run.end(k);
    const double t = thread_seconds();
    one.advance(int64_t{1} << 60, monitor);
    return thread_seconds() - t;
  };
  p.copy(b);
  double one_thread = 0.0, in_turn = 0.0;
  std::vector<double> one_wall;
  pin(0);
  for (size_t k = 0; k < run.windows; ++k) {
    const double t = wall_seconds();
    one_thread += alone(k);
    one_wall.push_back(wall_seconds() - t);
  }
  const double total = static_cast<double>(one.sums.events - begin.sums.events);
  const auto blocks = [](const Parts &x) {
    size_t sum = 0;
    for (const auto &level : x.levels.all()) sum += level.cells.block.size();
    return sum;
  };
  if (one.sums.time != begin.sums.time || p.lists.capacity != b.lists.capacity || blocks(p) != blocks(b))
    return std::fprintf(stderr, "the origin of time moves, or lists or cells grow: fewer windows\n"), 1;
  Raced raced;
  bool same_bits[2];
  int64_t put_off = 0;
  {
    q.copy(b);
    Map map(q);
    Worker w[2] = {Worker(two, map, 0), Worker(two, map, 1)};
    run.notes(q, map, w, 0);
    for (size_t k = 0; k < run.windows; ++k) in_turn += window(w, run, k);
    same_bits[0] = same(p, q);
    in_turn_end.copy(q);
    put_off = w[0].put_off + w[1].put_off;
  }
  {
    q.copy(b);
    Map map(q);
    Twin twin(two);
    Worker w[2] = {Worker(two, map, 0), Worker(twin.engine(), map, 1)};
    run.notes(q, map, w, 0);
    raced = race(w, map, run.windows, run.first, run.width);
    two.sums.collisions += twin.engine().sums.collisions - begin.sums.collisions;
    q.pace.exits += w[1].p.pace.exits - b.pace.exits;
    same_bits[1] = same(in_turn_end, q);
  }
  int late = 0, differ = 0, unseen = 0;
  p.copy(b);
  q.copy(b);
  Map map(q);
  Worker w[2] = {Worker(two, map, 0), Worker(two, map, 1)};
  run.notes(q, map, w, 0);
  for (size_t k = 0; k < run.windows; ++k) {
    window(w, run, k);
    alone(k);
    const bool is_late = w[0].late + w[1].late > 0, equal = same(p, q);
    late += is_late;
    differ += !equal;
    unseen += !equal && !is_late;
    if (equal) continue;
    q.copy(p);
    for (int32_t i = 0; i < q.spheres.n; ++i) map.place(q, i);
    run.notes(q, map, w, k + 1);
  }
  const auto wall_gain = [&](double x) { return quantile(one_wall, x) / quantile(raced.wall, x); };
  std::printf(
      "{\"n\": %lld, \"packing_fraction\": %g, \"windows\": %zu, \"events_per_sphere\": %g, \"put_off\": %.4f, "
      "\"late\": %d, \"differ\": %d, \"unseen\": %d, \"in_turn_same_after_all\": %d, \"two_cores_as_in_turn\": %d, "
      "\"one_thread_ns\": %.1f, "
      "\"in_turn_ns\": %.1f, \"two_threads_ns\": %.1f, \"wall_gain\": [%.3f, %.3f, %.3f]}\n",
      static_cast<long long>(n), fraction, run.windows, share, static_cast<double>(put_off) / total, late, differ,
      unseen, same_bits[0], same_bits[1], 1e9 * one_thread / total, 1e9 * in_turn / total, 1e9 * raced.longer() / total,
      wall_gain(0.02), wall_gain(0.1), wall_gain(0.5));
  return 0;
}
