// Elementary functions: right to the last place, and the same bits everywhere.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include "test.h"

#include "core/math.hpp"
#include "core/rng.hpp"

using namespace jam::inside;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int many = 200000;

// Distance from the exact value in units in the last place. Denormal results have the unit of the smallest normal one.
double units_off(double got, long double exact) {
  int exponent;
  std::frexp(exact, &exponent);
  return static_cast<double>(std::fabs(got - exact) / std::ldexp(1.0L, std::max(exponent, -1021) - 53));
}

// All doubles of both signs from 2^low to 2^high, alike in their exponents.
class Numbers {
 public:
  double operator()(int low, int high) {
    const int exponent = low + static_cast<int>(rng_.bits() % static_cast<uint64_t>(high - low));
    const double x = std::ldexp(1.0 + rng_.uniform(), exponent);
    return rng_.bits() % 2 ? x : -x;
  }
  double positive(int low, int high) { return std::fabs((*this)(low, high)); }
  double between(double low, double high) { return low + (high - low) * rng_.uniform(); }

 private:
  Rng rng_{1, Stream::velocities};
};

// The references are the long doubles of the C library, which must have more digits.
template <class F, class Exact, class Draw>
void is_right(const char *name, F f, Exact exact, Draw draw, double bound = 1.0) {
  if (LDBL_MANT_DIG < 64) skip();
  double worst = 0.0, where = 0.0;
  for (int k = 0; k < many; ++k) {
    const double x = draw(), off = units_off(f(x), exact(static_cast<long double>(x)));
    if (!(off <= worst)) worst = off, where = x;
  }
  if (!(worst < bound)) fail_msg("%s(%a): off by %g units in the last place", name, where, worst);
}

CASE(logarithms_and_exponentials_are_right_to_the_last_place) {
  using Long = long double;
  Numbers number;
  const auto ln = [](Long x) { return std::log(x); };
  is_right("log", math::log, ln, [&] { return number.positive(-1074, 1024); });
  is_right("log near 1", math::log, ln, [&] { return 1.0 + number(-52, -1); });
  const auto ln1 = [](Long x) { return std::log1p(x); };
  is_right("log1p", math::log1p, ln1, [&] { return number.positive(-1000, 1024); });
  is_right("log1p", math::log1p, ln1, [&] { return -number.positive(-1000, 0) / 2.0; });
  const auto e = [](Long x) { return std::exp(x); };
  is_right("exp", math::exp, e, [&] { return number.between(-744.0, 709.7); });
  is_right("exp near 0", math::exp, e, [&] { return number(-60, 1); });
  const auto e1 = [](Long x) { return std::expm1(x); };
  is_right("expm1", math::expm1, e1, [&] { return number.between(-80.0, 80.0); });
  is_right("expm1 near 0", math::expm1, e1, [&] { return number(-1000, 1); });
}

CASE(powers_are_right_to_the_last_place) {
  if (LDBL_MANT_DIG < 64) skip();
  Numbers number;
  for (int k = 0; k < many; ++k) {
    // the long double loses about |y ln x| 2^-64, so large results say less about the last place
    const double x = number.positive(-300, 300), y = number(-20, 1) * 40.0 / std::max(1.0, std::fabs(std::log(x)));
    const double off = units_off(math::pow(x, y), std::pow(static_cast<long double>(x), static_cast<long double>(y)));
    if (!(off < 1.0)) fail_msg("pow(%a, %a): off by %g units in the last place", x, y, off);
  }
  for (int base = 1; base < 200; ++base) {  // exact ones are exact
    double product = 1.0;
    for (int d = 0; d <= 6; ++d, product *= base) {
      assert_true(math::pow(base, d) == product && math::pow(0.125 * base, d) == std::ldexp(product, -3 * d));
      if (d) assert_true(math::pow(product, 1.0) == product && math::pow(-base, 3.0) == -math::pow(base, 3.0));
    }
  }
}

