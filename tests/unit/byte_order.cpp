// Numbers in files have the lowest byte first; files of machines with the other order are refused by name.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include "test.h"
#undef fail

#include "core/byte_order.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "io/files.hpp"

#define JAM_SIMD_NAMESPACE plain
#define JAM_SIMD_TARGET
#include "dynamics/event_driven/kernel/simd.hpp"

using namespace jam::inside;

namespace {

// A machine with either order, played by an array that lies as it would there, writes the same file.
CASE(bytes_of_a_file_do_not_depend_on_the_machine) {
  const unsigned char there[] = {0x3f, 0xf8, 0, 0, 0, 0, 0, 1, 0xc0, 0, 0, 0, 0, 0, 0, 2};  // highest first
  const unsigned char here[] = {1, 0, 0, 0, 0, 0, 0xf8, 0x3f, 2, 0, 0, 0, 0, 0, 0, 0xc0};
  for (size_t k = 0; k < 16; ++k) {
    assert_int_equal(there[byte_in_memory<double>(k, false)], here[k]);
    assert_int_equal(here[byte_in_memory<double>(k, true)], here[k]);
  }
  const int32_t number = 0x01020304;
  const char *memory = reinterpret_cast<const char *>(&number);
  for (size_t k = 0; k < 4; ++k) assert_int_equal(memory[byte_in_memory<int32_t>(k)], 4 - static_cast<int>(k));
  assert_int_equal(with_bytes_reversed(number), 0x04030201);
}

CASE(upper_halves_are_those_of_the_numbers) {
  uint64_t a[4], b[4];
  uint32_t out[8];
  for (uint64_t k = 0; k < 4; ++k) a[k] = (k + 1) << 32 | 77, b[k] = (k + 5) << 32 | 77;
  plain::store(out, plain::upper_halves(plain::load<plain::Unsigned4>(a), plain::load<plain::Unsigned4>(b)));
  for (uint32_t k = 0; k < 8; ++k) assert_int_equal(out[k], k + 1);
}

// The number that comes first behind those of 8 bytes: the dimension, as the other machine writes it.
CASE(a_checkpoint_of_the_other_order_is_refused_by_name) {
  const char *name = "byte_order.jamstate";
  jam_create_options o = default_create_options();
  o.n = 10;
  const Packing p = make_packing(o, nullptr, 0, nullptr, 0);
  std::string beside;
  write_checkpoint(p, beside, name);
  std::string all;
  {
    std::ifstream file(name, std::ios::binary);
    all.assign(std::istreambuf_iterator<char>(file), {});
  }
  int32_t dim;
  constexpr size_t place = 40;
  std::memcpy(&dim, &all[place], sizeof dim);
  assert_int_equal(dim, 3);
  dim = with_bytes_reversed(dim);
  std::memcpy(&all[place], &dim, sizeof dim);
  std::ofstream(name, std::ios::binary) << all;
  std::string answer;
  try {
    read_checkpoint(name, beside);
  } catch (const Error &e) {
    if (e.code() == JAM_E_FORMAT) answer = e.what();
  }
  assert_true(answer.find("order of bytes") != std::string::npos);
  std::remove(name);
}

}  // namespace
