// The engine loads memory ahead of its use. A load from main memory takes 150 ns when the program waits for it and 20
// ns when it was asked for early. The buckets of the calendar hold the spheres that come next: their events are loaded
// first, then bodies and lists, then neighbours. Below `smallest` spheres all of it stays in the cache.
#pragma once
#include "dynamics/event_driven/engine.hpp"

namespace jam {

// How many buckets (mean times between events) ahead; tests/bench/md_race shows what looking ahead is worth.
struct LookAhead {
  static constexpr int32_t smallest = 8192, events = 48, bodies = 24, neighbours = 10;
};

// GCC takes a function that only calls its builtin for one without effect, and drops the call.
inline void prefetch_line(const void *at) {
#if defined(__x86_64__)
  asm volatile("prefetcht0 %0" : : "m"(*static_cast<const char *>(at)));
#else
  __builtin_prefetch(at);
#endif
}
template <class T>
void prefetch_object(const T *at, size_t count = 1) {
  const char *first = reinterpret_cast<const char *>(at);
  for (size_t k = 0; k < count * sizeof(T); k += 64) prefetch_line(first + k);
}

template <int D, bool Shift>
void Engine<D, Shift>::prefetch_lists(int32_t i) const {
  prefetch_object(&body_[i]);
  prefetch_line(&neighbours_[i]);
  prefetch_object(list_of(i), std::min<size_t>(capacity_, 32));
  if constexpr (Shift) prefetch_object(offset_of(i, 0), D * capacity_);
  prefetch_line(&centre_[i]);
  prefetch_line(&safe_[i]);
}

template <int D, bool Shift>
void Engine<D, Shift>::prefetch_neighbours(int32_t i) const {
  const int32_t *list = list_of(i);
  for (int32_t e = 0, m = neighbours_[i]; e < m; ++e) {
    prefetch_object(&body_[list[e]]);
    prefetch_line(&calendar_.times()[list[e]]);
  }
}

// What recentre(i) will touch: lists of all neighbours, and blocks.
template <int D, bool Shift>
void Engine<D, Shift>::prefetch_search(int32_t i) const {
  const int32_t *list = list_of(i);
  for (int32_t e = 0, m = neighbours_[i]; e < m; ++e) {
    prefetch_line(list_of(list[e]));
    prefetch_line(&centre_[list[e]]);
  }
  if (cells_ == 0) return;
  const size_t count = cells_around(home_of(i));
  for (size_t k = 0; k < count; ++k) prefetch_object(&block_[around_[k]]);
}

// Called once a bucket.
template <int D, bool Shift>
void Engine<D, Shift>::look_ahead() const {
  if (n_ < LookAhead::smallest || cells_alone_) return;
  const int32_t far = calendar_.first_ahead(LookAhead::events);
  if (far >= 0) prefetch_line(&calendar_[far]);
  calendar_.each_ahead(LookAhead::bodies, [&](int32_t i, const Event &e) {
    prefetch_lists(i);
    if (e.partner < 0) return;
    prefetch_lists(e.partner);
    prefetch_line(&calendar_[e.partner]);
  });
  calendar_.each_ahead(LookAhead::neighbours, [&](int32_t i, const Event &e) {
    prefetch_neighbours(i);
    if (e.partner < 0) return prefetch_search(i);
    prefetch_neighbours(e.partner);
    const Event &other = calendar_[e.partner];
    if (other.next >= 0) prefetch_line(&calendar_[other.next]);
    if (other.prev >= 0) prefetch_line(&calendar_[other.prev]);
  });
}

}  // namespace jam
