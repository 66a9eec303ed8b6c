// When the barrier path cools and when it is warmed up, from invented courses of the Newton decrement.
#include <cmath>
#include "test.h"

#include "crunch/barrier_schedule.hpp"

using namespace jam;

namespace {

constexpr double rows = 1000.0;

BarrierSchedule::Step step(double decrement, double part) { return {decrement, rows, 1e-6, 1e-3, part, 0.1}; }

// The first factor other than 1 within `steps` steps of a course; 1 if there is none.
template <class Course>
double first_turn(BarrierSchedule &c, int steps, const Course &course) {
  for (int k = 0; k < steps; ++k) {
    const double factor = c.before(course(k));
    if (factor != 1.0) return factor;
  }
  return 1.0;
}

// Short steps that leave the decrement high are a saddle: warmer, soon. So are whole steps that never end.
void saddles(void **) {
  BarrierSchedule cut, endless;
  assert_true(first_turn(cut, 20, [](int) { return step(50.0 * rows, 0.1); }) > 1.0);
  assert_int_equal(cut.reheats(), 1);
  assert_true(first_turn(endless, 20, [](int) { return step(50.0 * rows, 1.0); }) == 1.0);
  assert_true(first_turn(endless, 100, [](int) { return step(50.0 * rows, 1.0); }) > 1.0);
  assert_int_equal(endless.reheats(), 1);
}

// A saddle is left by a little warmth; one that is met again at the same gap by more; a colder one by a little again.
void same_saddle(void **) {
  BarrierSchedule c;
  const auto warmed = [&](double gap) {
    return first_turn(c, 20, [&](int) { return BarrierSchedule::Step{50.0 * rows, rows, gap, 1e-3, 0.1, 0.1}; });
  };
  const double first = warmed(1e-6), same = warmed(0.9e-6), colder = warmed(1e-7), warmer = warmed(1e-6);
  assert_true(first > 1.0 && same > 2.0 * first && colder == first && warmer == same);
  assert_int_equal(c.reheats(), 4);
}

// With more rows in the way more steps are short before it is a saddle; all but centred they are not waited for.
void many_rows(void **) {
  const double rows_of_many = 3e5;
  const auto course = [&](double decrement) {
    return [=](int) { return BarrierSchedule::Step{decrement * rows_of_many, rows_of_many, 1e-9, 1e-3, 0.1, 0.1}; };
  };
  BarrierSchedule waits, turns, centred, last;
  assert_true(first_turn(waits, 40, course(1.0)) == 1.0);
  assert_true(first_turn(turns, 60, course(1.0)) > 1.0);
  assert_true(first_turn(centred, 20, course(0.015)) < 1.0);
  // Where one cooling more would be the last it is LPs' turn sooner.
  assert_true(first_turn(last, 20, [=](int) {
                return BarrierSchedule::Step{rows_of_many, rows_of_many, 1e-12, 1e-3, 0.1, 0.1, true};
              }) > 1.0);
}

// Short steps are none where the decrement falls: a little with each of them, or much now and then.
void falling(void **) {
  BarrierSchedule slow, jerks;
  assert_true(first_turn(slow, 35, [](int k) { return step(1e4 * rows * std::pow(0.85, k), 0.1); }) == 1.0);
  assert_true(first_turn(jerks, 35, [](int k) { return step(1e6 * rows * std::pow(0.25, k / 6), 0.1); }) == 1.0);
  assert_int_equal(slow.reheats() + jerks.reheats(), 0);
}

// All but centred, and a few places hold up the rest: cooler, not warmer.
void nearly_centred(void **) {
  BarrierSchedule c;
  double limit = 10.0 * rows;  // what counts as reached
  while (!BarrierSchedule().centred(limit, rows)) limit *= 0.9;
  assert_true(first_turn(c, 20, [&](int) { return step(3.0 * limit, 0.1); }) < 1.0);
  assert_int_equal(c.reheats(), 0);
}

// A flow far from jamming is cut off after a while; it is never warmed up, however short its steps.
void flows(void **) {
  BarrierSchedule c;
  for (int k = 0; k < 200; ++k) assert_true(c.before({1e3 * rows, rows, 0.1, 1e-3, 0.1, 0.5}) <= 1.0);
  assert_int_equal(c.reheats(), 0);
  BarrierSchedule again;
  assert_true(first_turn(again, 30, [](int) { return BarrierSchedule::Step{1e3 * rows, rows, 0.1, 1e-3, 0.1, 0.5}; }) <
              1.0);
}

// Forces far from balance and hardly a step: too cold for a start. It is warmed up a few times, but not once a maximum
// was reached.
void creeping(void **) {
  const BarrierSchedule::Step creeps = {1e3 * rows, rows, 1.0, 0.9, 0.01, 0.01};
  BarrierSchedule c, centred;
  int warmer = 0;
  for (int k = 0; k < 60; ++k) warmer += c.before(creeps) > 1.0;
  assert_true(warmer >= 1 && warmer <= 3);
  assert_int_equal(c.reheats(), 0);
  assert_true(centred.centred(0.0, rows));
  for (int k = 0; k < 14; ++k) assert_true(centred.before(creeps) == 1.0);
}

// What counts at one mu is forgotten at the next.
void new_mu(void **) {
  BarrierSchedule c;
  for (int k = 0; k < 60; ++k) {
    assert_true(c.before(step(50.0 * rows, 0.1)) == 1.0);
    if (k % 6 == 5) assert_true(c.centred(1e-6 * rows, rows));
  }
  assert_int_equal(c.reheats(), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(saddles),  cmocka_unit_test(same_saddle),    cmocka_unit_test(many_rows),
                              cmocka_unit_test(falling),  cmocka_unit_test(nearly_centred), cmocka_unit_test(flows),
                              cmocka_unit_test(creeping), cmocka_unit_test(new_mu)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
