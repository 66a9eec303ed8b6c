// Vectors of 32 bytes for processors whose registers have 16: two halves, each a vector as the compiler defines it. GCC
// takes vectors that are longer than the registers apart into single numbers, which is several times slower.
// Included by simd.hpp, which documents the types.
#pragma once
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace jam::inside {
namespace JAM_SIMD_NAMESPACE {

template <class Number>
struct Halves {
  typedef Number Half __attribute__((vector_size(16)));
  static constexpr int lanes = 16 / sizeof(Number);
  using Mask = Halves<std::conditional_t<sizeof(Number) == 8, int64_t, int32_t>>;
  Half half[2];

  Halves() = default;
  JAM_SIMD_INLINE Halves(const Half &first, const Half &last) : half{first, last} {}
  JAM_SIMD_INLINE Halves(Number all) : half{Half{} + all, Half{} + all} {}
  template <class... Each, class = std::enable_if_t<sizeof...(Each) == 2 * lanes>>
  JAM_SIMD_INLINE Halves(Each... each) {
    const Number number[] = {static_cast<Number>(each)...};
    std::memcpy(half, number, sizeof half);
  }
  template <class Other>
  JAM_SIMD_INLINE explicit operator Halves<Other>() const {  // the same bits, as between the compiler's vectors
    using To = typename Halves<Other>::Half;
    return {(To)half[0], (To)half[1]};
  }
  JAM_SIMD_INLINE Number operator[](int k) const { return half[k / lanes][k % lanes]; }
  JAM_SIMD_INLINE Halves operator-() const { return {-half[0], -half[1]}; }
  JAM_SIMD_INLINE Halves operator~() const { return {~half[0], ~half[1]}; }
  JAM_SIMD_INLINE Halves operator<<(int k) const { return {half[0] << k, half[1] << k}; }
  JAM_SIMD_INLINE Halves operator>>(int k) const { return {half[0] >> k, half[1] >> k}; }

#define JAM_OPERATOR(op)                                                        \
  JAM_SIMD_INLINE friend Halves operator op(const Halves &a, const Halves &b) { \
    return {a.half[0] op b.half[0], a.half[1] op b.half[1]};                    \
  }                                                                             \
  JAM_SIMD_INLINE Halves &operator op##=(const Halves &b) { return *this = *this op b; }
  JAM_OPERATOR(+)
  JAM_OPERATOR(-)
  JAM_OPERATOR(*)
  JAM_OPERATOR(/)
  JAM_OPERATOR(&)
  JAM_OPERATOR(|)
  JAM_OPERATOR(^)
#undef JAM_OPERATOR
#define JAM_COMPARISON(op)                                                    \
  JAM_SIMD_INLINE friend Mask operator op(const Halves &a, const Halves &b) { \
    return {a.half[0] op b.half[0], a.half[1] op b.half[1]};                  \
  }
  JAM_COMPARISON(<)
  JAM_COMPARISON(>)
  JAM_COMPARISON(<=)
  JAM_COMPARISON(==)
  JAM_COMPARISON(!=)
#undef JAM_COMPARISON
};

using Double4 = Halves<double>;
using Long4 = Halves<int64_t>;
using Unsigned4 = Halves<uint64_t>;
using Float8 = Halves<float>;
using Int8 = Halves<int32_t>;
using UnsignedInt8 = Halves<uint32_t>;

template <class Number>
JAM_SIMD_INLINE Halves<Number> select(const typename Halves<Number>::Mask &mask, const Halves<Number> &yes,
                                      const Halves<Number> &no) {
  return {mask.half[0] ? yes.half[0] : no.half[0], mask.half[1] ? yes.half[1] : no.half[1]};
}
JAM_SIMD_INLINE Float8 to_float(const Int8 &v) {
  return {__builtin_convertvector(v.half[0], Float8::Half), __builtin_convertvector(v.half[1], Float8::Half)};
}

JAM_SIMD_INLINE unsigned bits_of(const Long4 &v) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd((__m128d)v.half[0]) | _mm_movemask_pd((__m128d)v.half[1]) << 2);
#elif defined(JAM_NEON)
  const uint64x2_t signs = vshrq_n_u64((uint64x2_t)v.half[0], 63) | vshrq_n_u64((uint64x2_t)v.half[1], 63) << 2;
  return static_cast<unsigned>(vaddvq_u64(vshlq_u64(signs, int64x2_t{0, 1})));
#else
  unsigned bits = 0;
  for (int k = 0; k < 4; ++k) bits |= (v[k] < 0 ? 1u : 0u) << k;
  return bits;
#endif
}
JAM_SIMD_INLINE unsigned bits_of(const Int8 &v) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps((__m128)v.half[0]) | _mm_movemask_ps((__m128)v.half[1]) << 4);
#elif defined(JAM_NEON)
  const uint32x4_t signs = vshrq_n_u32((uint32x4_t)v.half[0], 31) | vshrq_n_u32((uint32x4_t)v.half[1], 31) << 4;
  return vaddvq_u32(vshlq_u32(signs, int32x4_t{0, 1, 2, 3}));