CASE(angles_are_right_to_the_last_place) {
#ifdef __MINGW32__
  skip();  // its long doubles are instructions of the x87, whose pi has 66 bits
#endif
  using Long = long double;
  Numbers number;
  const auto sine = [](Long x) { return std::sin(x); };
  const auto cosine = [](Long x) { return std::cos(x); };
  for (const int high : {4, 60, 1024}) {
    is_right("sin", math::sin, sine, [&] { return number(-1000, high); });
    is_right("cos", math::cos, cosine, [&] { return number(-30, high); });
  }
  // next to multiples of pi / 2, where most digits of the argument cancel
  is_right("cos", math::cos, cosine, [&] { return std::floor(number.between(0.0, 1e7)) * 1.5707963267948966; });
  assert_true(std::fabs(math::cos(6381956970095103.0 * 0x1p797) + 4.68716592425462761112e-19) < 1e-34);
  is_right(
      "cos of turns", math::cos_of_turns, [](Long x) { return std::cos(6.28318530717958647692528676655900577L * x); },
      [&] { return number.between(-0.2, 0.2); });
  const auto arcsine = [](Long x) { return std::asin(x); };
  const auto arccosine = [](Long x) { return std::acos(x); };
  is_right("asin", math::asin, arcsine, [&] { return number.between(-1.0, 1.0); });
  is_right("acos", math::acos, arccosine, [&] { return number.between(-1.0, 1.0); });
  is_right("acos", math::acos, arccosine, [&] { return 1.0 - number.positive(-52, -1); });
}

bool alike(double a, double b) { return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b); }

CASE(ends_of_the_range_are_those_of_c) {
  const double ends[] = {0.0, -0.0, 1.0, -1.0, infinity, -infinity, std::nan(""), 1e300, -1e300};
  for (const double x : ends) {
    assert_true(alike(math::exp(x), x == 1.0 || x == -1.0 ? math::exp(x) : std::exp(x)));
    if (!(std::fabs(x) > 1.0)) assert_true(alike(math::log(std::fabs(x)), std::log(std::fabs(x))));
    if (!(std::fabs(x) == 1.0) && std::fabs(x) != 1e300) {
      assert_true(alike(math::log1p(x), std::log1p(x)) && alike(math::expm1(x), std::expm1(x)));
      assert_true(alike(math::sin(x), std::sin(x)) && alike(math::cos(x), std::cos(x)));
      assert_true(alike(math::asin(x), std::asin(x)));
    }
    for (const double y : {0.0, -0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 0.5, -0.5, infinity, -infinity, std::nan(""),
                           0x1p53, 0x1p53 - 1, -0x1p53 + 1, 0x1p70, -0x1p70})
      if (!alike(math::pow(x, y), std::pow(x, y))) assert_true(std::fabs(x) == 1e300 && std::fabs(y) == 0.5);
  }
  assert_true(std::isnan(math::log(-1.0)) && std::isnan(math::log1p(-2.0)) && math::log1p(-1.0) == -infinity);
  assert_true(math::exp(709.8) == infinity && math::exp(-745.2) == 0.0 && math::exp(-745.1) == 0x1p-1074);
  assert_true(std::isnan(math::pow(-2.0, 0.5)) && std::isnan(math::asin(1.1)) && std::isnan(math::acos(-1.1)));
  assert_true(math::acos(1.0) == 0.0 && math::acos(0.0) == std::acos(0.0) && math::acos(-1.0) == std::acos(-1.0));
}

// The bits themselves: what one machine wrote down, every other finds. They are not to change: packings hang on them.
CASE(bits_are_those_of_every_other_machine) {
  uint64_t hash = 0;
  const auto add = [&hash](double x) {
    uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    hash = mix64(hash ^ bits);
  };
  Numbers number;
  Rng rng(7, Stream::velocities);
  for (int k = 0; k < 20000; ++k) {
    add(rng.normal());
    add(math::log(number.positive(-1074, 1024)));
    add(math::log1p(number.between(-1.0, 3.0)));
    add(math::exp(number.between(-745.0, 710.0)));
    add(math::expm1(number.between(-50.0, 50.0)));
    const double base = number.positive(-100, 100);
    add(math::pow(base, number.between(-5.0, 5.0)));
    add(math::sin(number(-30, 1024)));
    add(math::cos(number(-30, 30)));
    add(math::asin(number.between(-1.0, 1.0)));
    add(math::acos(number.between(-1.0, 1.0)));
  }
  if (hash != 0xbfd7133ba15111c2) fail_msg("the bits are 0x%016llx", static_cast<unsigned long long>(hash));
}

}  // namespace
