// Room for numbers whose old values are not needed.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/call_scope.hpp"

namespace jam {

// Room for at least `size` numbers: never the old and the new block at a time, and a little more than asked, so that
// lists that change by a few pairs do not break up the heap. Pages beyond size stay untouched.
inline void reserve_scratch(std::vector<double> &v, size_t size) {
  if (size <= v.capacity()) return;
  std::vector<double>().swap(v);
  v.reserve(size + size / 8);
}

inline void grow(std::vector<double> &v, size_t size) {
  if (v.size() >= size) return;
  reserve_scratch(v, size);
  constexpr size_t at_once =
      size_t{1} << 21;  // doubles: clearing gigabytes takes seconds, in which callers hear nothing
  while (v.size() < size) {
    v.resize(std::min(size, v.size() + at_once));
    CallScope::tell();
  }
}

}  // namespace jam
