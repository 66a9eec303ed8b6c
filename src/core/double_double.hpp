// Numbers as unevaluated sums of two doubles: 106 bits, for differences of which a double would keep no digits.
// Knuth's sum and Dekker's product (Dekker, Numer. Math. 18, 224 (1971)); both are exact without a fused multiply-add.
#pragma once
#include <cmath>

namespace jam::inside {

struct DoubleDouble {
  double high = 0.0, low = 0.0;
  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double x) : high(x) {}
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}
  constexpr explicit operator double() const { return high + low; }
};

// a + b exactly.
constexpr DoubleDouble two_sum(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

// The same for |a| >= |b|, or a = 0.
constexpr DoubleDouble ordered_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

// a b exactly, while neither overflows when it is split (|a|, |b| < 1e300) and a b is no denormal number.
constexpr DoubleDouble two_product(double a, double b) {
  constexpr double split = 134217729.0;  // 2^27 + 1
  const double p = a * b, ca = split * a, cb = split * b;
  const double ah = ca - (ca - a), bh = cb - (cb - b), al = a - ah, bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
  const DoubleDouble sum = two_sum(high.high, high.low + low.high);
  return two_sum(sum.high, sum.low + low.low);
}
constexpr DoubleDouble operator-(DoubleDouble a) { return {-a.high, -a.low}; }
constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }
constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.high, b.high);
  return two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
// One step of Newton from the double next to the result.
constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double quotient = a.high / b.high;
  return ordered_sum(quotient, (a - b * quotient).high / b.high);
}
inline DoubleDouble square_root(DoubleDouble a) {
  const double root = std::sqrt(a.high);
  if (!(root > 0.0)) return root;
  return ordered_sum(root, (a - two_product(root, root)).high / (2.0 * root));
}
// high + low += x.
inline void add_to(double &high, double &low, double x) {
  const DoubleDouble sum = DoubleDouble(high, low) + DoubleDouble(x);
  high = sum.high, low = sum.low;
}

}  // namespace jam::inside
