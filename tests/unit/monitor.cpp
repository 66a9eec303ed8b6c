// A callback hears from long work several times a second, also where the work itself has nothing to report.
#include "core/monitor.hpp"

#include "core/call_scope.hpp"
#include "linalg/block_cholesky.hpp"
#include "linalg/dense_front.hpp"
#include "linalg/two_threads.hpp"
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
  // 0.1 s between two calls: 12 in 1.2 s, fewer on a busy machine, more where the last step takes longer; 0.5 s would
  // be 2, and a call at each look would be millions
  assert_in_range(calls_during(1.2, [](Monitor &monitor) { monitor.look(); }), 4, 20);
  assert_in_range(calls_during(1.2, [](Monitor &) { CallScope::look(); }), 4, 20);
  assert_in_range(calls_during(1.2, [](Monitor &) { CallScope::tell(); }), 4, 20);
}

// Work that asks nobody: its end comes before that of the call, and nothing is told without a callback.
void work_on_another_thread_tells(void **) {
  const auto nap = [] { std::this_thread::sleep_for(std::chrono::milliseconds(1200)); };
  assert_in_range(calls_during(1.0, [&](Monitor &) { while_telling(nap); }), 4, 20);
  std::thread::id worker;
  while_telling([&] { worker = std::this_thread::get_id(); });
  assert_true(worker == std::this_thread::get_id());
}

// One product of a large front takes most of a second. Its bits do not depend on who listens.
void a_large_product_tells(void **) {
  const int n = 3000;
  std::vector<double> b(static_cast<size_t>(n) * n), alone(b.size()), watched(b.size());
  for (size_t k = 0; k < b.size(); ++k) b[k] = std::sin(static_cast<double>(k));
  minus_square(alone.data(), n, b.data(), n, n, 1);
  const auto product = [&](Monitor &) { minus_square(watched.data(), n, b.data(), n, n, 1); };
  assert_true(calls_during(0.1, product) > 0);
  assert_true(alone == watched);
}

// The symbolic analysis of 100000 spheres takes a second without any product.
void symbolic_analysis_tells(void **) {
  const int side = 16, n = side * side * side;
  std::vector<int32_t> ei, ej;
  for (int k = 0; k < n; ++k)
    for (const int step : {1, side, side * side})
      if (k + step < n) ei.push_back(k), ej.push_back(k + step);
  BlockCholesky factor;
  factor.analyse(3, n, ei.data(), ej.data(), ei.size());
  const auto again = [&](Monitor &) { factor.analyse_keep_order(3, n, ei.data(), ej.data(), ei.size()); };
  assert_in_range(calls_during(1.2, again), 4, 20);
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
  const CMUnitTest tests[] = {cmocka_unit_test(silence_is_short), cmocka_unit_test(symbolic_analysis_tells),
                              cmocka_unit_test(work_on_another_thread_tells), cmocka_unit_test(a_large_product_tells),
                              cmocka_unit_test(tell_leaves_nothing)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
