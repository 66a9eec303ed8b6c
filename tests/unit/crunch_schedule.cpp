// When the barrier parameter mu falls and when it rises, from invented courses of the Newton decrement.
#include <cmath>
#include "test.h"

#include "crunch/path/schedule.hpp"

using namespace jam::inside;

namespace {

constexpr double rows = 1000.0;
const Tuning tuning;

BarrierSchedule::Step step(double decrement, double part, double room = 1e3) { return {decrement, part, room}; }

// The first factor other than 1 within `steps` steps of a course; 1 if there is none.
template <class Course>
double first_factor(BarrierSchedule &s, int steps, const Course &course) {
  for (int k = 0; k < steps; ++k) {
    const double factor = s.next_factor(course(k));
    if (factor != 1.0) return factor;
  }
  return 1.0;
}

// Short steps that leave the decrement high are a saddle: mu rises soon. Whole steps that never end are one too.
CASE(mu_rises_at_saddles) {
  BarrierSchedule blocked(tuning), endless(tuning);
  assert_true(first_factor(blocked, 20, [](int) { return step(50.0 * rows, 0.1); }) == tuning.increase);
  assert_int_equal(blocked.increases(), 1);
  assert_true(first_factor(endless, 20, [](int) { return step(50.0 * rows, 1.0); }) == 1.0);
  assert_true(first_factor(endless, 100, [](int) { return step(50.0 * rows, 1.0); }) == tuning.increase);
  assert_int_equal(endless.increases(), 1);
}

// Above the first mu all spheres would shrink without end: where mu would rise above it, it falls instead.
CASE(first_mu_is_the_largest) {
  BarrierSchedule below(tuning), first(tuning);
  assert_true(first_factor(below, 20, [](int) { return step(50.0 * rows, 0.1, 1.01 * tuning.increase); }) ==
              tuning.increase);
  assert_int_equal(below.increases(), 1);
  assert_true(first_factor(first, 20, [](int) { return step(50.0 * rows, 0.1, 0.99 * tuning.increase); }) ==
              tuning.reduction);
  assert_int_equal(first.increases(), 0);
}

// While the decrement falls, short steps are the way to the maximum and no saddle.
CASE(mu_stays_while_the_decrement_falls) {
  BarrierSchedule s(tuning);
  assert_true(first_factor(s, 30, [](int k) { return step(1e6 * rows * std::pow(0.85, k), 0.1); }) == 1.0);
  assert_int_equal(s.increases(), 0);
}

// At the maximum the count of steps begins anew.
CASE(maximum_starts_a_new_count) {
  BarrierSchedule s(tuning);
  assert_false(s.centred(2.0 * tuning.centred * rows, rows));
  for (int mu = 0; mu < 20; ++mu) {
    assert_true(first_factor(s, 6, [](int) { return step(50.0 * rows, 0.1); }) == 1.0);
    assert_true(s.centred(0.5 * tuning.centred * rows, rows));
  }
  assert_int_equal(s.increases(), 0);
}

}  // namespace
