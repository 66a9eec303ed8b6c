// The neighbour lists of the engine: where each was made, how far it reaches and whom it holds.
#pragma once
#include <algorithm>

#include "core/call_scope.hpp"
#include "dynamics/event_driven/lattice.hpp"

namespace jam::inside {

// The entry of sphere k where it is in the list once, as nearly always; else -1.
int32_t only_entry(const int32_t *list, int32_t count, int32_t k);

template <int D, Offsets O>
struct Lists {
  static constexpr bool listed = O == Offsets::listed;
  using Place = std::array<uint64_t, D>;
  using Offset = std::array<int64_t, D>;

  double shell = 0.0, margin = 0.0;  // relative to the diameter
  std::vector<Place> centre;         // where a list was made
  std::vector<double> rho, safe;     // list radius, safe radius
  std::vector<int32_t> neighbour;    // (n, capacity)
  std::vector<int32_t> count;        // neighbours of each sphere
  std::vector<int64_t> offset;       // listed: (n, D, capacity)
  std::vector<int32_t> shifted;      // listed: entries of each list whose offset is not zero; without any, none is kept
  size_t capacity = 0;               // a multiple of the length of a vector

  explicit Lists(size_t n) : centre(n), rho(n), safe(n), count(n, 0), shifted(listed ? n : 0, 0) {}

  // Whether lists without offsets can hold for this largest contact distance, unit box: then both spheres of a pair may
  // are at the far ends of their safe spheres and differences still wrap to the image of the list.
  static bool fit_wrapped(double sigma_max) {
    return sigma_max * (1.0 + 4.0 * ListTuning::smallest_shell + ListTuning::smallest_margin) <
           ListTuning::reach_wrapped;
  }
  const int32_t *of(int32_t i) const { return &neighbour[static_cast<size_t>(i) * capacity]; }
  int32_t *of(int32_t i) { return &neighbour[static_cast<size_t>(i) * capacity]; }
  // nullptr: all offsets of the list are zero.
  const int64_t *offset_of(int32_t i, int32_t entry) const {
    if constexpr (listed)
      return shifted[i] ? &offset[offset_at(i, entry)] : nullptr;
    else
      return (void)i, (void)entry, nullptr;
  }
  Offset between_centres(int32_t i, int32_t k) const {
    Offset r;
    for (int c = 0; c < D; ++c) r[c] = static_cast<int64_t>(centre[i][c] - centre[k][c]);
    return r;
  }
  double mean_length() const {
    double length = 0.0;
    for (int32_t m : count) length += m;
    return length / static_cast<double>(count.size());
  }

  void clear() {
    std::fill(count.begin(), count.end(), 0);
    std::fill(shifted.begin(), shifted.end(), 0);
    if (capacity == 0) widen();
  }
  // Writes k (and the offset that makes x_i - x_k that image) to the list of i, and i to that of k.
  void append(int32_t i, int32_t k, const Offset *image) {
    if (static_cast<size_t>(std::max(count[i], count[k])) >= capacity) widen();
    const int32_t at_i = count[i]++, at_k = count[k]++;
    of(i)[at_i] = k;
    of(k)[at_k] = i;
    if constexpr (listed) {
      Offset back;
      for (int c = 0; c < D; ++c) back[c] = -(*image)[c];
      keep_offset(i, at_i, *image);
      keep_offset(k, at_k, back);
    } else {
      (void)image;
    }
  }
  // Empties the list of i, and takes i out of those of its neighbours.
  void forget(int32_t i) {
    for (int32_t e = 0; e < count[i]; ++e) forget_entry(i, of(i)[e]);
    count[i] = 0;
    if constexpr (listed) shifted[i] = 0;
  }
  void archive(Archive &a) {
    a(shell);
    a(margin);
    a(centre);
    a(rho);
    a(safe);
    a(neighbour);
    a(count);
    if constexpr (listed)
      for (int32_t i = 0; !a.reading() && i < static_cast<int32_t>(shifted.size()); ++i)
        if (shifted[i] == 0) clear_offsets(i, count[i]);
    a(offset);
    uint64_t wide = capacity;
    a(wide);
    capacity = wide;
  }
  // Of an archive. Every list must be mutual, or a damaged file would send the engine astray.
  void check(size_t n, double scale) {
    Archive::check(centre.size() == n && rho.size() == n && safe.size() == n && count.size() == n);
    Archive::check(capacity > 0 && capacity % 8 == 0 && neighbour.size() / n == capacity && neighbour.size() % n == 0);
    Archive::check(offset.size() == (listed ? neighbour.size() * D : 0));
    // A longer reach would find images without end.
    for (size_t i = 0; i < n; ++i) Archive::check(rho[i] >= 0.0 && rho[i] <= 4.0 * scale && std::isfinite(safe[i]));
    for (size_t i = 0; i < n; ++i) {
      Archive::check(count[i] >= 0 && static_cast<size_t>(count[i]) <= capacity);
      for (int32_t e = 0; e < count[i]; ++e) {
        const int32_t k = neighbour[i * capacity + e];
        Archive::check(k >= 0 && static_cast<size_t>(k) < n && static_cast<size_t>(k) != i && count[k] >= 0 &&
                       static_cast<size_t>(count[k]) <= capacity);
        const int32_t *list = &neighbour[static_cast<size_t>(k) * capacity];
        Archive::check(std::count(list, list + count[k], static_cast<int32_t>(i)) ==
                       std::count(&neighbour[i * capacity], &neighbour[i * capacity] + count[i], k));
      }
    }
    for (int32_t i = 0; listed && i < static_cast<int32_t>(n); ++i) {
      shifted[i] = 0;
      for (int32_t e = 0; e < count[i]; ++e) shifted[i] += is_shifted(i, e);
    }
  }

