// One dynamics in windows of time on two slabs, made of the parts of the engine.
//
// The box is cut in two slabs by the cells in which lists have their centres; cells are as wide as the longest list.
// In a window each slab makes its events in order of time but those near the other slab, and those near a sphere whose
// event was put off: they are put off too. Then the events that were put off are made in order, those around one
// boundary beside those around the other. An event late in the window may have read what an event that was put off
// changes at an earlier time. This shows in the times of its neighbours; such a window has to be made again by one
// thread. Collisions are noted, and their sums taken in order at the end. What an event changes is noted before it.
#pragma once
#include <algorithm>
#include <cstring>
#include <vector>

#include "engine_parts.hpp"

namespace jam::inside {

// The cells, and which of them wait in the present window.
struct Map {
  int64_t side;
  std::vector<int32_t> of;              // cell of each sphere
  std::vector<uint32_t> waits, source;  // the window in which a cell waits; in which an event of it was put off
  uint32_t window = 0;

  explicit Map(const Parts &p) : of(p.spheres.body.size()) {
    const double longest = 2.0 * *std::max_element(p.lists.rho.begin(), p.lists.rho.end()) * 0x1p-64;
    side = static_cast<int64_t>(1.0 / longest) / 2 * 2;
    waits.assign(static_cast<size_t>(side * side * side), 0);
    source = waits;
    for (size_t i = 0; i < of.size(); ++i) place(p, static_cast<int32_t>(i));
  }
  void place(const Parts &p, int32_t i) {
    int64_t cell = 0;
    for (const uint64_t x : p.lists.centre[i])
      cell = cell * side + static_cast<int64_t>((x >> 32) * static_cast<uint64_t>(side) >> 32);
    of[i] = static_cast<int32_t>(cell);
  }
  int64_t along(int32_t cell) const { return cell / (side * side); }
  int slab(int32_t i) const { return along(of[i]) >= side / 2; }
  // Cells between here and the nearest of the two boundaries, which has number 0 or 1.
  int64_t from_boundary(int32_t cell) const {
    const int64_t x = along(cell) % (side / 2);
    return std::min(x, side / 2 - 1 - x);
  }
  int boundary(int32_t cell) const {
    const int64_t x = along(cell);
    return x >= side / 4 && x < side - side / 4;
  }
  // f(cell) for a cell and the 26 around it.
  template <class F>
  void around(int32_t cell, F &&f) const {
    const int64_t c[3] = {cell / (side * side), cell / side % side, cell % side}, step[3] = {side * side, side, 1};
    int64_t at[3][3];
    for (int a = 0; a < 3; ++a)
      for (int k = 0; k < 3; ++k) at[a][k] = (c[a] + k + side - 1) % side * step[a];
    for (const int64_t x : at[0])
      for (const int64_t y : at[1])
        for (const int64_t z : at[2]) f(static_cast<size_t>(x + y + z));
  }
  bool free(int32_t i, bool exit) const {
    const int32_t cell = of[i];
    const int64_t far = from_boundary(cell);
    if (far < 1 + exit || waits[cell] == window) return false;
    bool clear = true;
    if (exit) around(cell, [&](size_t k) { clear &= waits[k] != window; });
    return clear;
  }
  void put_off(int32_t i) {
    const int32_t cell = of[i];
    if (source[cell] == window) return;
    source[cell] = window;
    const int64_t own = side * side * (side / 2) * slab(i);  // beyond the boundary cells wait anyhow
    around(cell, [&](size_t k) {
      if (k - static_cast<size_t>(own) < waits.size() / 2) waits[k] = window;
    });
  }
};

struct Entry {
  double time;
  int32_t sphere;
  bool operator<(const Entry &o) const { return time > o.time || (time == o.time && sphere > o.sphere); }
};

// Events up to the end of a window: those known at its begin in order, and a heap of those that come up in it. An event
// that no longer holds stays until its time comes.
class Queue {
 public:
  void begin() { known_.clear(), heap_.clear(), at_ = 0; }
  void know(const Entry &e) { known_.push_back(e); }
  void sort() {
    std::sort(known_.begin(), known_.end(), [](const Entry &a, const Entry &b) { return b < a; });
  }
  void push(const Entry &e) {
    heap_.push_back(e);
    std::push_heap(heap_.begin(), heap_.end());
  }
  bool pop(Entry &e) {
    const bool known = at_ < known_.size();
    if (!known && heap_.empty()) return false;
    if (known && (heap_.empty() || heap_[0] < known_[at_])) return e = known_[at_++], true;
    e = heap_[0];
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    return true;
  }
  int32_t ahead(size_t events) const { return at_ + events < known_.size() ? known_[at_ + events].sphere : -1; }

