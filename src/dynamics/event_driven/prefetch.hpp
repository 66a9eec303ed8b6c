// The engine loads memory ahead of its use. A load from main memory takes 150 ns when the program waits for it and 20
// ns when it was requested early. The buckets of the calendar say which spheres come next: their events are loaded
// first, then bodies and lists, then neighbours. Below LookAhead::smallest spheres all of it stays in the cache.
#pragma once
#include "dynamics/event_driven/engine_of.hpp"

namespace jam::inside {

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

template <int D, Offsets O>
void EngineOf<D, O>::prefetch_lists(int32_t i) const {
  prefetch_object(&spheres_.body[i]);
  prefetch_line(&lists_.count[i]);
  prefetch_object(lists_.of(i), std::min<size_t>(lists_.capacity, 32));
  if (const int64_t *offset = lists_.offset_of(i, 0)) prefetch_object(offset, D * lists_.capacity);
  prefetch_line(&lists_.centre[i]);
  prefetch_line(&lists_.safe[i]);
}

template <int D, Offsets O>
void EngineOf<D, O>::prefetch_neighbours(int32_t i) const {
  const int32_t *list = lists_.of(i);
  for (int32_t e = 0, m = lists_.count[i]; e < m; ++e) {
    prefetch_object(&spheres_.body[list[e]]);
    prefetch_line(&calendar_.times()[list[e]]);
  }
}

// What recentre(i) will touch: lists of all neighbours, and blocks.
template <int D, Offsets O>
void EngineOf<D, O>::prefetch_search(int32_t i) const {
  const int32_t *list = lists_.of(i);
  for (int32_t e = 0, m = lists_.count[i]; e < m; ++e) {
    prefetch_line(lists_.of(list[e]));
    prefetch_line(&lists_.centre[list[e]]);
  }
  for (const Level &level : levels_.all()) {
    if (!level.grid.used() || lists_.rho[i] > level.rho_max) continue;
    const auto home = level.grid.home(lists_.centre[i], lattice_);
    const auto prefetch = [&](const std::vector<size_t> &cells, size_t count) {
      for (size_t k = 0; k < count; ++k) prefetch_object(&level.cells.block[cells[k]]);
    };
    if constexpr (listed)
      prefetch(image_cells_.cell, level.grid.cells_around(home, lattice_, image_cells_));
    else
      prefetch(level.grid.around, level.grid.cells_around(home, lattice_));
  }
}

// Called once a bucket.
template <int D, Offsets O>
void EngineOf<D, O>::look_ahead() const {
  if (spheres_.n < LookAhead::smallest || in_cell_mode()) return;
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

}  // namespace jam::inside
