// Vectors of four doubles or 64-bit integers and of eight floats or 32-bit integers: as GCC and Clang define them where
// registers have 32 bytes (JAM_SIMD_256), two halves elsewhere (simd_halves.hpp). core/simd.hpp says what a file that
// includes this header defines first. All forms round alike: the same bits everywhere.
#pragma once
#include <cstdint>
#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__aarch64__) && defined(__ARM_NEON)
#include <arm_neon.h>
#define JAM_NEON
#endif

#include "core/byte_order.hpp"
#include "core/simd.hpp"

#if !defined(JAM_SIMD_256)
#include "dynamics/event_driven/kernel/simd_halves.hpp"
#endif

namespace jam::inside {
namespace JAM_SIMD_NAMESPACE {

#if defined(JAM_SIMD_256)
typedef double Double4 __attribute__((vector_size(32)));
typedef int64_t Long4 __attribute__((vector_size(32)));
typedef uint64_t Unsigned4 __attribute__((vector_size(32)));
typedef float Float8 __attribute__((vector_size(32)));
typedef int32_t Int8 __attribute__((vector_size(32)));
typedef uint32_t UnsignedInt8 __attribute__((vector_size(32)));

// Lane by lane `yes` where the mask is true, `no` elsewhere.
template <class Mask, class Vector>
JAM_SIMD_INLINE Vector select(const Mask &mask, const Vector &yes, const Vector &no) {
  return mask ? yes : no;
}
JAM_SIMD_INLINE Float8 to_float(const Int8 &v) { return __builtin_convertvector(v, Float8); }

// Bit k is set where lane k of a comparison is true (or where it is negative).
JAM_SIMD_INLINE unsigned bits_of(const Long4 &v) { return static_cast<unsigned>(_mm256_movemask_pd((__m256d)v)); }
JAM_SIMD_INLINE unsigned bits_of(const Int8 &v) { return static_cast<unsigned>(_mm256_movemask_ps((__m256)v)); }

JAM_SIMD_INLINE Double4 square_root(const Double4 &x) { return (Double4)_mm256_sqrt_pd((__m256d)x); }

// Product of the lower halves of each lane.
JAM_SIMD_INLINE Unsigned4 multiply_low(const Unsigned4 &a, const Unsigned4 &b) {
  return (Unsigned4)_mm256_mul_epu32((__m256i)a, (__m256i)b);
}

// a[0] b[0] a[2] b[2]; a[1] b[1] a[3] b[3]; the lower halves; the upper halves.
#if defined(__clang__) || __GNUC__ >= 12
#define JAM_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#else
#define JAM_SHUFFLE(a, b, i, j, k, l) __builtin_shuffle(a, b, Long4{i, j, k, l})
#endif
// Turns four rows into four columns.
JAM_SIMD_INLINE void transpose(Double4 &a, Double4 &b, Double4 &c, Double4 &d) {
  const Double4 ab0 = JAM_SHUFFLE(a, b, 0, 4, 2, 6), ab1 = JAM_SHUFFLE(a, b, 1, 5, 3, 7);
  const Double4 cd0 = JAM_SHUFFLE(c, d, 0, 4, 2, 6), cd1 = JAM_SHUFFLE(c, d, 1, 5, 3, 7);
  a = JAM_SHUFFLE(ab0, cd0, 0, 1, 4, 5);
  b = JAM_SHUFFLE(ab1, cd1, 0, 1, 4, 5);
  c = JAM_SHUFFLE(ab0, cd0, 2, 3, 6, 7);
  d = JAM_SHUFFLE(ab1, cd1, 2, 3, 6, 7);
}

// The upper 32 bits of each lane, those of a first.
JAM_SIMD_INLINE UnsignedInt8 upper_halves(const Unsigned4 &a, const Unsigned4 &b) {
  constexpr int u = lowest_byte_first ? 1 : 0;  // the first upper half among the halves in memory
#if defined(__clang__) || __GNUC__ >= 12
  return __builtin_shufflevector((UnsignedInt8)a, (UnsignedInt8)b, u, u + 2, u + 4, u + 6, u + 8, u + 10, u + 12,
                                 u + 14);
#else
  return __builtin_shuffle((UnsignedInt8)a, (UnsignedInt8)b,
                           UnsignedInt8{u, u + 2, u + 4, u + 6, u + 8, u + 10, u + 12, u + 14});
#endif
}
#endif  // JAM_SIMD_256

// The nearest double, as the processor's conversion of one integer gives it: both halves become the low bits of
// doubles (2^52 + low and 2^84 + 2^63 + high 2^32), whose differences are exact; the last sum rounds once.
JAM_SIMD_INLINE Double4 to_double(const Long4 &v) {
#if defined(JAM_SIMD_CONVERTS)
  return __builtin_convertvector(v, Double4);
#else
  const Unsigned4 bits = (Unsigned4)v;
  const Unsigned4 low = (bits & 0xffffffffu) | 0x4330000000000000u, high = (bits >> 32) ^ 0x4530000080000000u;
  return ((Double4)high - 0x1.00000801p84) + (Double4)low;
#endif
}

// The nearest integer, ties to even, for |x| < 2^62: multiples of 2^32 and the rest apart, both exact.
JAM_SIMD_INLINE Long4 to_integer(const Double4 &x) {
#if defined(JAM_SIMD_CONVERTS)
  return (Long4)_mm256_cvtpd_epi64((__m256d)x);
#else
  constexpr double magic = 0x1.8p52;  // adding it leaves the integer in the low bits
  const Double4 up = x * 0x1p-32 + magic, rest = (x - (up - magic) * 0x1p32) + magic;
  const Long4 high = (Long4)up - 0x4338000000000000, low = (Long4)rest - 0x4338000000000000;
  return (Long4)((Unsigned4)high << 32) + low;
#endif
}

}  // namespace JAM_SIMD_NAMESPACE
}  // namespace jam::inside
