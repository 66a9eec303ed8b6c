// The event calendar: one event for each sphere, sorted into buckets of equal time width. Only the current bucket is a
// heap. Inserting, moving and removing cost O(1) while the width suits the rate of events (Paul, J. Comput. Phys. 221,
// 615 (2007)); a bad width costs O(log n). Of events at one time the sphere with the lower number comes first, so the
// order follows from the times alone and is not part of a checkpoint.
#pragma once
#include <limits>

#include "core/archive.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

constexpr double never = std::numeric_limits<double>::infinity();

// What happens to a sphere next; the time is stored apart, so that many times fit into a line of the cache.
struct Event {
  int32_t partner = -1;                   // sphere to collide with; -1: leaves its safe sphere; -2 - w: meets wall w
  uint32_t partner_count = 0, count = 0;  // collisions of the partner when this was predicted; own collisions
  int32_t next = -1, prev = -1, where = nowhere;  // bucket >= 0, or nowhere, or heap_base - place in the heap
  static constexpr int32_t nowhere = -1, heap_base = -2;
};

class Calendar {
 public:
  explicit Calendar(size_t n) : time_(n, never), event_(n), heads_(CalendarTuning::buckets_per_sphere * n + 2, -1) {}

  Event &operator[](int32_t i) { return event_[i]; }
  const Event &operator[](int32_t i) const { return event_[i]; }
  double &time(int32_t i) { return time_[i]; }
  double time(int32_t i) const { return time_[i]; }
  const double *times() const { return time_.data(); }

  // Sorts all events again; times start at `now`, a bucket is `width` long.
  void rebuild(double now, double width) {
    for (int32_t &h : heads_) h = -1;
    heap_.clear();
    start_ = now;
    inverse_ = width > 0.0 && width < never ? 1.0 / width : 0.0;
    current_ = 0;
    for (int32_t i = 0; i < static_cast<int32_t>(event_.size()); ++i) event_[i].where = Event::nowhere, insert(i);
  }
  // The time of a sphere may change while it is out, or before update(). Take both of two spheres out before either
  // time changes: a heap that holds a time in the wrong place loses its order.
  void take_out(int32_t i) { remove(i); }
  void put_in(int32_t i) { insert(i); }
  void update(int32_t i) {
    remove(i);
    insert(i);
  }
  // Sphere of the earliest event; -1 when the buckets are used up: rebuild then. Calls next_bucket() whenever it goes
  // on to the next bucket.
  template <class F>
  int32_t top(F &&next_bucket) {
    while (heap_.empty()) {
      if (current_ + 1 >= last_bucket()) return -1;
      ++current_;
      next_bucket();
      for (int32_t i = heads_[current_], next; i >= 0; i = next) {
        next = event_[i].next;
        heap_push(i);
      }
      heads_[current_] = -1;
    }
    return heap_[0];
  }
  int32_t top() {
    return top([] {});
  }
  // The events of a bucket that comes later: f(sphere, event) for each, or the first sphere alone (-1: none).
  template <class F>
  void each_ahead(int32_t buckets, F &&f) const {
    for (int32_t i = first_ahead(buckets); i >= 0; i = event_[i].next) f(i, event_[i]);
  }
  int32_t first_ahead(int32_t buckets) const {
    return current_ + buckets < last_bucket() ? heads_[static_cast<size_t>(current_ + buckets)] : -1;
  }
  // Events later than this are not in the buckets.
  double horizon() const { return inverse_ > 0.0 ? start_ + static_cast<double>(last_bucket()) / inverse_ : never; }
  size_t buckets() const { return heads_.size() - 1; }

  void archive(Archive &a, int walls) {
    const size_t n = event_.size();
    a(time_);
    a(event_);
    a(start_);
    a(inverse_);
    a(current_);
    if (!a.reading()) return;
    Archive::check(time_.size() == n && event_.size() == n && current_ >= 0 && current_ <= last_bucket() &&
                   inverse_ >= 0.0 && inverse_ < never);
    for (int32_t &h : heads_) h = -1;
    heap_.clear();
    for (int32_t i = 0; i < static_cast<int32_t>(n); ++i) {
      Archive::check(event_[i].partner >= -1 - walls && event_[i].partner < static_cast<int32_t>(n) &&
                     (time_[i] - start_) * inverse_ > -1e6);
      event_[i].where = Event::nowhere;
      insert(i);
    }
  }

 private:
  bool before(int32_t i, int32_t j) const { return time_[i] < time_[j] || (time_[i] == time_[j] && i < j); }
  // The last head collects everything beyond the horizon.
  int32_t last_bucket() const { return static_cast<int32_t>(heads_.size()) - 1; }

  void insert(int32_t i) {
    const double x = (time_[i] - start_) * inverse_;
    const int32_t bucket = x < static_cast<double>(last_bucket()) ? static_cast<int32_t>(x) : last_bucket();
    if (bucket <= current_) return heap_push(i);
    Event &e = event_[i];
    e.where = bucket;
    e.prev = -1;
    e.next = heads_[bucket];
    if (e.next >= 0) event_[e.next].prev = i;
    heads_[bucket] = i;
  }
  void remove(int32_t i) {
    Event &e = event_[i];
    if (e.where >= 0) {
      if (e.prev >= 0)
        event_[e.prev].next = e.next;
      else
        heads_[e.where] = e.next;
      if (e.next >= 0) event_[e.next].prev = e.prev;
    } else if (e.where <= Event::heap_base) {
      heap_remove(Event::heap_base - e.where);
    }
    e.where = Event::nowhere;
  }
  void place(size_t slot, int32_t i) {
    heap_[slot] = i;
    event_[i].where = Event::heap_base - static_cast<int32_t>(slot);
  }
  void heap_push(int32_t i) {
    heap_.push_back(i);
    sift_up(heap_.size() - 1, i);
  }
  void sift_up(size_t slot, int32_t i) {
    while (slot > 0) {
      const size_t parent = (slot - 1) / 2;
      if (!before(i, heap_[parent])) break;
      place(slot, heap_[parent]);
      slot = parent;
    }
    place(slot, i);
  }
  void sift_down(size_t slot, int32_t i) {
    for (size_t child; (child = 2 * slot + 1) < heap_.size(); slot = child) {
      if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
      if (!before(heap_[child], i)) break;
      place(slot, heap_[child]);
    }
    place(slot, i);
  }
  void heap_remove(size_t slot) {
    const int32_t moved = heap_.back();
    heap_.pop_back();
    if (slot == heap_.size()) return;
    if (slot > 0 && before(moved, heap_[(slot - 1) / 2]))
      sift_up(slot, moved);
    else
      sift_down(slot, moved);
  }

  std::vector<double> time_;
  std::vector<Event> event_;
  std::vector<int32_t> heads_, heap_;
  double start_ = 0.0, inverse_ = 0.0;
  int32_t current_ = 0;
};

}  // namespace jam::inside
