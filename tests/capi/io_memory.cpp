// Out of memory at any allocation of create, copy, read and write: a status, no handle, no leak, no file left behind.
#include "failing_new.hpp"
#include "io_helpers.h"

namespace {

// Runs call() with the first, the second, ... allocation failing until it succeeds; returns how many failed.
template <class Call>
long fail_each(Call &&call) {
  for (long k = 0; k < 100000; ++k) {
    const long before = alive;
    until_failure = k;
    const jam_status status = call();
    const bool ran_out = has_failed();
    until_failure = -1;
    if (!ran_out || status == JAM_OK) {
      assert_int_equal(status, JAM_OK);
      return k;
    }
    assert_int_equal(status, JAM_E_MEMORY);
    assert_true(strlen(jam_last_error()) > 0);
    assert_int_equal(alive, before);
  }
  fail_msg("never succeeds");
  return -1;
}

CASE(every_allocation) {
  jam_system *sys = some_packing(3, 40, 1.4, 1.0), *out = nullptr;
  char path[256];
  strcpy(path, in_scratch("m.xyz"));
  const long writing = fail_each([&] { return jam_write(sys, path, JAM_FORMAT_AUTO); });
  assert_true(writing > 0);
  assert_int_equal(count_files(), 1);
  assert_true(fail_each([&] { return jam_read(path, nullptr, nullptr, nullptr, &out); }) > 3);
  assert_same_bits(sys, out);
  jam_destroy(out);
  out = nullptr;
  assert_true(fail_each([&] { return jam_copy(sys, &out); }) > 3);
  jam_destroy(out);
  DEFAULTS(create, o);
  o.n = 40;
  out = nullptr;
  assert_true(fail_each([&] { return jam_create(&o, nullptr, &out); }) > 3);
  jam_destroy(out);
  jam_destroy(sys);
}

}  // namespace

FIXTURE(make_scratch, remove_scratch)
