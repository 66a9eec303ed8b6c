// What loops in vectors share. A file that includes this header first defines
//   JAM_SIMD_NAMESPACE  a namespace of its own, so that no function of one instruction set is linked into another;
//   JAM_SIMD_TARGET     the attribute that selects the instruction set of each function, or nothing.
#pragma once
#include <cstring>

#define JAM_SIMD_INLINE JAM_SIMD_TARGET __attribute__((always_inline)) inline
#pragma GCC diagnostic ignored "-Wpsabi"  // no vector crosses the border of a file

namespace jam::inside {
namespace JAM_SIMD_NAMESPACE {

template <class Vector>
JAM_SIMD_INLINE Vector load(const void *at) {
  Vector v;
  std::memcpy(&v, at, sizeof v);
  return v;
}
template <class Vector>
JAM_SIMD_INLINE void store(void *at, const Vector &v) {
  std::memcpy(at, &v, sizeof v);
}

}  // namespace JAM_SIMD_NAMESPACE
}  // namespace jam::inside
