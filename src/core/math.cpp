#include "core/math.hpp"

#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/double_double.hpp"

static_assert(FLT_EVAL_METHOD == 0 && DBL_MANT_DIG == 53, "libjam needs doubles that round at every operation");

namespace jam::inside::math {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
constexpr double ln2 = 0x1.62e42fee00000p-1, ln2_rest = 0x1.a39ef35793c76p-33;  // k ln2 is exact, |k| < 2^21
constexpr double half_pi = 0x1.921fb54442d18p+0, half_pi_low = 0x1.1a62633145c07p-54;

// c[0] + c[1] x + ..., even and odd powers apart, which takes half the time of one chain.
template <int N>
double series(const double (&c)[N], double x) {
  static_assert(N % 2 == 0, "two chains of one length");
  const double x2 = x * x;
  double even = c[N - 2], odd = c[N - 1];
  for (int k = N - 4; k >= 0; k -= 2) even = even * x2 + c[k], odd = odd * x2 + c[k + 1];
  return even + odd * x;
}

uint64_t bits_of(double x) {
  uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
double from_bits(uint64_t bits) {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

// x = m 2^k with m from sqrt(1/2) to sqrt(2), for finite x > 0.
double split(double x, int &k) {
  k = 0;
  if (x < DBL_MIN) x *= 0x1p54, k = -54;
  constexpr uint64_t root_half = 0x3fe6a09e00000000, fraction = 0x000fffffffffffff;
  const uint64_t above = bits_of(x) - root_half;
  k += static_cast<int>(static_cast<int64_t>(above) >> 52);
  return from_bits((above & fraction) + root_half);
}

double scale(double x, int k) {
  return k > -1000 && k < 1000 ? x * from_bits(static_cast<uint64_t>(k + 1023) << 52) : std::ldexp(x, k);
}

// To the nearest integer, |x| < 2^51: in any build one sum and one difference, where floor may be a call.
double nearest(double x) { return (x + 0x1.8p52) - 0x1.8p52; }

// 1 / c in few bits and -ln of it, for c = first / 64 .. last / 64.
struct LogTable {
  static constexpr int first = 45, last = 91;
  struct Entry {
    double inverse, log, log_low;
  } entry[last - first + 1];
  constexpr LogTable() : entry() {
    for (int i = first; i <= last; ++i) {
      const double inverse = static_cast<double>((64 * 1024 + i / 2) / i) / 1024.0;
      // ln of 1 / inverse is 2 artanh of (1 - inverse) / (1 + inverse); |s| < 0.18.
      const DoubleDouble s = quotient(1.0 - inverse, 1.0 + inverse), s2 = s * s;
      DoubleDouble sum;
      for (int k = 45; k > 0; k -= 2) sum = sum * s2 + quotient(2.0, k);
      const DoubleDouble log = sum * s;
      entry[i - first] = {inverse, log.high, log.low};
    }
  }

 private:
  static constexpr DoubleDouble quotient(double a, double b) {
    const double q = a / b;
    const DoubleDouble product = two_product(q, b);
    return two_sum(q, ((a - product.high) - product.low) / b);
  }
};

// ln(x + low), |low| far below x, to 2^-64 of its value: ln of the nearest c, then a series.
DoubleDouble log_twofold(double x, double low) {
  static constexpr LogTable table;
  int k;
  const double m = split(x, k), high = (m + 0x1p20) - 0x1p20;  // 32 bits behind the point
  const LogTable::Entry &c = table.entry[static_cast<int>(m * 64.0 + 0.5) - LogTable::first];
  const DoubleDouble r = two_sum(high * c.inverse - 1.0, (m - high) * c.inverse);  // exact: 1 + r = m / c
  static constexpr double series_c[] = {1.0 / 3, -1.0 / 4, 1.0 / 5, -1.0 / 6, 1.0 / 7, -1.0 / 8, 1.0 / 9, -1.0 / 10};
  const DoubleDouble half = two_product(r.high, 0.5 * r.high), whole = ordered_sum(k * ln2, c.log);
  const DoubleDouble first = ordered_sum(whole.high, r.high), second = ordered_sum(first.high, -half.high);
  const double r_low = r.low + scale(low, -k) * c.inverse;
  const double rest = 2.0 * half.high * r.high * series(series_c, r.high) + r_low * (1.0 - r.high);
  return ordered_sum(second.high,
                     ((whole.low + (k * ln2_rest + c.log_low)) + (first.low + second.low)) + (rest - half.low));
}

// e^(x + low) = (1 + r + rest) 2^k, |r| < 0.35, or 0.5 where k = 0.
struct Exponential {
  double r, rest;
  int k;
};
Exponential reduce_exp(double x, double low) {
  const double k = x > -0.5 && x < 0.5 ? 0.0 : nearest(x * 0x1.71547652b82fep+0);
  const double high = x - k * ln2, less = k * ln2_rest - low, r = high - less;
  static constexpr double c[] = {
      1.0 / 2,         1.0 / 6,          1.0 / 24,          1.0 / 120,          1.0 / 720,
      1.0 / 5040,      1.0 / 40320,      1.0 / 362880,      1.0 / 3628800,      1.0 / 39916800,
      1.0 / 479001600, 1.0 / 6227020800, 1.0 / 87178291200, 1.0 / 1307674368000};
  return {r, ((high - r) - less) + r * r * series(c, r), static_cast<int>(k)};
}
double exp_of(double x, double low) {
  if (!(x < 710.0)) return x != x ? x : infinity;
  if (x < -746.0) return 0.0;
  const Exponential e = reduce_exp(x, low);
  const DoubleDouble sum = ordered_sum(1.0, e.r);
  return scale(sum.high + (sum.low + e.rest), e.k);
}

// The multiple of a quarter turn that is nearest to an angle, and the angle from there, |rest| <= pi / 4.
struct Angle {
  unsigned quarters;  // mod 4 it counts
  DoubleDouble rest;
};

// The first 192 bits of x (2 / pi) mod 4 in integers (Payne and Hanek, SIGNUM Newsletter 18, 19 (1983)); x > pi / 4.
Angle reduce_by_integers(double x) {
  static constexpr uint64_t two_over_pi[] = {
      0x0000000000000000, 0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
      0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41,
      0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7,
      0x4f463f669e5fea2d, 0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab};
  using Wide = unsigned __int128;
  using SignedWide = __int128;
  const uint64_t bits = bits_of(x), digits = (bits & 0x000fffffffffffff) | 0x0010000000000000;
  const int first = static_cast<int>(bits >> 52) - 1013;  // the bit that weighs 2 in the product; those above drop out
  const auto word = [first](int k) {
    const uint64_t *w = two_over_pi + first / 64 + k;
    return first % 64 ? w[0] << first % 64 | w[1] >> (64 - first % 64) : w[0];
  };
  const Wide low = Wide(digits) * word(2), middle = Wide(digits) * word(1) + (low >> 64);
  const uint64_t top = digits * word(0) + static_cast<uint64_t>(middle >> 64);
  const unsigned quarters = static_cast<unsigned>((top + (uint64_t(1) << 61)) >> 62);
  const SignedWide part =
      static_cast<SignedWide>((Wide(top) << 64 | static_cast<uint64_t>(middle)) - (Wide(quarters) << 126));
  const double high = static_cast<double>(part), less = static_cast<double>(part - static_cast<SignedWide>(high));
  return {quarters, DoubleDouble(high * 0x1p-126, less * 0x1p-126) * DoubleDouble(half_pi, half_pi_low)};
}
// x > pi / 4, finite. Three parts of pi / 2 leave enough digits unless x is large or near a multiple.
Angle reduce(double x) {
  if (x < 0x1p20) {
    const double quarters = nearest(x * 0x1.45f306dc9c883p-1);
    const DoubleDouble rest = two_sum(x - quarters * 0x1.921fb54400000p+0, -quarters * 0x1.0b4611a600000p-34) +
                              DoubleDouble(-quarters * 0x1.3198a2e037073p-69);
    if (std::fabs(rest.high) > 0x1p-20) return {static_cast<unsigned>(quarters), rest};
  }
  return reduce_by_integers(x);
}

double sine(DoubleDouble a) {
  static constexpr double c[] = {-1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
                                 -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  const double x = a.high, x2 = x * x;
  return x + (a.low * (1.0 - 0.5 * x2) + x * x2 * series(c, x2));
}
double cosine(DoubleDouble a) {
  static constexpr double c[] = {1.0 / 24,        -1.0 / 720,         1.0 / 40320,          -1.0 / 3628800,
                                 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000, -1.0 / 6402373705728000};
  const double x = a.high, x2 = x * x, half = 0.5 * x2, high = 1.0 - half;
  return high + (((1.0 - high) - half) + (x2 * x2 * series(c, x2) - x * a.low));
}
// The sine quarters later than `quarters` says.
double sine_of(const Angle &a, unsigned later) {
  const unsigned quarter = (a.quarters + later) % 4;
  const double value = quarter % 2 ? cosine(a.rest) : sine(a.rest);
  return quarter < 2 ? value : -value;
}

// (arcsin x - x) / x^3 in powers of x^2: products of (2k - 1) / 2k over 2k + 1.
struct ArcsineSeries {
  double c[26];
  constexpr ArcsineSeries() : c() {
    double product = 1.0;
    for (int k = 1; k <= 26; ++k) {
      product *= (2.0 * k - 1.0) / (2.0 * k);
      c[k - 1] = product / (2.0 * k + 1.0);
    }
  }
};
// arcsin of |x| <= 1/2 as x and the rest.
DoubleDouble small_arcsine(double x) {
  static constexpr ArcsineSeries arcsine;
  return {x, x * (x * x) * series(arcsine.c, x * x)};
}
// Half of arccos x for x >= 1/2: the arcsine of the root of (1 - x) / 2.
DoubleDouble half_arccosine(double x) {
  const double square = 0.5 * (1.0 - x), root = std::sqrt(square);
  if (root == 0.0) return {};
  const DoubleDouble product = two_product(root, root), a = small_arcsine(root);
  return {a.high, a.low + ((square - product.high) - product.low) / (2.0 * root)};
}
// pi / 2 - scale a
double from_half_pi(double scale, DoubleDouble a) {
  const DoubleDouble sum = two_sum(half_pi, -scale * a.high);
  return sum.high + (sum.low + (half_pi_low - scale * a.low));
}

}  // namespace

double log(double x) {
  if (!(x > 0.0)) return x == 0.0 ? -infinity : nan;
  if (x == infinity) return x;
  return static_cast<double>(log_twofold(x, 0.0));
}

double log1p(double x) {
  if (!(x > -1.0)) return x == -1.0 ? -infinity : nan;
  if (x == infinity || std::fabs(x) < 0x1p-54) return x;
  const DoubleDouble sum = two_sum(1.0, x);
  return static_cast<double>(log_twofold(sum.high, sum.low));
}

double exp(double x) { return exp_of(x, 0.0); }

double expm1(double x) {
  if (!(x < 60.0 && x > -60.0)) return exp(x) - 1.0;
  if (std::fabs(x) < 0x1p-54) return x;
  const Exponential e = reduce_exp(x, 0.0);
  if (e.k == 0) return e.r + e.rest;
  const double power = scale(1.0, e.k);
  const DoubleDouble first = two_sum(power, -1.0), second = two_sum(first.high, power * e.r);
  return second.high + ((first.low + second.low) + power * e.rest);
}

double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (x != x || y != y) return nan;
  const double size = std::fabs(x);
  const bool whole = std::floor(y) == y, odd = whole && std::floor(0.5 * y) != 0.5 * y;
  double value = 1.0;
  if (size == 0.0 || size == infinity || std::fabs(y) > 0x1p64) {
    if (size != 1.0) value = (size > 1.0) == (y > 0.0) ? infinity : 0.0;
  } else if (x < 0.0 && !whole) {
    return nan;
  } else {
    const DoubleDouble log_of = log_twofold(size, 0.0), product = two_product(y, log_of.high);
    value = exp_of(product.high, product.low + y * log_of.low);
  }
  return odd && std::signbit(x) ? -value : value;
}

double sin(double x) {
  const double size = std::fabs(x);
  if (size < 0x1p-27) return x;
  if (size <= 0.5 * half_pi) return sine(x);
  if (!(size < infinity)) return nan;
  const double value = sine_of(reduce(size), 0);
  return x < 0.0 ? -value : value;
}

double cos(double x) {
  const double size = std::fabs(x);
  if (size <= 0.5 * half_pi) return cosine(size);
  return size < infinity ? sine_of(reduce(size), 1) : nan;
}

double cos_of_turns(double turns) {
  const double quarters = nearest(4.0 * turns), rest = 4.0 * turns - quarters;
  return sine_of({static_cast<unsigned>(static_cast<int>(quarters)),
                  two_product(rest, half_pi) + DoubleDouble(rest * half_pi_low)},
                 1);
}

double asin(double x) {
  const double size = std::fabs(x);
  if (!(size <= 1.0)) return nan;
  if (size <= 0.5) return static_cast<double>(small_arcsine(x));
  const double value = from_half_pi(2.0, half_arccosine(size));
  return x < 0.0 ? -value : value;
}

double acos(double x) {
  if (!(std::fabs(x) <= 1.0)) return nan;
  if (x > 0.5) return 2.0 * static_cast<double>(half_arccosine(x));
  return x < -0.5 ? 2.0 * from_half_pi(1.0, half_arccosine(-x)) : from_half_pi(1.0, small_arcsine(x));
}

}  // namespace jam::inside::math
