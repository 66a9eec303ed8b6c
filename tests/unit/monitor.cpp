// A callback hears from long work several times a second, also where the work itself has nothing to report.
#include "core/monitor.hpp"

#include <ctime>
#include <thread>

#include "core/call_scope.hpp"
#include "core/error.hpp"
#include "linalg/block_cholesky.hpp"
#include "linalg/dense_front.hpp"
#include "test.h"

using namespace jam::inside;

namespace {

int32_t count_calls(const jam_progress *, void *user) {
  ++*static_cast<int *>(user);
  return 0;
}

// The work of `step`, again and again until the callback was called `wanted` times. Between two calls 0.1 s pass or
// more; the processor works for less than 0.5 s, on a busy machine too: seconds of a clock would not tell there.
template <class Step>
void tells(int wanted, Step &&step) {
  Monitor monitor;
  int calls = 0;
  monitor.progress = count_calls;
  monitor.progress_user = &calls;
  monitor.begin();
  const CallScope scope(1e12, &monitor);
  const std::clock_t begun = std::clock();
  while (calls < wanted && monitor.seconds() < 100) step(monitor);
  const double worked = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  if (calls < wanted || monitor.seconds() < 0.09 * (calls - 1) || worked > 0.5 * (calls + 1))
    fail_msg("%d calls in %.2f s, with %.2f s of work", calls, monitor.seconds(), worked);
}

CASE(silence_is_short) {
  tells(10, [](Monitor &monitor) { monitor.look(); });
  tells(10, [](Monitor &) { CallScope::look(); });
}

// A log callback gets the whole sentence of an error.
CASE(long_lines_are_logged_whole) {
  Monitor monitor;
  std::string heard;
  const std::string line(sentence_max - 1, 'x');
  monitor.log_level = JAM_LOG_WARNING, monitor.log_user = &heard;
  monitor.log_fn = [](int32_t, const char *text, void *user) { *static_cast<std::string *>(user) = text; };
  monitor.log(JAM_LOG_WARNING, "%s", line.c_str());
  assert_true(heard == line);
}

// Work without polling: it ends before the call, and nothing is reported without a callback.
CASE(work_on_another_thread_tells) {
  const auto nap = [] { std::this_thread::sleep_for(std::chrono::milliseconds(1200)); };
  tells(4, [&](Monitor &) { report_while(nap); });
  std::thread::id worker;
  report_while([&] { worker = std::this_thread::get_id(); });
  assert_true(worker == std::this_thread::get_id());
}

// One product of a large front takes most of a second. Its bits do not depend on who listens.
CASE(a_large_product_tells) {
  const int n = 3000;
  std::vector<double> b(static_cast<size_t>(n) * n), alone(b.size()), watched(b.size());
  for (size_t k = 0; k < b.size(); ++k) b[k] = std::sin(static_cast<double>(k));
  Workers one(1);
  minus_square(alone.data(), n, b.data(), n, n, one);
  const auto product = [&](Monitor &) { minus_square(watched.data(), n, b.data(), n, n, one); };
  tells(1, product);
  assert_true(alone == watched);
}

// Pairs of neighbours in a cube of side^3 points.
struct Grid {
  explicit Grid(int side) : n(side * side * side) {
    for (int k = 0; k < n; ++k)
      for (const int step : {1, side, side * side})
        if (k + step < n) ei.push_back(k), ej.push_back(k + step);
  }
  int n;
  std::vector<int32_t> ei, ej;
};

// The symbolic analysis of 100000 spheres takes a second without any product.
CASE(symbolic_analysis_tells) {
  const Grid g(16);
  BlockCholesky factor;
  factor.analyse(3, g.n, g.ei.data(), g.ej.data(), g.ei.size());
  const auto again = [&](Monitor &) { factor.analyse_keep_order(3, g.n, g.ei.data(), g.ej.data(), g.ei.size()); };
  tells(4, again);
}

// Both parts of a factorisation are left where the call is cancelled, also with a second thread at work, and in a scope
// that cannot be left they go on. Afterwards the same object factorises as a new one does.
CASE(factorisations_are_left) {
  const Grid g(12);
  std::vector<double> diag(g.n, 7.0), off(g.ei.size(), -1.0);
  BlockCholesky factor;
  const auto solve = [&] {
    std::vector<double> x(g.n, 1.0);
    assert_int_equal(factor.factorise(diag.data(), off.data()), 0);
    factor.solve(x.data());
    return x;
  };
  for (const int threads : {1, 2, 5}) {
    const auto analyse = [&] { factor.analyse(1, g.n, g.ei.data(), g.ej.data(), g.ei.size(), threads); };
    analyse();
    const std::vector<double> before = solve();
    Monitor monitor;
    monitor.begin();
    monitor.cancel();
    const auto leaves = [&](auto &&work) {
      const CancellableScope scope(1e12, &monitor);
      try {
        work();
      } catch (const Cancelled &) {
        return true;
      }
      return false;
    };
    assert_true(leaves([&] { factor.factorise(diag.data(), off.data()); }));
    assert_true(leaves(analyse));
    analyse();
    const CallScope stays(1e12, &monitor);
    assert_true(solve() == before);
  }
}

// A short call beside a handle hears the cancels that come while it runs, and answers them; those from before it leaves
// to the next verb.
CASE(short_calls_beside_a_handle) {
  Monitor handle, call;
  handle.begin();
  handle.cancel();
  call.begin_beside(handle, false);
  assert_false(call.cancelled());
  call.end_beside(handle);
  assert_true(handle.cancelled());
  handle.cancel();
  assert_true(call.cancelled() && call.interrupted());
  call.end_beside(handle);
  assert_false(handle.cancelled());
}

// The fraction never falls, also where its source does; a steady call's time is extrapolated; a jump widens the spread.
CASE(time_left_follows_the_fraction) {
  TimeLeft left;
  left.begin();
  jam_progress p = progress_of(JAM_PHASE_CRUNCH);
  left.complete(p);
  assert_true(std::isnan(p.fraction) && std::isnan(p.seconds_left));
  double last = 0.0;
  for (int k = 0; k <= 1000; ++k) {  // 100 s in all
    p = progress_of(JAM_PHASE_CRUNCH);
    p.seconds = 0.08 * k;
    p.fraction = k % 7 == 3 ? 0.0 : k % 11 == 5 ? std::nan("") : 0.0008 * k;
    left.complete(p);
    assert_true(p.fraction >= last);
    last = p.fraction;
    if (k < 100) continue;
    const double right = 100.0 - p.seconds;
    assert_true(p.seconds_left_spread > 1.0);
    assert_true(p.seconds_left < 1.1 * right && p.seconds_left > 0.9 * right);
  }
  const double before = p.seconds_left_spread;
  for (int k = 1; k < 500; ++k) {  // stands still
    p = progress_of(JAM_PHASE_CRUNCH);
    p.seconds = 80.0 + 0.08 * k;
    p.fraction = 0.8 + 1e-6 * k;
    left.complete(p);
  }
  assert_true(p.seconds_left_spread > 3.0 * before);
  p.fraction = 2.0;
  left.complete(p);
  assert_true(p.fraction == 1.0);
}

CASE(logarithms_of_a_way) {
  assert_true(std::fabs(log_share(10.0, 100.0, 1000.0) - 0.5) < 1e-15);
  assert_true(std::fabs(log_share(1e-2, 1e-5, 1e-8) - 0.5) < 1e-15);
  assert_true(log_share(1.0, 5.0, HUGE_VAL) == 0.0 && log_share(3.0, 3.0, 3.0) == 1.0);
  assert_true(log_share(10.0, 1.0, 100.0) == 0.0 && log_share(10.0, 1e5, 100.0) == 1.0);
  assert_true(std::isnan(log_share(0.0, 5.0, 10.0)) && std::isnan(log_share(1.0, std::nan(""), 10.0)));
}

}  // namespace
