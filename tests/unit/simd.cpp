// Vectors of the inner loops without instruction sets of x86-64: each operation against the same on single numbers.
#include <cmath>
#include <cstdint>
#include "test.h"

#include "core/rng.hpp"

#define JAM_SIMD_NAMESPACE plain
#define JAM_SIMD_TARGET
#include "dynamics/event_driven/kernel/simd.hpp"

using namespace jam::inside;

namespace {

CASE(lanes_are_those_of_single_numbers) {
  for (uint64_t round = 0; round < 10000; ++round) {
    uint64_t a[4], b[4];
    for (uint64_t k = 0; k < 4; ++k) a[k] = mix64(8 * round + k), b[k] = mix64(8 * round + k + 4);
    const auto x = plain::load<plain::Unsigned4>(a), y = plain::load<plain::Unsigned4>(b);
    const plain::Unsigned4 product = plain::multiply_low(x, y);
    const plain::Double4 number = plain::to_double((plain::Long4)x) * 0x1p-63;
    const plain::Double4 root = plain::square_root(number * number);
    const plain::Long4 back = plain::to_integer(number * 0x1p60);
    int32_t halves[8];
    plain::store(halves, x);
    unsigned four = 0, eight = 0;
    for (int k = 0; k < 4; ++k) {
      const double same = static_cast<double>(static_cast<int64_t>(a[k])) * 0x1p-63;
      assert_true(product[k] == (a[k] & 0xffffffffu) * (b[k] & 0xffffffffu));
      assert_true(number[k] == same && root[k] == std::sqrt(same * same));
      assert_true(back[k] == static_cast<int64_t>(std::nearbyint(same * 0x1p60)));
      four |= static_cast<unsigned>(a[k] >> 63) << k;
    }
    for (int k = 0; k < 8; ++k) eight |= (halves[k] < 0 ? 1u : 0u) << k;
    assert_int_equal(plain::bits_of((plain::Long4)x), four);
    assert_int_equal(plain::bits_of((plain::Int8)x), eight);
  }
}

}  // namespace
