// Out of memory at any allocation of a crunch: JAM_E_MEMORY with a valid state, either that before the call or the last
// good one on the way, from which the next crunch goes on; no leak.
extern "C" {
#include <jam/jam.h>
#include <string.h>

#include "test.h"
}
#include <cmath>

#include "failing_new.hpp"

namespace {

jam_system *start() {
  jam_system *sys = nullptr;
  DEFAULTS(create, o);
  o.n = 24, o.packing_fraction = 0.3, o.seed = 2;
  assert_int_equal(jam_create(&o, nullptr, &sys), JAM_OK);
  return sys;
}

double fraction(const jam_system *sys) {
  SIZED(jam_info, info);
  jam_get_info(sys, &info);
  return info.packing_fraction;
}

// Brute force over pairs, nearest images: the box is wide enough.
void assert_valid(const jam_system *sys) {
  const double *x, *s;
  size_t n;
  jam_view(sys, JAM_VIEW_DIAMETERS, &s, &n);
  size_t len;
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &len);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < i; ++j) {
      double r2 = 0.0;
      for (size_t c = 0; c < 3; ++c) {
        assert_true(x[3 * i + c] >= 0.0 && x[3 * i + c] < 1.0);
        double dx = x[3 * i + c] - x[3 * j + c];
        dx -= std::nearbyint(dx);
        r2 += dx * dx;
      }
      assert_true(std::sqrt(r2) > 0.5 * (s[i] + s[j]) * (1.0 - 1e-12));
    }
}

// The k-th allocation fails, for every k of the first `dense` and then for fewer and fewer.
void fail_each(const jam_crunch_options &o, long dense) {
  long as_before = 0, advanced = 0, survived = 0;
  for (long k = 0;; k += 1 + k / dense * 17) {
    const long clean = alive;
    jam_system *sys = start();
    const double before = fraction(sys);
    until_failure = k;
    const jam_status status = jam_crunch(sys, &o, nullptr);
    const bool hit = has_failed();
    until_failure = -1;
    if (!hit) {
      assert_int_equal(status, JAM_OK);
      jam_destroy(sys);
      break;
    }
    if (status == JAM_E_MEMORY) {
      assert_true(strlen(jam_last_error()) > 0);
      (fraction(sys) == before ? as_before : advanced) += 1;
    } else {
      assert_int_equal(status, JAM_OK);  // a temporary that the standard library does without
      ++survived;
    }
    assert_valid(sys);
    if (k % 5 == 0) {  // the handle works
      assert_int_equal(jam_crunch(sys, nullptr, nullptr), JAM_OK);
      assert_valid(sys);
    }
    jam_destroy(sys);
    assert_int_equal(alive, clean);
  }
  print_message("state as before %ld times, last good state %ld times, not needed %ld times\n", as_before, advanced,
                survived);
  assert_true(as_before > 5 && advanced > 5);
}

#ifdef JAM_SANITIZED  // ten times slower: the release build has tried the others
const long dense_path = 200, dense_other = 100;
#else
const long dense_path = 1500, dense_other = 300;
#endif

CASE(every_allocation) {
  DEFAULTS(crunch, o);
  for (int method = 0; method < 2; ++method)
    for (int single = 0; single < 2; ++single) {
      o.method = method, once = single != 0, o.steps = single;
      fail_each(o, method == 0 && single ? dense_path : dense_other);
    }
}

}  // namespace