 private:
  std::vector<Entry> known_, heap_;
  size_t at_ = 0;
};

struct Collision {
  double time, virial, twice;
};
struct Before {  // of a sphere, to take an event back
  unsigned char body[sizeof(Body<3>)];
  Event event;
  double time;
  int32_t sphere;
};

// What one thread has: the queue of a slab and of a boundary, and its notes.
struct alignas(128) Worker {
  Parts p;
  Map *map;
  int number;
  std::vector<std::vector<Entry>> future[2];  // events of each window to come, by slab; those that no longer hold stay
  double first = 0.0, width = 0.0;            // windows count from here
  Queue queue[2];
  std::vector<Entry> off;
  std::vector<Collision> made[2][2];  // of each part, of even and odd windows
  std::vector<Before> before;
  std::vector<int32_t> lists_before;
  size_t window = 0;
  int64_t events = 0, put_off = 0, late = 0;

  Worker(Engine3 &e, Map &m, int k) : p(e), map(&m), number(k) {}

  void look_ahead(const Queue &q) const {
    if (const int32_t i = q.ahead(LookAhead::events); i >= 0) {
      prefetch(&p.calendar[i]);
      prefetch(&p.calendar.times()[i]);
      prefetch(&map->of[i]);
    }
    if (const int32_t i = q.ahead(LookAhead::bodies); i >= 0) {
      p.prefetch_lists(i);
      if (const int32_t k = p.calendar[i].partner; k >= 0) p.prefetch_lists(k), prefetch(&p.calendar[k]);
    }
    if (const int32_t i = q.ahead(LookAhead::neighbours); i >= 0) {
      p.prefetch_neighbours(i);
      if (const int32_t k = p.calendar[i].partner; k >= 0)
        p.prefetch_neighbours(k);
      else
        p.prefetch_search(i);
    }
  }
  static void prefetch(const void *at) { __builtin_prefetch(at); }
  void keep(int32_t i) {
    before.emplace_back();
    Before &b = before.back();
    std::memcpy(b.body, &p.spheres.body[i], sizeof b.body);
    b.event = p.calendar[i], b.time = p.calendar.time(i), b.sphere = i;
  }
  bool later(int32_t i) const {  // a neighbour has had an event that comes after this time
    bool any = false;
    for (int32_t e = 0; e < p.lists.count[i]; ++e) any |= p.spheres.body[p.lists.of(i)[e]].time > p.clock.now;
    return any;
  }
  void note(const Entry &e) {
    const double w = (e.time - first) / width;
    auto &of_slab = future[map->slab(e.sphere)];
    if (w < static_cast<double>(of_slab.size())) of_slab[static_cast<size_t>(w)].push_back(e);
  }
  void predict(int32_t i, Queue &q, double end) {
    p.predict(i);
    const Entry e{p.calendar.time(i), i};
    if (e.time < end)
      q.push(e);
    else
      note(e);
  }
  // The events of a slab (part 0) or of a boundary (part 1) before the end.
  void run(int part, double end) {
    Queue &q = queue[part];
    for (Entry e; q.pop(e);) {
      look_ahead(q);
      const int32_t i = e.sphere;
      if (p.calendar.time(i) != e.time) continue;
      const int32_t k = p.calendar[i].partner;
      if (part == 0 && !(map->free(i, k < 0) && (k < 0 || map->free(k, false)))) {
        map->put_off(i);
        if (k >= 0 && map->slab(k) == number) map->put_off(k);
        off.push_back(e);
        ++put_off;
        continue;
      }
      ++events;
      p.clock.now = std::max(p.clock.now, e.time);
      keep(i);
      const bool collides = k >= 0 && !p.stale(i);
      if (part == 1) {
        const auto amid = [&](int32_t j) { return map->from_boundary(map->of[j]) >= map->side / 4 - 1 - (k < 0); };
        late += later(i) || amid(i) || (collides && (later(k) || amid(k)));
      }
      p.move(i);
      if (k < 0) {
        ++p.pace.exits;
        lists_before.insert(lists_before.end(), p.lists.of(i), p.lists.of(i) + p.lists.count[i]);
        p.recentre(i);
        map->place(p, i);
        lists_before.insert(lists_before.end(), p.lists.of(i), p.lists.of(i) + p.lists.count[i]);
        if (part == 1) late += later(i);
      }
      if (!collides) {
        p.calendar.time(i) = never;
        predict(i, q, end);
        continue;
      }
      keep(k);
      p.move(k);
      double &virial = p.engine.sums.of_pressure.virial, &twice = p.kinetic.twice;
      virial = twice = 0.0;
      const int64_t collisions = p.engine.sums.collisions;
      p.collide(i, k);
      if (p.engine.sums.collisions != collisions) made[window % 2][part].push_back({p.clock.now, virial, twice});
      p.calendar.time(i) = p.calendar.time(k) = never;
      predict(i, q, end);
      predict(k, q, end);
    }
  }
};

}  // namespace jam::inside
