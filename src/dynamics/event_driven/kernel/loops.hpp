// The loops of pair_kernel.hpp in vectors of simd.hpp; a file for each instruction set includes them once.
#pragma once
#include "core/with_dimension.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"
#include "dynamics/event_driven/kernel/simd.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {
namespace JAM_SIMD_NAMESPACE {

constexpr double near_contact = CollisionTuning::near_contact, overlap = CollisionTuning::overlap;

// Words of four bodies, lane by lane.
template <int D>
struct FourBodies {
  static constexpr int words = 2 * D + 2, groups = (words + 3) / 4;
  Double4 word[4 * groups];
  JAM_SIMD_INLINE void load_from(const Body<D> *body, const int32_t *list, int32_t left) {
    static_assert(sizeof(Body<D>) >= 32 * groups && offsetof(Body<D>, radius) == 8 * (words - 1), "words without gaps");
    const Body<D> *row[4];
    for (int l = 0; l < 4; ++l) row[l] = body + list[l < left ? l : 0];
    for (int g = 0; g < groups; ++g) {
      for (int l = 0; l < 4; ++l) word[4 * g + l] = load<Double4>(reinterpret_cast<const char *>(row[l]) + 32 * g);
      transpose(word[4 * g], word[4 * g + 1], word[4 * g + 2], word[4 * g + 3]);
    }
  }
  JAM_SIMD_INLINE Unsigned4 x(int c) const { return (Unsigned4)word[c]; }
  JAM_SIMD_INLINE Double4 v(int c) const { return word[D + c]; }
  JAM_SIMD_INLINE Double4 time() const { return word[2 * D]; }
  JAM_SIMD_INLINE Long4 radius() const { return (Long4)word[2 * D + 1]; }
};

// A sum of squares of 64-bit integers in four digits of 32 bits, each in a lane of 64 bits.
struct Squares {
  Long4 digit[4] = {};
  JAM_SIMD_INLINE void add(const Long4 &value) {
    constexpr uint64_t mask = 0xffffffff;
    const Unsigned4 m = select(value < 0, -(Unsigned4)value, (Unsigned4)value), upper = m >> 32;
    const Unsigned4 low = multiply_low(m, m), middle = multiply_low(m, upper), high = multiply_low(upper, upper);
    digit[0] += (Long4)(low & mask);
    digit[1] += (Long4)((low >> 32) + ((middle & mask) << 1));
    digit[2] += (Long4)(((middle >> 32) << 1) + (high & mask));
    digit[3] += (Long4)(high >> 32);
  }
  JAM_SIMD_INLINE void subtract(const Squares &other) {
    for (int k = 0; k < 4; ++k) digit[k] -= other.digit[k];
  }
  // Rounded as EngineOf::exact_gap rounds its 128-bit integer: both words apart.
  JAM_SIMD_INLINE Double4 rounded() const {
    const Long4 one = digit[1] + (digit[0] >> 32), two = digit[2] + (one >> 32);
    const Unsigned4 low = ((Unsigned4)digit[0] & 0xffffffffu) | (Unsigned4)one << 32;
    const Long4 high = (Long4)((Unsigned4)two + ((Unsigned4)digit[3] << 32));
    return to_double(high) * 0x1p64 + 2.0 * to_double((Long4)(low >> 1));
  }
};

// Four pairs.
template <int D, Offsets O>
struct FourPairs {
  FourBodies<D> other;
  Long4 difference[D];
  Double4 dt;
  Long4 sum;

  JAM_SIMD_INLINE void load_from(const PairBatch<D> &q, int32_t e) {
    other.load_from(q.body, q.list + e, q.count - e);
    for (int c = 0; c < D; ++c) {
      Unsigned4 d = q.self->x[c] - other.x(c);  // wraps to the nearest image
      if (O == Offsets::listed) d += load<Unsigned4>(q.offset + static_cast<size_t>(c) * q.stride + e);
      difference[c] = (Long4)d;
    }
    dt = q.now - other.time();
    sum = other.radius() + q.self->radius;
    if (q.non_additivity != 0.0) {
      const Long4 more = to_integer(to_double(sum) * q.non_additivity);
      sum += select(other.radius() != q.self->radius, more, more ^ more);
    }
  }

