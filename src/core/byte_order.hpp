// The order of the bytes of a number. Files have the lowest byte first, as most machines do.
#pragma once
#include <cstddef>
#include <cstring>

namespace jam::inside {

constexpr bool lowest_byte_first = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

// Byte k of a file that holds an array of T is this byte of the array in memory.
template <class T>
constexpr size_t byte_in_memory(size_t k, bool machine_has_lowest_first = lowest_byte_first) {
  static_assert((sizeof(T) & (sizeof(T) - 1)) == 0, "numbers of a power of two bytes");
  return machine_has_lowest_first ? k : k ^ (sizeof(T) - 1);
}

template <class T>
T with_bytes_reversed(T x) {
  unsigned char from[sizeof(T)], to[sizeof(T)];
  std::memcpy(from, &x, sizeof x);
  for (size_t k = 0; k < sizeof x; ++k) to[k] = from[sizeof x - 1 - k];
  std::memcpy(&x, to, sizeof x);
  return x;
}

}  // namespace jam::inside