 private:
  size_t offset_at(int32_t i, int32_t entry) const {
    return static_cast<size_t>(i) * D * capacity + static_cast<size_t>(entry);
  }
  // Takes one entry of i out of the list of k.
  void forget_entry(int32_t i, int32_t k) {
    int32_t *list = of(k);
    const int32_t last = --count[k];
    int32_t e = 0;
    while (list[e] != i) ++e;
    list[e] = list[last];
    if constexpr (listed) {
      if (shifted[k] == 0) return;
      shifted[k] -= is_shifted(k, e);
      for (int c = 0; c < D; ++c) offset[offset_at(k, e) + c * capacity] = offset[offset_at(k, last) + c * capacity];
    }
  }
  bool is_shifted(int32_t i, int32_t entry) const {
    int64_t any = 0;
    for (int c = 0; c < D; ++c) any |= offset[offset_at(i, entry) + c * capacity];
    return any != 0;
  }
  [[gnu::noinline]] void clear_offsets(int32_t i, int32_t entries) {
    for (int c = 0; c < D; ++c) std::fill_n(&offset[offset_at(i, 0) + c * capacity], entries, 0);
  }
  [[gnu::noinline]] void keep_offset(int32_t i, int32_t entry, const Offset &value) {
    int64_t any = 0;
    for (const int64_t x : value) any |= x;
    if (any == 0 && shifted[i] == 0) return;
    if (shifted[i] == 0) clear_offsets(i, entry);
    shifted[i] += any != 0;
    for (int c = 0; c < D; ++c) offset[offset_at(i, entry) + c * capacity] = value[c];
  }
  void widen() {
    const size_t n = count.size(),
                 wider = capacity == 0 ? ListTuning::first_capacity : (capacity + capacity / 4 + 11) / 8 * 8;
    const size_t entry = sizeof(int32_t) + (listed ? D * sizeof(int64_t) : 0);
    CallScope::need_memory(static_cast<double>(wider * n) * static_cast<double>(entry), "neighbour lists");
    std::vector<int32_t> list(wider * n);
    std::vector<int64_t> moved(listed ? wider * n * D : 0);
    for (size_t i = 0; i < n && capacity > 0; ++i) {
      std::copy_n(&neighbour[i * capacity], count[i], &list[i * wider]);
      if constexpr (listed)
        for (size_t row = i * D; row < (i + 1) * D; ++row)
          std::copy_n(&offset[row * capacity], count[i], &moved[row * wider]);
    }
    neighbour.swap(list);
    offset.swap(moved);
    capacity = wider;
  }
};

}  // namespace jam::inside