#else
  unsigned bits = 0;
  for (int k = 0; k < 8; ++k) bits |= (v[k] < 0 ? 1u : 0u) << k;
  return bits;
#endif
}

JAM_SIMD_INLINE Double4 square_root(const Double4 &x) {
#if defined(__SSE2__)
  return {(Double4::Half)_mm_sqrt_pd((__m128d)x.half[0]), (Double4::Half)_mm_sqrt_pd((__m128d)x.half[1])};
#elif defined(JAM_NEON)
  return {(Double4::Half)vsqrtq_f64((float64x2_t)x.half[0]), (Double4::Half)vsqrtq_f64((float64x2_t)x.half[1])};
#else
  return {__builtin_sqrt(x[0]), __builtin_sqrt(x[1]), __builtin_sqrt(x[2]), __builtin_sqrt(x[3])};
#endif
}

JAM_SIMD_INLINE Unsigned4 multiply_low(const Unsigned4 &a, const Unsigned4 &b) {
#if defined(__SSE2__)
  using Half = Unsigned4::Half;
  return {(Half)_mm_mul_epu32((__m128i)a.half[0], (__m128i)b.half[0]),
          (Half)_mm_mul_epu32((__m128i)a.half[1], (__m128i)b.half[1])};
#elif defined(JAM_NEON)
  using Half = Unsigned4::Half;
  return {(Half)vmull_u32(vmovn_u64((uint64x2_t)a.half[0]), vmovn_u64((uint64x2_t)b.half[0])),
          (Half)vmull_u32(vmovn_u64((uint64x2_t)a.half[1]), vmovn_u64((uint64x2_t)b.half[1]))};
#else
  return (a & 0xffffffffu) * (b & 0xffffffffu);
#endif
}

#if defined(__clang__) || __GNUC__ >= 12
#define JAM_SHUFFLE2(a, b, i, j) __builtin_shufflevector(a, b, i, j)
#define JAM_SHUFFLE4(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#else
#define JAM_SHUFFLE2(a, b, i, j) __builtin_shuffle(a, b, Long4::Half{i, j})
#define JAM_SHUFFLE4(a, b, i, j, k, l) __builtin_shuffle(a, b, Int8::Half{i, j, k, l})
#endif
JAM_SIMD_INLINE void transpose(Double4 &a, Double4 &b, Double4 &c, Double4 &d) {
  const Double4 p = a, q = b, r = c, s = d;
  for (int h = 0; h < 2; ++h) {
    Double4 &even = h ? c : a, &odd = h ? d : b;
    even = {JAM_SHUFFLE2(p.half[h], q.half[h], 0, 2), JAM_SHUFFLE2(r.half[h], s.half[h], 0, 2)};
    odd = {JAM_SHUFFLE2(p.half[h], q.half[h], 1, 3), JAM_SHUFFLE2(r.half[h], s.half[h], 1, 3)};
  }
}
JAM_SIMD_INLINE UnsignedInt8 upper_halves(const Unsigned4 &a, const Unsigned4 &b) {
  constexpr int u = lowest_byte_first ? 1 : 0;  // the first upper half among the halves in memory
  using Half = UnsignedInt8::Half;
  return {JAM_SHUFFLE4((Half)a.half[0], (Half)a.half[1], u, u + 2, u + 4, u + 6),
          JAM_SHUFFLE4((Half)b.half[0], (Half)b.half[1], u, u + 2, u + 4, u + 6)};
}
#undef JAM_SHUFFLE2
#undef JAM_SHUFFLE4

}  // namespace JAM_SIMD_NAMESPACE
}  // namespace jam::inside
