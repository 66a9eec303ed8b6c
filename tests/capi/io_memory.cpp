// Out of memory at any allocation of create, copy, read and write: a status, no handle, no leak, no file left behind.
extern "C" {
#include "io_helpers.h"
}
#include <cstdlib>
#include <new>

namespace {
long until_failure = -1;  // allocations that still succeed; -1: all
long alive = 0;
}  // namespace

// The replacement reaches the shared library too: it takes its operator new from the program.
void *operator new(std::size_t size) {
  if (until_failure == 0) throw std::bad_alloc();
  if (until_failure > 0) --until_failure;
  void *p = std::malloc(size ? size : 1);
  if (!p) throw std::bad_alloc();
  ++alive;
  return p;
}
void *operator new(std::size_t size, const std::nothrow_t &) noexcept {  // stable_sort asks so, and does without
  void *p = until_failure == 0 ? nullptr : std::malloc(size ? size : 1);
  alive += p ? 1 : 0;
  return p;
}
void operator delete(void *p) noexcept {
  if (p) --alive;
  std::free(p);
}
void operator delete(void *p, const std::nothrow_t &) noexcept { operator delete(p); }
void operator delete(void *p, std::size_t) noexcept { operator delete(p); }

namespace {

// Runs call() with the first, the second, ... allocation failing until it succeeds; returns how many failed.
template <class Call>
long fail_each(Call &&call) {
  for (long k = 0; k < 100000; ++k) {
    const long before = alive;
    until_failure = k;
    const jam_status status = call();
    const bool ran_out = until_failure == 0;
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

void every_allocation(void **) {
  jam_system *sys = some_packing(3, 40, 1.4, 1.0), *out = nullptr;
  char path[256];
  strcpy(path, in_scratch("m.xyz"));
  const long writing = fail_each([&] { return jam_write(sys, path, JAM_FORMAT_AUTO); });
  assert_true(writing > 0);
  assert_int_equal(count_files(), 1);
  assert_true(fail_each([&] { return jam_read(path, nullptr, &out); }) > 3);
  assert_same_bits(sys, out);
  jam_destroy(out);
  out = nullptr;
  assert_true(fail_each([&] { return jam_copy(sys, &out); }) > 3);
  jam_destroy(out);
  jam_create_options o;
  jam_create_options_init(&o, sizeof o);
  o.n = 40;
  out = nullptr;
  assert_true(fail_each([&] { return jam_create(&o, nullptr, 0, nullptr, 0, &out); }) > 3);
  jam_destroy(out);
  jam_destroy(sys);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(every_allocation)};
  return cmocka_run_group_tests(tests, make_scratch, remove_scratch);
}