  // r^2 - sigma^2 from integers.
  JAM_SIMD_INLINE Double4 exact_gap(double grown) const {
    Squares gap, contact;
    for (int c = 0; c < D; ++c) gap.add(difference[c] - to_integer(other.v(c) * dt));
    contact.add(sum + to_integer(to_double(sum) * grown));
    gap.subtract(contact);
    return gap.rounded();
  }

  // Times from now on; infinity without a collision. Sets the bits of lanes that the caller must compute.
  JAM_SIMD_INLINE Double4 times(const PairBatch<D> &q, unsigned &left_out) const {
    const double grown = 1.0 + q.rate * q.now;
    Double4 rv{}, vv{}, rr{};
    for (int c = 0; c < D; ++c) {
      const Double4 r = to_double(difference[c]) - other.v(c) * dt, v = q.self->v[c] - other.v(c);
      rv += r * v;
      vv += v * v;
      rr += r * r;
    }
    const Double4 doubles = to_double(sum), sigma = doubles * grown, growth = doubles * q.rate;
    const Double4 b = rv - sigma * growth, a = vv - growth * growth, sigma2 = sigma * sigma;
    Double4 gap = rr - sigma2;
    const Long4 approaches = b < 0.0, never_mind = (gap < overlap * sigma2) | (a < 0.0);
    const Long4 near = approaches & (gap < near_contact * sigma2);
    left_out = bits_of(never_mind);
    if (__builtin_expect(bits_of(near) != 0, 0)) {
      const Double4 exact = exact_gap(q.rate * q.now);
      gap = select(near, exact, gap);
    }
    const Double4 disc = b * b - a * gap, t = gap / (square_root(disc) - b);
    const Double4 none = Double4{} + __builtin_inf(), zero{};
    const Double4 ahead = select(disc < 0.0, none, t);
    return select(approaches & ~never_mind, select(gap <= 0.0, zero, ahead), none);
  }
};

template <int D, Offsets O>
JAM_SIMD_TARGET uint64_t earliest_collision(const PairBatch<D> &q, Earliest &earliest) {
  alignas(32) double when[PairKernel<D>::batch];
  const Double4 none = Double4{} + __builtin_inf();
  uint64_t left_out = 0;
  Double4 least = none;
  for (int32_t e = 0; e < q.count; e += 4) {
    FourPairs<D, O> pairs;
    pairs.load_from(q, e);
    unsigned skip = 0;
    Double4 t = pairs.times(q, skip);
    const int32_t left = q.count - e;
    if (left < 4) {
      skip &= (1u << left) - 1;
      t = select(Long4{0, 1, 2, 3} < left, t, none);
    }
    left_out |= static_cast<uint64_t>(skip) << e;
    store(when + e, t);
    least = select(least < t, least, t);
  }
  // The first entry with the smallest time, unless the other sphere has an earlier event: then the next one.
  for (;;) {
    const double low = least[0] < least[1] ? least[0] : least[1], high = least[2] < least[3] ? least[2] : least[3];
    const double t = low < high ? low : high;
    if (!(t < earliest.time)) return left_out;
    uint64_t same = 0;
    for (int32_t e = 0; e < q.count; e += 4) {
      const Long4 equal = (Long4)(load<Double4>(when + e) == t);
      same |= static_cast<uint64_t>(bits_of(equal)) << e;
    }
    const int entry = __builtin_ctzll(same);
    if (q.now + t < q.event_time[q.list[entry]]) {
      earliest.time = t;
      earliest.entry = entry;
      return left_out;
    }
    when[entry] = __builtin_inf();
    least = none;
    for (int32_t e = 0; e < q.count; e += 4) {
      const Double4 t4 = load<Double4>(when + e);
      least = select(least < t4, least, t4);
    }
  }
}

template <int D>
JAM_SIMD_TARGET uint64_t collisions(const PairBatch<D> &q, Earliest &earliest) {
  return q.offset ? earliest_collision<D, Offsets::listed>(q, earliest)
                  : earliest_collision<D, Offsets::wrapped>(q, earliest);
}

template <int D>
JAM_SIMD_TARGET int32_t search(const CellSearch<D> &q, int32_t *found, int32_t *turn) {
  Int8 place[D];
  for (int c = 0; c < D; ++c) place[c] = Int8{} + q.x[c];
  const float reach2 = q.reach * q.reach;
  int32_t size = 0;
  for (size_t k = 0; k < q.count; ++k) {
    const Block<D> *at = q.block + q.cells[k];
    if (q.turn)
      for (int c = 0; c < D; ++c) place[c] = Int8{} + q.x[q.turn[k] * D + c];
    for (;;) {
      Float8 r2{};
      for (int c = 0; c < D; ++c) {
        // Differences wrap to the nearest image.
        const Float8 r = to_float((Int8)((UnsignedInt8)place[c] - load<UnsignedInt8>(at->x[c])));
        r2 += r * r;
      }
      unsigned hits = bits_of((Int8)(r2 < reach2) & ~load<Int8>(at->id));
      for (; hits; hits &= hits - 1) {
        if (q.turn) turn[size] = q.turn[k];
        found[size++] = at->id[__builtin_ctz(hits)];
      }
      const int32_t last = at->id[Block<D>::lanes - 1];
      if (last >= Block<D>::free) break;
      at = q.block + Block<D>::link_to(last);
    }
  }
  return size;
}

// mix64 of core/rng.hpp.
JAM_SIMD_INLINE Unsigned4 mixed(Unsigned4 x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// The shifts of eight pairs along one cell vector in units of 2^-32, from 64 bits each (MkShifts::component).
template <bool Uniform>
JAM_SIMD_INLINE UnsignedInt8 shifts(const Unsigned4 &first, const Unsigned4 &last, double zeta) {
  if (Uniform) return upper_halves(first, last) ^ 0x80000000u;  // half a box less turns the highest bit
  Unsigned4 bits[2] = {first, last};
  for (Unsigned4 &half : bits) {
    const Double4 x = (to_double((Long4)(half >> 11)) * 0x1p-53 - 0.5) * zeta;
    half = (Unsigned4)to_integer((x - to_double(to_integer(x))) * 0x1p32) << 32;
  }
  return upper_halves(bits[0], bits[1]);
}

// In any cell the component of a distance along a cell vector, times the height there, is no longer than the distance.
template <int D, bool Uniform, bool Cube>
JAM_SIMD_TARGET int32_t partners(const Partners<D> &q, int32_t self, int32_t *found) {
  const auto own = static_cast<uint64_t>(self);
  int32_t size = 0;
  for (int32_t b = 0; b < q.n; b += 8) {
    Unsigned4 pair[2];
    for (int h = 0; h < 2; ++h) {
      const Unsigned4 other = Unsigned4{0, 1, 2, 3} + static_cast<uint64_t>(b + 4 * h);
      pair[h] = mixed(q.key ^ mixed(select(other < own, other << 32 | own, own << 32 | other)));
    }
    const Int8 number = Int8{0, 1, 2, 3, 4, 5, 6, 7} + b;
    const UnsignedInt8 below = (UnsignedInt8)(number < self);  // the shift of a pair changes sign with its order
    Float8 r2{};
    for (int c = 0; c < D; ++c) {
      const auto k = static_cast<uint64_t>(c);
      const UnsignedInt8 shift = shifts<Uniform>(mixed(pair[0] + k), mixed(pair[1] + k), q.zeta);
      const int32_t *x = q.x + static_cast<size_t>(c) * q.stride;
      const UnsignedInt8 way = static_cast<uint32_t>(x[self]) - load<UnsignedInt8>(x + b) + ((shift ^ below) - below);
      Float8 r = to_float((Int8)way);
      if (!Cube) r *= q.height[c];
      r2 = Cube ? r2 + r * r : select(r2 > r * r, r2, r * r);
    }
    const Float8 reach = load<Float8>(q.reach + b) + q.reach[self];
    unsigned hits = bits_of((Int8)(r2 < reach * reach) & (number != self) & (number < q.n));
    for (; hits; hits &= hits - 1) found[size++] = b + __builtin_ctz(hits);
  }
  return size;
}

template <int D>
JAM_SIMD_TARGET int32_t partners(const Partners<D> &q, int32_t self, int32_t *found) {
  if (q.cube) return q.uniform ? partners<D, true, true>(q, self, found) : partners<D, false, true>(q, self, found);
  return q.uniform ? partners<D, true, false>(q, self, found) : partners<D, false, false>(q, self, found);
}

template <int D>
PairKernel<D> pair_kernel() {
  return {collisions<D>, search<D>, partners<D>};
}
#define JAM_INSTANCE(D) template PairKernel<D> pair_kernel<D>();
JAM_EACH_DIMENSION(JAM_INSTANCE)

}  // namespace JAM_SIMD_NAMESPACE
}  // namespace jam::inside
