// A callback hears from long work several times a second, also where the work itself has nothing to report.
#include "core/monitor.hpp"

#include "core/call_scope.hpp"
#include "linalg/scratch_buffer.hpp"
#include "test.h"

using namespace jam;

namespace {

int32_t count_calls(const jam_progress *, void *user) {
  ++*static_cast<int *>(user);
  return 0;
}

// The work of `step`, again and again for so many seconds; how often the callback was called.
template <class Step>
int calls_during(double seconds, Step &&step) {
  Monitor monitor;
  int calls = 0;
  monitor.progress = count_calls;
  monitor.progress_user = &calls;
  monitor.begin();
  const CallScope scope(1e12, &monitor);
  while (monitor.seconds() < seconds) step(monitor);
  return calls;
}

void silence_is_short(void **) {
  // 0.15 s between two calls: 7 in 1.2 s, fewer on a busy machine; 0.5 s would be 2
  assert_in_range(calls_during(1.2, [](Monitor &monitor) { monitor.look(); }), 4, 8);
  assert_in_range(calls_during(1.2, [](Monitor &) { CallScope::look(); }), 4, 8);
  assert_in_range(calls_during(1.2, [](Monitor &) { CallScope::tell(); }), 4, 8);
}

// Clearing memory is such work: seconds for the factors of 100000 spheres.
void clearing_memory_tells(void **) {
  const auto clear = [](Monitor &) {
    std::vector<double> room;
    grow(room, size_t{1} << 23);
    assert_int_equal(room.size(), size_t{1} << 23);
    assert_true(room.front() == 0.0 && room.back() == 0.0);
  };
  assert_in_range(calls_during(1.2, clear), 3, 8);
}

// A cancellation waits behind tell(), also where look() would leave the work.
void tell_leaves_nothing(void **) {
  Monitor monitor;
  monitor.begin();
  const LeavingScope scope(1e12, &monitor);
  monitor.cancel();
  CallScope::tell();
  bool left = false;
  try {
    CallScope::look();
  } catch (const Cancelled &) {
    left = true;
  }
  assert_true(left);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(silence_is_short), cmocka_unit_test(clearing_memory_tells),
                              cmocka_unit_test(tell_leaves_nothing)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
